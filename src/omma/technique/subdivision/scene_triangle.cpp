#include "omma/technique/subdivision/scene_triangle.h"

namespace omma {
namespace {

constexpr GLuint triangle_attribute = 6;  // after those of a record

}  // namespace

SceneTriangle scene_triangle(const GpuScene& scene, const ScenePixels& pixels, const Part& part, uint32_t number) {
  const bool double_sided = scene.scene().materials[size_t(part.material)].double_sided;
  return {uint32_t(part.instance), part.first_triangle + number, pixels.offset(part.instance),
          double_sided    ? 0.0f
          : part.mirrored ? -1.0f
                          : 1.0f};
}

gl::VertexArray create_triangle_array(GLuint divisor) {
  gl::VertexArray array = gl::create_vertex_array();
  glEnableVertexArrayAttrib(array.id(), triangle_attribute);
  glVertexArrayAttribIFormat(array.id(), triangle_attribute, 4, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array.id(), triangle_attribute, 0);
  glVertexArrayBindingDivisor(array.id(), 0, divisor);
  return array;
}

const gl::Program& split_program(DrawTools& tools, const View& view, const LensField& field, SplitForm form,
                                 bool sorted) {
  gl::Defines defines = subdivision_defines(field, view);
  if (form == SplitForm::to_even) defines["TESSELLATED"] = "";
  if (sorted) defines["SORTED"] = "";
  return tools.programs.get({{GL_VERTEX_SHADER, "technique/subdivision/candidate.vert"},
                             {GL_GEOMETRY_SHADER, "technique/subdivision/split.geom"}},
                            defines);
}

}  // namespace omma
