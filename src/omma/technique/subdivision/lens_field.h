// How far a lens sees, and how finely.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/gl/program.h"
#include "omma/technique/view.h"

namespace omma {

struct LensField {
  glm::vec3 axis;                       ///< unit, camera frame
  double angle;                         ///< radians from the axis that the image reaches to
  LensParameters wide;                  ///< the lens's, seeing further than the image shows where the formula goes on
  double longest_edge;                  ///< radians; edges longer than this are split whatever the lens
  std::vector<glm::vec2> part_corners;  ///< four for each part within which the lens is smooth, pixels; or none
  double pixels_per_radian;             ///< at the image's centre
};

/// True where overlapping parts of the image show the same rays: a direction's one pixel is then not enough.
bool shows_rays_twice(const Lens& lens);

LensField field_of(const Camera& camera);

/// What every program of the technique is compiled with.
gl::Defines subdivision_defines(const LensField& field, const View& view);

/// The uniforms of technique/subdivision/edge.glsl and screen.glsl.
void set_field(const gl::Program& program, const LensField& field, const View& view, double tolerance_px);

}  // namespace omma
