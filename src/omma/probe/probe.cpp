#include "omma/probe/probe.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "omma/base/error.h"
#include "omma/camera/ray_bundle.h"
#include "omma/math/pose.h"

namespace omma {
namespace {

constexpr int smallest = 8, largest = 4096;

ImageSize checked_size(int size) {
  if (size < smallest || size > largest) {
    throw CommandError("a probe's picture of {} pixels; {} to {} are possible", size, smallest, largest);
  }
  return {size, size};
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Which pixels have a ray.
std::vector<bool> seeing(const Camera& camera) {
  std::vector<bool> valid;
  for (const glm::vec3& ray : rays_of(camera).directions) valid.push_back(ray != glm::vec3(0.0f));
  return valid;
}

}  // namespace

void check_probe_point(const ProbePoint& point) {
  if (!is_finite(point.position)) throw CommandError("a point that is not finite sees nothing");
  if (!is_finite(point.normal) || glm::length(point.normal) == 0.0) {
    throw CommandError("the normal {},{},{} has no direction", point.normal.x, point.normal.y, point.normal.z);
  }
}

Prober::Prober(const PreparedScene& scene, const ProbeOptions& options)
    : scene_(scene),
      options_(options),
      cosine_sphere_(make_camera("orthographic_fisheye:fov_deg=180", checked_size(options.size))),
      lambert_(make_camera("equisolid:fov_deg=180", checked_size(options.size))),
      in_cosine_sphere_(seeing(cosine_sphere_)),
      in_lambert_(seeing(lambert_)) {
  if (!(options.max_distance > 0.0)) throw CommandError("nothing lies within {} metres", options.max_distance);
  if (!(options.offset >= 0.0))
    throw CommandError("a point {} metres behind its surface sees nothing", -options.offset);
  options_.render.samples = 1;
}

glm::dmat4 Prober::pose(const ProbePoint& point) const {
  check_probe_point(point);
  const glm::dvec3 from = point.position + options_.offset * glm::normalize(point.normal);
  glm::dmat4 pose = look_at_worldFromCamera(glm::dvec3(0.0), glm::normalize(point.normal));
  pose[3] = glm::dvec4(from, 1.0);
  return pose;
}

void Prober::look_cosine_weighted(const ProbePoint& point, ProbeResult& result) {
  static constexpr Channel wanted[] = {Channel::color, Channel::distance};
  const auto pictures = scene_.render(cosine_sphere_, pose(point), wanted, options_.render);
  const auto& color = std::get<FloatImage>(pictures.at(Channel::color));
  const auto& distance = std::get<FloatImage>(pictures.at(Channel::distance));
  const std::vector<bool>& valid = in_cosine_sphere_;
  size_t pixels = 0, covered = 0, open = 0;
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) continue;
    ++pixels;
    covered += distance.values[i] < options_.max_distance;
    open += std::isinf(distance.values[i]);
    sum += glm::dvec3(color.values[3 * i], color.values[3 * i + 1], color.values[3 * i + 2]);
  }
  result.occlusion = double(covered) / double(pixels);
  result.sky = double(open) / double(pixels);
  result.irradiance = glm::pi<double>() / double(pixels) * sum;
}

void Prober::look_unweighted(const ProbePoint& point, ProbeResult& result) {
  static constexpr Channel wanted[] = {Channel::distance};
  const auto pictures = scene_.render(lambert_, pose(point), wanted, options_.render);
  const auto& distance = std::get<FloatImage>(pictures.at(Channel::distance));
  const std::vector<bool>& valid = in_lambert_;
  size_t pixels = 0, open = 0;
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) continue;
    ++pixels;
    open += !(distance.values[i] < options_.max_distance);
  }
  result.open_solid_angle = 2.0 * glm::pi<double>() * double(open) / double(pixels);
}

}  // namespace omma
