#include "omma/camera/camera.h"

#include <algorithm>
#include <cmath>

#include "omma/base/error.h"

namespace omma {
namespace {

// Between the camera frame (y up, looks along -z) and the optical frame (y down, looks along +z); its own inverse.
glm::dvec3 flip_frame(const glm::dvec3& direction) { return {direction.x, -direction.y, -direction.z}; }

bool is_finite(const glm::dvec2& point) { return std::isfinite(point.x) && std::isfinite(point.y); }

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The seen pixel centre closest to the image's centre, looked for on a grid of at most 256 pixels a side.
std::optional<glm::dvec2> seen_point_near_centre(const Camera& camera) {
  const ImageSize size = camera.size();
  const glm::dvec2 centre(0.5 * size.width, 0.5 * size.height);
  std::vector<glm::dvec2> candidates = {centre};
  if (const Lens* lens = camera.lens()) candidates.push_back(lens->centre);
  for (const glm::dvec2& point : candidates) {
    const bool inside = point.x >= 0 && point.y >= 0 && point.x <= size.width && point.y <= size.height;
    if (inside && camera.unproject(point)) return point;
  }
  std::optional<glm::dvec2> best;
  const int step_x = std::max(1, size.width / 256), step_y = std::max(1, size.height / 256);
  for (int y = 0; y < size.height; y += step_y) {
    for (int x = 0; x < size.width; x += step_x) {
      const glm::dvec2 point(x + 0.5, y + 0.5);
      if (best && glm::distance(point, centre) >= glm::distance(*best, centre)) continue;
      if (camera.unproject(point)) best = point;
    }
  }
  return best;
}

}  // namespace

std::optional<glm::dvec2> Lens::project(const glm::dvec3& direction) const {
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(largest > 0.0) || !std::isfinite(direction.x + direction.y + direction.z)) return {};
  glm::dvec2 plane;
  // Scaled so that squares neither overflow nor vanish. A rotation's transpose is its inverse.
  const glm::dvec3 in_lens = (direction / largest) * cameraFromLens;
  if (!model->project(parameters, flip_frame(in_lens), plane)) return {};
  const glm::dvec2 pixel = centre + focal * plane;
  if (!is_finite(pixel)) return {};
  return pixel;
}

std::optional<glm::dvec3> Lens::unproject(const glm::dvec2& pixel) const {
  const glm::dvec2 plane = (pixel - centre) / focal;
  glm::dvec3 direction;
  if (!is_finite(plane) || !model->unproject(parameters, plane, direction)) return {};
  return cameraFromLens * flip_frame(direction);
}

ImageSize Camera::size() const {
  if (lens()) return lens()->size;
  return pieces() ? pieces()->size() : ray_map()->size;
}

const RayMap* Camera::ray_map() const {
  const auto* map = std::get_if<std::shared_ptr<const RayMap>>(&form_);
  return map ? map->get() : nullptr;
}

const PieceSet* Camera::pieces() const {
  const auto* set = std::get_if<std::shared_ptr<const PieceSet>>(&form_);
  return set ? set->get() : nullptr;
}

const char* Camera::kind() const {
  if (lens()) return lens()->model->info.name;
  return pieces() ? "pieces" : "ray map";
}

std::optional<glm::dvec2> Camera::project(const glm::dvec3& direction) const {
  if (lens()) return lens()->project(direction);
  if (pieces()) return pieces()->project(direction);
  throw CommandError(
      "a ray map has a ray for each pixel but no formula that takes a direction to a pixel; use a "
      "lens, or a technique that needs no projection");
}

std::optional<Ray> Camera::unproject(const glm::dvec2& pixel) const {
  const auto direction = lens()     ? lens()->unproject(pixel)
                         : pieces() ? pieces()->unproject(pixel)
                                    : ray_map()->unproject(pixel);
  if (!direction) return {};
  return Ray{.origin = glm::dvec3(0.0), .direction = *direction};
}

double Camera::pixels_per_radian() const {
  const auto point = seen_point_near_centre(*this);
  if (!point) return 0.0;
  const glm::dvec3 here = unproject(*point)->direction;
  double density = 0.0;
  // A ray map is linear within a pixel; what is smooth is differentiated more closely.
  const double step = ray_map() ? 1.0 : 1e-3;
  for (const glm::dvec2 axis : {glm::dvec2(step, 0.0), glm::dvec2(0.0, step)}) {
    for (const glm::dvec2& offset : {axis, -axis}) {
      const auto there = unproject(*point + offset);
      if (!there) continue;
      const double angle = angle_between(here, there->direction);
      if (angle > 0.0) density = std::max(density, step / angle);
    }
  }
  return density;
}

}  // namespace omma
