#include "omma/technique/image_based/cube.h"

#include "omma/camera/ray_bundle.h"

namespace omma {
namespace {

glm::dmat3 face(const glm::dvec3& ahead, const glm::dvec3& up) {
  return glm::transpose(glm::dmat3(glm::cross(ahead, up), -up, ahead));
}

/// Which face a direction meets; matches face_of in technique/resample.frag.
size_t face_of(const glm::vec3& d) {
  const glm::vec3 size = glm::abs(d);
  if (size.x >= size.y && size.x >= size.z) return d.x > 0.0f ? 0 : 1;
  if (size.y >= size.z) return d.y > 0.0f ? 2 : 3;
  return d.z > 0.0f ? 4 : 5;
}

}  // namespace

const std::array<glm::dmat3, 6> faceFromCamera{
    face({1, 0, 0}, {0, 1, 0}),   face({-1, 0, 0}, {0, 1, 0}), face({0, 1, 0}, {0, 0, 1}),
    face({0, -1, 0}, {0, 0, -1}), face({0, 0, 1}, {0, 1, 0}),  face({0, 0, -1}, {0, 1, 0}),
};

std::array<FaceWindow, 6> seen_windows(const Camera& camera, const PixelRect& region) {
  std::array<FaceWindow, 6> windows;
  // One pixel more all around: shifted samples lie between pixel centres.
  const RayMap rays = rays_of(camera, {region.x0 - 1, region.y0 - 1, region.x1 + 1, region.y1 + 1});
  for (const glm::vec3& direction : rays.directions) {
    if (direction == glm::vec3(0.0f)) continue;
    const size_t f = face_of(direction);
    const glm::dvec3 p = faceFromCamera[f] * glm::dvec3(direction);
    windows[f].min = glm::min(windows[f].min, glm::dvec2(p) / p.z);
    windows[f].max = glm::max(windows[f].max, glm::dvec2(p) / p.z);
  }
  return windows;
}

}  // namespace omma
