#include "omma/camera/bounds/lens_bound.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace omma {
namespace {

constexpr double pi = 3.14159265358979323846;

namespace in_float {
using namespace glm;
using real = float;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using Params = const Lens&;
#define OUT(type) type&
#define LENS_FUNCTION inline
bool project(Params lens, vec3 direction, vec2& plane) {
  return lens.model->project_float(lens.parameters, direction, plane);
}
#define LENS_PROJECT project
#include "omma/camera/bounds/bounding_shape.h"
}  // namespace in_float

/// f of r = f(θ), sampled from the axis to the border; empty where the lens is not like that.
struct Profile {
  std::vector<double> angle, radius;
};

Profile profile_of(const Lens& lens, double end) {
  constexpr int steps = 512, meridians = 8;
  Profile profile;
  for (int i = 0; i <= steps; ++i) {
    const double theta = end * (1.0 - 1e-9) * i / steps;
    for (int k = 0; k < meridians; ++k) {
      const double phi = 2.0 * pi * k / meridians + 0.1;
      const glm::dvec2 meridian(std::cos(phi), std::sin(phi));
      glm::dvec2 plane;
      if (!lens.model->project(lens.parameters, glm::dvec3(std::sin(theta) * meridian, std::cos(theta)), plane))
        return {};
      const double radius = glm::length(plane);
      if (k == 0) {
        if (i == 0 ? radius > 1e-9 : !(radius > profile.radius.back())) return {};
        profile.angle.push_back(theta);
        profile.radius.push_back(radius);
      }
      const double expected = profile.radius.back();
      if (glm::distance(plane, expected * meridian) > 1e-9 * (1.0 + expected) && i > 0) return {};
    }
  }
  return profile;
}

/// A line of space has cot θ = k cos φ, so it bends around the axis for every k when 1/r is a convex function of cot θ
/// that does not rise above its tangent at infinity.
bool bends_around_axis(const Profile& profile) {
  double previous = 0.0;
  for (size_t i = 1; i + 1 < profile.angle.size(); ++i) {
    const double c = 1.0 / std::tan(profile.angle[i]), next = 1.0 / std::tan(profile.angle[i + 1]);
    const double g = 1.0 / profile.radius[i];
    const double slope = (g - 1.0 / profile.radius[i + 1]) / (c - next);
    if (i == 1 && g - c * slope < -1e-9 * g) return false;
    if (i > 1 && slope > previous * (1.0 + 1e-9)) return false;
    previous = slope;
  }
  return true;
}

/// Plane units from the axis to the image's farthest corner.
double corner_radius(const Lens& lens) {
  double radius = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    const glm::dvec2 pixel(corner & 1 ? lens.size.width : 0, corner & 2 ? lens.size.height : 0);
    radius = std::max(radius, glm::length((pixel - lens.centre) / lens.focal));
  }
  return radius;
}

}  // namespace

const char* lines_name(Lines lines) {
  constexpr const char* names[] = {"straight", "ellipses", "circles", "convex", "any"};
  return names[static_cast<int>(lines)];
}

std::optional<LensBound> lens_bound(const Lens& lens, double margin_px) {
  LensBound bound;
  const double px = 1.0 / std::min(std::abs(lens.focal.x), std::abs(lens.focal.y));
  bound.margin = margin_px * px;
  bound.angle = lens.parameters.max_angle;
  glm::dvec3 corner;
  if (lens.model->unproject(lens.parameters, {corner_radius(lens) + px, 0.0}, corner)) {
    bound.angle = std::min(bound.angle, std::atan2(std::hypot(corner.x, corner.y), corner.z));
  }
  const Profile profile = profile_of(lens, bound.angle);
  if (profile.angle.empty()) return std::nullopt;
  bound.radius = profile.radius.back() * (1.0 + 1e-6);
  bound.within_half = bound.angle <= pi / 2 * (1.0 + 1e-9);
  const std::string_view name = lens.model->info.name;
  bound.lines = name == "perspective"            ? Lines::straight
                : name == "orthographic_fisheye" ? Lines::ellipses
                : name == "stereographic"        ? Lines::circles
                : bends_around_axis(profile)     ? Lines::convex
                                                 : Lines::any;
  return bound;
}

bool BoundingPart::contains(const glm::dvec2& pixel) const {
  int left = 0, right = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 along = corners[(i + 1) % corners.size()] - corners[i], offset = pixel - corners[i];
    const double turn = along.x * offset.y - along.y * offset.x;
    left += turn > 0.0;
    right += turn < 0.0;
  }
  return left == 0 || right == 0;
}

double BoundingPart::area() const {
  double twice = 0.0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 here = corners[i] - corners[0], next = corners[(i + 1) % corners.size()] - corners[0];
    twice += here.x * next.y - here.y * next.x;
  }
  return 0.5 * std::abs(twice);
}

std::vector<BoundingPart> bounding_parts(const Lens& lens, const LensBound& bound, BoundingShape shape,
                                         const std::array<glm::vec3, 3>& corners) {
  const in_float::LensBound in_floats{static_cast<int>(bound.lines), static_cast<float>(std::cos(bound.angle)),
                                      static_cast<float>(bound.radius), static_cast<float>(bound.margin),
                                      bound.within_half};
  glm::vec3 optical[3];
  for (size_t i = 0; i < 3; ++i) {
    const glm::vec3 in_lens = corners[i] * glm::mat3(lens.cameraFromLens);
    optical[i] = {in_lens.x, -in_lens.y, -in_lens.z};
  }
  in_float::BoundParts parts;
  if (shape == BoundingShape::triangles) {
    parts = in_float::bounding_triangles(lens, in_floats, optical[0], optical[1], optical[2]);
  } else {
    parts.part[0] = in_float::bounding_quad(lens, in_floats, optical[0], optical[1], optical[2]);
    parts.count = 1;
  }
  std::vector<BoundingPart> result;
  for (int i = 0; i < parts.count; ++i) {
    const in_float::BoundPart& part = parts.part[i];
    if (part.corners == 0) continue;
    BoundingPart& out = result.emplace_back();
    for (int k = 0; k < part.corners; ++k) {
      out.corners.push_back(lens.centre + lens.focal * glm::dvec2(part.corner[k]));
    }
  }
  return result;
}

}  // namespace omma
