// What goes into the first pass.
#pragma once

#include "omma/technique/subdivision/scene_pixels.h"

namespace omma {

/// A triangle of the scene, or the first one of a part. The attribute of technique/subdivision/candidate.vert.
struct SceneTriangle {
  uint32_t instance, id;
  uint32_t pixel_offset;  ///< what is added to a vertex's number for its pixel
  float cull_sign;        ///< 1: it is left out when it turns away; -1: in a mirrored instance; 0: never
};

/// `number`: in the part.
SceneTriangle scene_triangle(const GpuScene& scene, const ScenePixels& pixels, const Part& part, uint32_t number);

/// A vertex array of SceneTriangles, one for each vertex or, with divisor 1, for each instance.
gl::VertexArray create_triangle_array(GLuint divisor);

/// What is done of the splitting.
enum class SplitForm {
  all,      ///< what comes out is drawn as it is
  to_even,  ///< until a tessellation unit can halve each edge as often as it takes
};

/// A pass with technique/subdivision/split.geom. `sorted`: all into one list, nothing left to a tessellation unit.
const gl::Program& split_program(DrawTools& tools, const View& view, const LensField& field, SplitForm form,
                                 bool sorted);

}  // namespace omma
