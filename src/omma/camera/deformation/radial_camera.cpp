#include "omma/camera/deformation/radial_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "omma/base/error.h"
#include "omma/camera/camera_parameters.h"

namespace omma {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180.0;

struct Scale {
  glm::dvec2 focal;
  double max_angle;
};

// From a field of view, or with r = 1 at the edge when there is none.
Scale scale_from_fit(const DeformationText& text, const RadialForm& form, const ImageSize& own) {
  const Fit fit = text.has("fit") ? parse_fit(text.spec().name, text.value("fit")) : Fit::shorter;
  // Where a formula turns back is known to half of a double's digits: up to the next round number.
  const double limit_deg = std::ceil(2.0 * form.max_angle() / radians_per_degree * 1e5) / 1e5;
  double radius = 1.0;
  std::optional<double> half;
  if (const auto fov_deg = text.number_within("fov_deg", min_fov_deg, limit_deg)) {
    half = std::min(0.5 * *fov_deg * radians_per_degree, form.max_angle());
    radius = form.radius(*half).value_or(0.0);
    if (!(radius > 0.0)) {
      throw CommandError("{}={}: the formula has no radius for {} degrees from the axis", text.label("fov_deg"),
                         *fov_deg, 0.5 * *fov_deg);
    }
  } else {
    half = form.angle(1.0);
  }
  const bool circle = fit == Fit::shorter && half;
  return {glm::dvec2(half_extent(fit, own) / radius), circle ? *half : form.max_angle()};
}

Scale scale_of(const DeformationText& text, const RadialForm& form, const ImageSize& own) {
  if (text.has("fx") != text.has("fy")) {
    throw CommandError("{} is missing: give fx and fy, or f for both", text.label(text.has("fx") ? "fy" : "fx"));
  }
  if (!text.has("f") && !text.has("fx")) return scale_from_fit(text, form, own);
  for (const char* other : {"fov_deg", "fit", "fx"}) {
    const char* focal = text.has("f") ? "f" : "fx";
    if (std::string(focal) != other && text.has(other)) {
      throw CommandError("{} and {} say the same thing twice; give one of them", text.label(focal), other);
    }
  }
  const auto pixels = [&](const char* key) { return text.number_within(key, 1e-3, 1e9).value(); };
  const glm::dvec2 focal = text.has("f") ? glm::dvec2(pixels("f")) : glm::dvec2(pixels("fx"), pixels("fy"));
  return {focal, form.max_angle()};
}

}  // namespace

double RadialForm::max_angle() const {
  return std::min(radius_of_angle ? function.end() : function.end_value(), std::numbers::pi);
}

Camera make_radial_camera(const DeformationText& text, const RadialForm& form, std::optional<ImageSize> size) {
  const ImageSize own = text.own_size().value_or(size.value_or(default_image_size));
  const ImageSize wanted = size.value_or(own);
  const glm::dvec2 scale = wanted == own ? glm::dvec2(1.0) : image_scale(text.label("width"), own, wanted);
  const Scale plane = scale_of(text, form, own);
  constexpr double far = 1e9;
  const glm::dvec2 centre(text.number_within("cx", -far, far).value_or(0.5 * own.width),
                          text.number_within("cy", -far, far).value_or(0.5 * own.height));
  const glm::dmat3 cameraFromLens = lens_rotation(
      [&](const char* key, double limit) { return text.number_within(key, -limit, limit).value_or(0.0); });
  return deformed_camera(wanted, source_text(text.spec(), wanted, scale), text.limits(),
                         [&](const glm::dvec2& pixel) -> std::optional<glm::dvec3> {
                           const glm::dvec2 point = (pixel / scale - centre) / plane.focal;
                           const double radius = glm::length(point);
                           const auto angle = form.angle(radius);
                           if (!angle || *angle > plane.max_angle) return {};
                           const glm::dvec2 meridian = radius > 0.0 ? point / radius : glm::dvec2(1.0, 0.0);
                           const double across = std::sin(*angle);
                           return cameraFromLens *
                                  glm::dvec3(meridian.x * across, -meridian.y * across, -std::cos(*angle));
                         });
}

}  // namespace omma
