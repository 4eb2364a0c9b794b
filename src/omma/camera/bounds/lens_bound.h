// Shapes that enclose triangles' images: bounding_shape.h, as the GPU computes them, and what it has to know of a lens.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

/// What lines of space become in a lens's plane. Each kind is one of the next, too.
enum class Lines { straight, ellipses, circles, convex, any };

const char* lines_name(Lines lines);

/// What bounding shapes have to know of a lens with radial symmetry. Lengths in units of the lens's plane.
struct LensBound {
  Lines lines;
  double angle;      ///< radians from the axis beyond which the image shows nothing
  double radius;     ///< of the plane's point there
  double margin;     ///< how far shapes reach beyond what they enclose
  bool within_half;  ///< the image shows nothing that lies more than 90° from the axis
};

/// Measured, not believed: nothing where the lens is not symmetric about its axis, where its radius does not grow from
/// 0 with the angle, or where a cone around the axis is not seen. `margin_px` is for rounding.
std::optional<LensBound> lens_bound(const Lens& lens, double margin_px);

enum class BoundingShape { triangles, quad };

/// A convex polygon of the image.
struct BoundingPart {
  std::vector<glm::dvec2> corners;  ///< pixels, three or four in order around it

  bool contains(const glm::dvec2& pixel) const;
  double area() const;  ///< square pixels
};

/// Polygons that enclose the image of a triangle, as far as the lens sees it and the image shows it; each ray belongs
/// to exactly one part. In single precision. `corners`: relative to the camera's centre, camera frame, metres.
std::vector<BoundingPart> bounding_parts(const Lens& lens, const LensBound& bound, BoundingShape shape,
                                         const std::array<glm::vec3, 3>& corners);

}  // namespace omma
