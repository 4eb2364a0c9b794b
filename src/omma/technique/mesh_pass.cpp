#include "omma/technique/mesh_pass.h"

#include <algorithm>
#include <map>

#include "omma/technique/target.h"

namespace omma {
namespace {

struct DrawCommand {  // as glMultiDrawElementsIndirect reads it
  GLuint count, instance_count, first_index;
  GLint base_vertex;
  GLuint base_instance;
};

DrawCommand command(const Part& part, size_t number) {
  return {part.index_count, 1, part.first_index, 0, GLuint(number)};
}

void multi_draw(const std::vector<DrawCommand>& commands) {
  const gl::Buffer buffer{std::span<const DrawCommand>(commands)};
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, GLsizei(commands.size()), 0);
}

}  // namespace

bool may_be_in_frustum(const glm::dmat4& clipFromWorld, const Bounds& world) {
  int beyond = 15;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 clip =
        clipFromWorld * glm::dvec4(corner & 1 ? world.max.x : world.min.x, corner & 2 ? world.max.y : world.min.y,
                                   corner & 4 ? world.max.z : world.min.z, 1.0);
    beyond &=
        int(clip.x < -clip.w) | int(clip.x > clip.w) << 1 | int(clip.y < -clip.w) << 2 | int(clip.y > clip.w) << 3;
  }
  return beyond == 0;
}

void MeshDrawer::use(const MeshPass& pass, const View& view, int material, bool mirrored) {
  gl::Defines defines = pass.defines;
  defines.merge(output_defines(view.outputs));
  defines.merge(tools_.scene.materials().defines(material, view.anisotropic(), view.labels()));
  std::vector<gl::Stage> stages = pass.stages;
  stages.push_back({GL_FRAGMENT_SHADER, "technique/mesh.frag"});
  const gl::Program& program = tools_.programs.get(stages, defines);
  program.use();
  pass.set_uniforms(program);
  tools_.scene.materials().bind(material, view.anisotropic());

  // Image rows run downwards, which turns windings round once; a mirrored transform turns them again.
  const bool cull = !tools_.scene.scene().materials[size_t(material)].double_sided;
  glFrontFace(mirrored ? GL_CCW : GL_CW);
  (cull ? glEnable : glDisable)(GL_CULL_FACE);
  program.set("cull_sign", cull ? (mirrored ? -1.0f : 1.0f) : 0.0f);
}

void MeshDrawer::draw(const MeshPass& pass, const View& view) {
  glBindVertexArray(tools_.scene.vertex_array().id());
  tools_.scene.bind();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  tools_.counters.begin();
  draw_solid(pass, view);
  if (!view.labels() && tools_.scene.has_blending()) draw_blended(pass, view);
  tools_.counters.end();
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
}

void MeshDrawer::draw_solid(const MeshPass& pass, const View& view) {
  std::map<std::pair<int, bool>, std::vector<DrawCommand>> groups;
  for (size_t i = 0; i < tools_.scene.parts().size(); ++i) {
    const Part& part = tools_.scene.parts()[i];
    const Material& material = tools_.scene.scene().materials[size_t(part.material)];
    if (!view.labels() && material.alpha == Material::Alpha::blend) continue;
    if (pass.may_be_seen(part.bounds)) groups[{part.material, part.mirrored}].push_back(command(part, i));
  }
  for (const auto& [group, commands] : groups) {
    use(pass, view, group.first, group.second);
    multi_draw(commands);
  }
}

void MeshDrawer::draw_blended(const MeshPass& pass, const View& view) {
  struct BlendedTriangle {
    double distance2;
    size_t part;
    glm::uvec3 corners;
  };
  const Scene& scene = tools_.scene.scene();
  const glm::dvec3 eye(tools_.scene.worldFromCamera()[3]);
  std::vector<BlendedTriangle> triangles;
  for (size_t p = 0; p < tools_.scene.parts().size(); ++p) {
    const Part& part = tools_.scene.parts()[p];
    if (scene.materials[size_t(part.material)].alpha != Material::Alpha::blend || !pass.may_be_seen(part.bounds))
      continue;
    const Instance& instance = scene.instances[size_t(part.instance)];
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    const uint32_t first = part.first_triangle - instance.first_triangle;
    const uint32_t first_vertex = tools_.scene.first_vertex(size_t(instance.mesh));
    for (uint32_t t = first; t < first + part.index_count / 3; ++t) {
      const glm::uvec3 corners = mesh.triangles[t];
      const glm::dvec3 centroid =
          glm::dvec3(mesh.positions[corners.x] + mesh.positions[corners.y] + mesh.positions[corners.z]) / 3.0;
      const glm::dvec3 offset = glm::dvec3(instance.worldFromObject * glm::dvec4(centroid, 1.0)) - eye;
      triangles.push_back({glm::dot(offset, offset), p, corners + first_vertex});
    }
  }
  if (triangles.empty()) return;
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const auto& a, const auto& b) { return a.distance2 > b.distance2; });
  std::vector<glm::uvec3> sorted;
  for (const BlendedTriangle& triangle : triangles) sorted.push_back(triangle.corners);
  const gl::Buffer indices{std::span<const glm::uvec3>(sorted)};

  glVertexArrayElementBuffer(tools_.scene.vertex_array().id(), indices.id());
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
    while (end < triangles.size() && triangles[end].part == triangles[begin].part) ++end;
    const Part& part = tools_.scene.parts()[triangles[begin].part];
    use(pass, view, part.material, part.mirrored);
    const auto offset = reinterpret_cast<const void*>(begin * sizeof(glm::uvec3));
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, GLsizei(3 * (end - begin)), GL_UNSIGNED_INT, offset, 1,
                                        GLuint(triangles[begin].part));
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glVertexArrayElementBuffer(tools_.scene.vertex_array().id(), tools_.scene.indices().id());
}

}  // namespace omma
