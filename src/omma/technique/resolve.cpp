#include "omma/technique/resolve.h"

#include <algorithm>

#include "omma/base/error.h"
#include "omma/technique/effect_program.h"

namespace omma {
namespace {

/// As in shaders/technique/triangle_record.glsl.
size_t record_texels(const gl::Defines& defines) {
  return size_t(7) + 3 * defines.count("TRIANGLE_COLORS") + 3 * defines.count("TRIANGLE_TANGENTS") +
         2 * defines.count("EFFECTS");
}

}  // namespace

Resolver::Resolver(DrawTools& tools) : tools_(tools), squares_(tools.scene.scene()) {
  for (const Mesh& mesh : tools.scene.scene().meshes) has_colors_ |= !mesh.colors.empty();
  for (const Material& material : tools.scene.scene().materials) has_tangents_ |= material.normal_texture >= 0;
  glEnableVertexArrayAttrib(squares_array_.id(), 0);
  glVertexArrayAttribIFormat(squares_array_.id(), 0, 2, GL_UNSIGNED_INT, 0);
  glVertexArrayBindingDivisor(squares_array_.id(), 0, 1);
}

size_t Resolver::samples_at_once(ImageSize size) const {
  // Where every sample sees something else, each is a fragment. The sheet of them has room between its materials.
  constexpr size_t most = size_t(1) << 25;
  const size_t pixels = std::max<size_t>(1, size_t(size.width) * size_t(size.height));
  const size_t fitting = std::min(most, size_t(tools_.context.limits().buffer_texels) / 2) / pixels;
  return std::clamp<size_t>(fitting, 1, SampleFragments::most_samples);
}

void Resolver::draw(const View& view, const Target& target) {
  target.begin();
  if (fragments_.count() > 1) {
    draw_several(view, target);
  } else {
    draw_one(view);
  }
}

void Resolver::draw_one(const View& view) {
  set(view, fragments_.first());
  const Canvas canvas{view.size(), squares_.squares()};
  // A pixel without a ray is black; labels were cleared to nothing.
  if (!view.labels()) {
    if (view.camera.pieces() != nullptr) {
      tools_.draw_background(view);
    } else {
      clear_to_black();
      draw_background(view, canvas);
    }
  }
  draw_surfaces(view, canvas);
}

void Resolver::draw_several(const View& view, const Target& target) {
  fragments_.finish(view.shifts);
  for (const auto& fragment : fragments_.further()) {
    if (fragment.hit.x != VisibleTriangles::nothing) squares_.see(fragment.hit.x);
  }
  set(view, fragments_.first());
  coverage_.write(std::span<const SampleCoverage>(fragments_.first_coverage()));
  coverage_.bind(17);
  clear_to_black();
  const Canvas picture{view.size(), squares_.squares(), {{"SAMPLES", ""}}};
  draw_background(view, picture);
  draw_surfaces(view, picture);
  if (fragments_.further().empty()) return;

  sheet_.lay_out(view.size(), fragments_.further(), squares_);
  sheet_.begin();
  const Canvas sheet{sheet_.size(), sheet_.squares(), {{"SAMPLES", ""}, {"ON_SHEET", ""}}};
  draw_background(view, sheet);
  draw_surfaces(view, sheet);
  target.bind();
  add_sheet(view, picture);
}

void Resolver::draw_over(const View& view, const VisibleTriangles& visible) {
  set(view, visible);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_surfaces(view, {view.size(), squares_.squares()});
  glDisable(GL_BLEND);
}

gl::Defines Resolver::record_defines(const View& view) const {
  gl::Defines defines;
  if (!view.effects.empty()) defines["EFFECTS"] = "";
  if (has_colors_) defines["TRIANGLE_COLORS"] = "";
  if (has_tangents_) defines["TRIANGLE_TANGENTS"] = "";
  return defines;
}

void Resolver::set(const View& view, const VisibleTriangles& visible) {
  const size_t pixels = size_t(visible.size.width) * size_t(visible.size.height);
  if (const auto most = size_t(tools_.context.limits().buffer_texels); pixels > most) {
    throw MachineError("an image of {} x {} pixels does not fit into this driver's buffers of {} texels; set a tile",
                       visible.size.width, visible.size.height, most);
  }
  pixels_.reserve(pixels * sizeof(uint32_t));
  {
    const gl::WriteMapping<uint32_t> places(pixels_.buffer(), pixels);
    squares_.sort(visible, places.values());
  }
  const std::vector<glm::uvec2>& triangles = squares_.triangles();
  triangles_.write(std::span<const glm::uvec2>(triangles));
  const gl::Defines defines = record_defines(view);
  if (const auto most = size_t(tools_.context.limits().buffer_texels);
      triangles.size() * record_texels(defines) > most) {
    throw MachineError("{} visible triangles do not fit into this driver's buffers of {} texels; set a tile",
                       triangles.size(), most);
  }
  const size_t record_bytes = record_texels(defines) * sizeof(glm::vec4);
  records_.reserve(std::max<size_t>(1, triangles.size()) * record_bytes);

  tools_.scene.bind();
  tools_.scene.bind_vertex_textures();
  tools_.camera_textures.bind(view.camera);
  pixels_.bind(4);
  triangles_.bind(10);
  records_.bind(11);
  if (triangles.empty()) return;
  tools_.programs.get({{GL_VERTEX_SHADER, "technique/triangle_record.vert"}}, defines).use();
  glBindVertexArray(tools_.no_vertices.id());
  glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, records_.buffer().id(), 0,
                    GLsizeiptr(triangles.size() * record_bytes));
  glEnable(GL_RASTERIZER_DISCARD);
  glBeginTransformFeedback(GL_POINTS);
  glDrawArrays(GL_POINTS, 0, GLsizei(triangles.size()));
  glEndTransformFeedback();
  glDisable(GL_RASTERIZER_DISCARD);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

void Resolver::draw_squares(const gl::Program& program, const View& view, const Canvas& canvas,
                            const std::vector<glm::uvec2>& squares) {
  program.use();
  set_camera(program, view);
  program.set("visible_width", canvas.size.width);
  program.set("target_size", glm::vec2(canvas.size.width, canvas.size.height));
  if (!view.shifts.empty()) program.set("sample_share", 1.0f / float(view.shifts.size()));
  program.set("side", float(VisibleSquares::side));
  const gl::Buffer buffer{std::span<const glm::uvec2>(squares)};
  glVertexArrayVertexBuffer(squares_array_.id(), 0, buffer.id(), 0, sizeof(glm::uvec2));
  glBindVertexArray(squares_array_.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(squares.size()));
}

void Resolver::clear_to_black() {
  const GLfloat black[4] = {0.0f, 0.0f, 0.0f, 1.0f};
  glClearBufferfv(GL_COLOR, 0, black);
}

void Resolver::draw_background(const View& view, const Canvas& canvas) {
  const auto found = canvas.squares.find(VisibleSquares::background);
  if (found == canvas.squares.end()) return;
  gl::Defines defines = camera_defines(view.camera);
  defines.insert(canvas.defines.begin(), canvas.defines.end());
  draw_squares(tools_.programs.get({{GL_VERTEX_SHADER, "technique/material_tile.vert"},
                                    {GL_FRAGMENT_SHADER, "technique/resolve_background.frag"}},
                                   defines),
               view, canvas, found->second);
}

void Resolver::draw_surfaces(const View& view, const Canvas& canvas) {
  tools_.counters.begin();
  for (const auto& [material, squares] : canvas.squares) {
    if (material == VisibleSquares::background) continue;
    gl::Defines defines = camera_defines(view.camera);
    defines.insert(canvas.defines.begin(), canvas.defines.end());
    defines.merge(record_defines(view));
    defines.merge(tools_.surface_defines(view, material));
    const gl::Program& program = tools_.programs.get(
        {{GL_VERTEX_SHADER, "technique/material_tile.vert"}, {GL_FRAGMENT_SHADER, "technique/resolve.frag"}}, defines);
    set_effects(program, view.effects);
    program.set("material_number", material);
    tools_.scene.materials().bind(material, view.anisotropic());
    draw_squares(program, view, canvas, squares);
  }
  tools_.counters.end();
}

void Resolver::add_sheet(const View& view, const Canvas& canvas) {
  sheet_.bind();
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  draw_squares(tools_.programs.get({{GL_VERTEX_SHADER, "technique/material_tile.vert"},
                                    {GL_FRAGMENT_SHADER, "technique/add_fragments.frag"}},
                                   {}),
               view, canvas, sheet_.picture_squares());
  glDisable(GL_BLEND);
}

// Layer by layer from the farthest. A pixel with fewer surfaces than its neighbour joins in at the nearer layers.
void Resolver::draw_layers(const View& view, const std::vector<std::vector<RayHit>>& surfaces) {
  size_t layers = 0;
  for (const auto& along_ray : surfaces) layers = std::max(layers, along_ray.size());
  VisibleTriangles visible{view.size(), std::vector<glm::uvec2>(surfaces.size())};
  for (size_t layer = layers; layer-- > 0;) {
    for (size_t i = 0; i < surfaces.size(); ++i) {
      visible.hits[i] = layer < surfaces[i].size()
                            ? glm::uvec2(surfaces[i][layer].triangle, surfaces[i][layer].instance)
                            : glm::uvec2(VisibleTriangles::nothing);
    }
    draw_over(view, visible);
  }
}

}  // namespace omma
