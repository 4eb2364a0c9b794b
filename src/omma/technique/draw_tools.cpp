#include "omma/technique/effect_program.h"
#include "omma/technique/technique.h"

namespace omma {

void DrawTools::draw_fullscreen(const gl::Program& program) {
  program.use();
  glBindVertexArray(no_vertices.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DrawTools::multisampled(const View& view, const Target& target, const std::function<void(const Target&)>& draw) {
  if (view.samples() <= 1) return draw(target);
  if (!multisample_target.fits(view.size(), view.outputs, view.samples())) {
    multisample_target = Target(view.size(), view.outputs, view.samples());
  }
  draw(multisample_target);
  multisample_target.resolve_color(target);
}

gl::Defines DrawTools::surface_defines(const View& view, int material) const {
  gl::Defines defines = output_defines(view.outputs);
  defines.merge(scene.materials().defines(material, view.anisotropic(), view.labels()));
  defines.merge(effect_defines(view.effects));
  if (scene.has_shadows() && !view.labels()) defines["SHADOWS"] = "1";
  if (scene.reflects(material) && !view.labels()) defines["REFLECTION"] = "1";
  if (scene.hides()) defines["HIDDEN_OBJECT"] = "1";
  return defines;
}

void DrawTools::draw_background(const View& view) {
  if (view.outputs.empty()) return;
  scene.bind();
  camera_textures.bind(view.camera);
  if (view.camera.pieces() != nullptr) return draw_background_in_pieces(view);
  gl::Defines defines = camera_defines(view.camera);
  if (!view.labels()) defines["OUTPUT_COLOR"] = "0";
  const bool multisamples = view.samples() > 1;
  if (multisamples) defines["SAMPLES"] = std::to_string(view.samples());
  const gl::Program& program = programs.get(
      {{GL_VERTEX_SHADER, "common/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "common/background.frag"}}, defines);
  set_camera(program, view);
  if (multisamples) {
    const GLfloat nearest = 1.0f;
    glClearBufferfv(GL_DEPTH, 0, &nearest);
    program.set("sample_places", view.sample_places);
  }
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  // What a program leaves unwritten is undefined: for labels only the depth may change.
  const GLboolean writes_color = view.labels() ? GL_FALSE : GL_TRUE;
  glColorMask(writes_color, writes_color, writes_color, writes_color);
  draw_fullscreen(program);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void DrawTools::draw_background_in_pieces(const View& view) {
  if (view.labels()) return;
  const GLfloat black[4] = {0.0f, 0.0f, 0.0f, 1.0f};
  glClearBufferfv(GL_COLOR, 0, black);
  const gl::Program& program = programs.get(
      {{GL_VERTEX_SHADER, "technique/piecewise/sky.vert"}, {GL_FRAGMENT_SHADER, "technique/piecewise/sky.frag"}}, {});
  const auto count = GLsizei(view.camera.pieces()->pieces().size());
  program.use();
  program.set("pixel_offset", view.pixel_offset());
  program.set("tile_size", glm::vec2(view.size().width, view.size().height));
  program.set("piece_count", int(count));
  glBindVertexArray(no_vertices.id());
  glDrawArraysInstanced(GL_TRIANGLE_FAN, 0, 4, count);
}

void DrawTools::draw_piece_borders(const View& view, const Camera& camera) {
  View of_pieces{.camera = camera, .worldFromCamera = view.worldFromCamera, .tile = view.tile};
  of_pieces.shift = view.shift;
  camera_textures.bind(camera);
  const gl::Program& program = programs.get(
      {{GL_VERTEX_SHADER, "common/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "technique/piecewise/show_pieces.frag"}},
      camera_defines(camera));
  set_camera(program, of_pieces);
  draw_fullscreen(program);
}

}  // namespace omma
