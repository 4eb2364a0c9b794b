#include "omma/technique/resolve.h"

#include <algorithm>
#include <map>

namespace omma {
namespace {

constexpr int tile_side = 32;

/// The squares of the image in which each material is seen.
std::map<int, std::vector<glm::uvec2>> tiles_of_materials(const VisibleTriangles& visible, const Scene& scene) {
  std::map<int, std::vector<glm::uvec2>> tiles;
  std::vector<int> seen;
  for (int y0 = 0; y0 < visible.size.height; y0 += tile_side) {
    for (int x0 = 0; x0 < visible.size.width; x0 += tile_side) {
      seen.clear();
      uint32_t last_instance = VisibleTriangles::nothing;
      for (int y = y0; y < std::min(y0 + tile_side, visible.size.height); ++y) {
        for (int x = x0; x < std::min(x0 + tile_side, visible.size.width); ++x) {
          const uint32_t instance = visible.hits[size_t(y) * size_t(visible.size.width) + size_t(x)].y;
          if (instance == last_instance || instance == VisibleTriangles::nothing) continue;
          last_instance = instance;
          seen.push_back(scene.meshes[size_t(scene.instances[instance].mesh)].material);
        }
      }
      std::sort(seen.begin(), seen.end());
      seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
      for (int material : seen) tiles[material].emplace_back(x0 / tile_side, y0 / tile_side);
    }
  }
  return tiles;
}

}  // namespace

void Resolver::draw(const View& view, const VisibleTriangles& visible, bool blended) {
  if (!texture_ || texture_size_ != visible.size) {
    texture_ = gl::Texture::image(GL_RG32UI, visible.size);
    texture_size_ = visible.size;
  }
  glTextureSubImage2D(texture_.id(), 0, 0, 0, visible.size.width, visible.size.height, GL_RG_INTEGER, GL_UNSIGNED_INT,
                      visible.hits.data());
  texture_.bind(4);
  tools_.scene.bind();
  tools_.scene.bind_vertex_textures();
  tools_.camera_textures.bind(view.camera);

  // Each pixel's material becomes its depth; squares drawn at a material's depth then meet only that material's pixels.
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  tools_.draw_fullscreen(tools_.programs.get(
      {{GL_VERTEX_SHADER, "common/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "technique/material_depth.frag"}}, {}));
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  if (blended) {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }
  tools_.counters.begin();
  const gl::VertexArray squares = gl::create_vertex_array();
  glEnableVertexArrayAttrib(squares.id(), 0);
  glVertexArrayAttribIFormat(squares.id(), 0, 2, GL_UNSIGNED_INT, 0);
  glVertexArrayBindingDivisor(squares.id(), 0, 1);
  for (const auto& [material, tiles] : tiles_of_materials(visible, tools_.scene.scene())) {
    gl::Defines defines = camera_defines(view.camera);
    defines.merge(output_defines(view.outputs));
    defines.merge(tools_.scene.materials().defines(material, view.anisotropic(), view.labels()));
    defines.merge(effect_defines(view.effects));
    const gl::Program& program = tools_.programs.get(
        {{GL_VERTEX_SHADER, "technique/material_tile.vert"}, {GL_FRAGMENT_SHADER, "technique/resolve.frag"}}, defines);
    program.use();
    set_camera(program, view);
    set_effects(program, view.effects);
    program.set("target_size", glm::vec2(visible.size.width, visible.size.height));
    program.set("side", float(tile_side));
    program.set("material", unsigned(material));
    tools_.scene.materials().bind(material, view.anisotropic());
    const gl::Buffer buffer{std::span<const glm::uvec2>(tiles)};
    glVertexArrayVertexBuffer(squares.id(), 0, buffer.id(), 0, sizeof(glm::uvec2));
    glBindVertexArray(squares.id());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(tiles.size()));
  }
  tools_.counters.end();
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace omma
