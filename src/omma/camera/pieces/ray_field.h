// A camera's rays in one smooth part of its image, continued beyond what it sees, and how they change from pixel to
// pixel.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

/// A ray and its change per pixel to the right and down. Directions in the camera frame.
struct LocalRays {
  glm::dvec3 ray, dx, dy;

  /// Pixels between here and the place that shows `shown` (any length), by the change of the rays. Across the direction
  /// in which they change most, they are taken to change at least a sixteenth as fast: around poles, where a whole line
  /// of the image shows one point of the world, distances along it would have no meaning. Nothing where no ray changes.
  std::optional<double> distance_px(const glm::dvec3& shown) const;
  /// The same between two rays that are not far from here.
  double distance_px(const glm::dvec3& a, const glm::dvec3& b) const;
  /// How fast rays change in the direction in which they change most and across it, radians per pixel.
  glm::dvec2 changes() const;
};

class RayField {
 public:
  /// `part`: a convex polygon, clockwise as seen, in whose inside the rays are smooth; without corners it is
  /// everything. `inside`: a point in it.
  RayField(const Camera& camera, std::vector<glm::dvec2> part, const glm::dvec2& inside);

  /// The camera's own unit ray, as seen from within the part on its border. Nothing outside.
  std::optional<glm::dvec3> seen(const glm::dvec2& pixel) const;
  std::optional<LocalRays> local(const glm::dvec2& pixel) const;

  /// Unit ray of any point. Beyond its field of view a lens is asked for what its formula has there; where there is
  /// nothing either, the ray is mirrored at the edge on the way to `inside`: it turns on as it did before. Where an
  /// edge shows a single point of the world, it is the ray an eighth of a pixel inside, so that neighbours differ.
  glm::dvec3 at(const glm::dvec2& pixel) const;

  const glm::dvec2& inside() const { return inside_; }

 private:
  std::optional<glm::dvec3> ray(const glm::dvec2& pixel) const;
  double least_change(const glm::dvec2& pixel) const;
  glm::dvec2 nearest_in_part(const glm::dvec2& pixel) const;
  /// The ray next to a point at which rays come together: poles, the antipode.
  std::optional<glm::dvec3> beside_point(const glm::dvec2& pixel) const;
  glm::dvec3 continued(const glm::dvec2& pixel, const glm::dvec2& within) const;

  Camera wide_;  ///< sees as far as its formula goes
  const Camera& camera_;
  std::vector<glm::dvec2> part_;
  glm::dvec2 inside_;
  double step_;
  bool jumps_;  ///< may have jumps that no part keeps out
};

}  // namespace omma
