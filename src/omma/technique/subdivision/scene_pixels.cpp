#include "omma/technique/subdivision/scene_pixels.h"

#include "omma/technique/subdivision/capture.h"

namespace omma {

ScenePixels::ScenePixels(DrawTools& tools) : tools_(tools) {
  const Scene& scene = tools.scene.scene();
  std::vector<DrawArraysCommand> commands;
  size_t count = 0;
  for (size_t p = 0; p < tools.scene.parts().size(); ++p) {
    const int instance = tools.scene.parts()[p].instance;
    if (offsets_.size() > size_t(instance)) continue;  // a further part of an instance that is there
    const auto mesh = size_t(scene.instances[size_t(instance)].mesh);
    const uint32_t first = tools.scene.first_vertex(mesh);
    const auto vertices = uint32_t(scene.meshes[mesh].positions.size());
    while (offsets_.size() <= size_t(instance)) offsets_.push_back(uint32_t(count) - first);
    commands.push_back({vertices, 1, first, GLuint(p)});
    count += vertices;
  }
  offset_texels_.write(std::span<const uint32_t>(offsets_));
  commands_ = gl::Buffer(std::span<const DrawArraysCommand>(commands));
  command_count_ = GLsizei(commands.size());
  pixels_.reserve(count * sizeof(glm::vec2));
}

void ScenePixels::project(const View& view, const LensField& field) {
  const gl::Program& program =
      tools_.programs.get({{GL_VERTEX_SHADER, "technique/subdivision/project.vert"}}, subdivision_defines(field, view));
  program.use();
  set_field(program, field, view, 0.0);
  tools_.scene.bind();
  glBindVertexArray(tools_.scene.vertex_array().id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  const Capture capture({{pixels_.buffer()}});
  glMultiDrawArraysIndirect(GL_POINTS, nullptr, command_count_, 0);
}

void ScenePixels::bind() const {
  pixels_.bind(18);
  offset_texels_.bind(19);
}

}  // namespace omma
