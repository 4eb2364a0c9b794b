#include "omma/technique/image_based/cube.h"

#include <algorithm>
#include <cmath>

#include "omma/camera/ray_bundle.h"

namespace omma {
namespace {

glm::dmat3 face(const glm::dvec3& ahead, const glm::dvec3& up) {
  return glm::transpose(glm::dmat3(glm::cross(ahead, up), -up, ahead));
}

/// The ray nearest to the end of the image between a pixel that has one and its neighbour that has none: some lenses
/// turn through many degrees there.
glm::vec3 last_ray(const Camera& camera, const glm::dvec2& pixel, const glm::dvec2& step) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (camera.unproject(pixel + middle * step) ? low : high) = middle;
  }
  return camera.unproject(pixel + low * step)->direction;
}

}  // namespace

const std::array<glm::dmat3, 6> faceFromCamera{
    face({1, 0, 0}, {0, 1, 0}),   face({-1, 0, 0}, {0, 1, 0}), face({0, 1, 0}, {0, 0, 1}),
    face({0, -1, 0}, {0, 0, -1}), face({0, 0, 1}, {0, 1, 0}),  face({0, 0, -1}, {0, 1, 0}),
};

std::array<FaceWindow, 6> seen_windows(const Camera& camera, const PixelRect& region) {
  std::array<FaceWindow, 6> windows;
  // A ray within a pixel or so of an edge counts for both its faces: a shifted sample or the GPU's rounding may send it
  // to either, and in the layouts no other pixel need see the other one.
  const double density = camera.pixels_per_radian();
  const double edge = 1.0 + (density > 0.0 ? std::min(2.0 / density, 0.1) : 0.0);
  const auto add = [&windows, edge](const glm::vec3& direction) {
    for (size_t f = 0; f < windows.size(); ++f) {
      const glm::dvec3 p = faceFromCamera[f] * glm::dvec3(direction);
      if (p.z <= 0.0 || std::abs(p.x) > edge * p.z || std::abs(p.y) > edge * p.z) continue;
      windows[f].min = glm::min(windows[f].min, glm::dvec2(p) / p.z);
      windows[f].max = glm::max(windows[f].max, glm::dvec2(p) / p.z);
    }
  };
  // One pixel more all around: shifted samples lie between pixel centres.
  const PixelRect around{region.x0 - 1, region.y0 - 1, region.x1 + 1, region.y1 + 1};
  const RayMap rays = rays_of(camera, around);
  const auto at = [&](int x, int y) {
    return rays.directions[size_t(y - around.y0) * size_t(around.width()) + size_t(x - around.x0)];
  };
  const glm::vec3 no_ray(0.0f);
  for (int y = around.y0; y < around.y1; ++y) {
    for (int x = around.x0; x < around.x1; ++x) {
      if (at(x, y) == no_ray) continue;
      add(at(x, y));
      for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
        const glm::ivec2 next = glm::ivec2(x, y) + step;
        const bool inside = next.x >= around.x0 && next.x < around.x1 && next.y >= around.y0 && next.y < around.y1;
        if (!inside) continue;
        const glm::dvec2 centre = glm::dvec2(x, y) + 0.5;
        if (at(next.x, next.y) == no_ray) {
          add(last_ray(camera, centre, step));
        } else if (density * glm::distance(at(x, y), at(next.x, next.y)) > 4.0) {
          // Across a jump the next pixel tells nothing of the shifted samples between.
          if (const auto ray = camera.unproject(centre + 0.499 * glm::dvec2(step))) add(ray->direction);
        }
      }
    }
  }
  return windows;
}

}  // namespace omma
