#include "omma/technique/mesh_pass.h"

#include <algorithm>
#include <map>

#include "omma/technique/effect_program.h"
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

SurfaceState::SurfaceState(DrawTools& tools, bool blends) : tools_(tools) {
  glBindVertexArray(tools.scene.vertex_array().id());
  tools.scene.bind();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  if (blends) {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
  }
  tools.counters.begin();
}

SurfaceState::~SurfaceState() {
  tools_.counters.end();
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
}

const gl::Program& use_material(DrawTools& tools, const MeshPass& pass, const View& view, int material, bool mirrored) {
  gl::Defines defines = pass.defines;
  defines.merge(tools.surface_defines(view, material));
  std::vector<gl::Stage> stages = pass.stages;
  stages.push_back({GL_FRAGMENT_SHADER, pass.fragment_shader});
  const gl::Program& program = tools.programs.get(stages, defines);
  program.use();
  pass.set_uniforms(program);
  set_effects(program, view.effects);
  if (!view.effects.empty()) tools.scene.bind_vertex_textures();
  tools.scene.materials().bind(material, view.anisotropic());

  // Image rows run downwards, which turns windings round once; a mirrored transform turns them again.
  const bool cull = !tools.scene.scene().materials[size_t(material)].double_sided;
  glFrontFace(mirrored != pass.mirror_image ? GL_CCW : GL_CW);
  (cull && pass.culls ? glEnable : glDisable)(GL_CULL_FACE);
  program.set("cull_sign", cull ? (mirrored ? -1.0f : 1.0f) : 0.0f);
  return program;
}

std::vector<BlendedTriangle> blended_triangles(const GpuScene& gpu_scene,
                                               const std::function<bool(const Bounds& world)>& may_be_seen) {
  const Scene& scene = gpu_scene.scene();
  const glm::dvec3 eye(gpu_scene.worldFromCamera()[3]);
  std::vector<BlendedTriangle> triangles;
  for (size_t p = 0; p < gpu_scene.parts().size(); ++p) {
    const Part& part = gpu_scene.parts()[p];
    if (scene.materials[size_t(part.material)].alpha != Material::Alpha::blend || !may_be_seen(part.bounds)) continue;
    const Instance& instance = scene.instances[size_t(part.instance)];
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    const uint32_t first = part.first_triangle - instance.first_triangle;
    for (uint32_t t = 0; t < part.index_count / 3; ++t) {
      const glm::uvec3 corners = mesh.triangles[first + t];
      const glm::dvec3 centroid =
          glm::dvec3(mesh.positions[corners.x] + mesh.positions[corners.y] + mesh.positions[corners.z]) / 3.0;
      const glm::dvec3 offset = glm::dvec3(instance.worldFromObject * glm::dvec4(centroid, 1.0)) - eye;
      triangles.push_back({glm::dot(offset, offset), p, t});
    }
  }
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const auto& a, const auto& b) { return a.distance2 > b.distance2; });
  return triangles;
}

void MeshDrawer::draw(const MeshPass& pass, const View& view) {
  draw_solid(pass, view);
  if (!view.labels() && tools_.scene.has_blending()) draw_blended(pass, view);
}

void MeshDrawer::draw_solid(const MeshPass& pass, const View& view) {
  const SurfaceState state(tools_, false);
  std::map<std::pair<int, bool>, std::vector<DrawCommand>> groups;
  for (size_t i = 0; i < tools_.scene.parts().size(); ++i) {
    const Part& part = tools_.scene.parts()[i];
    const Material& material = tools_.scene.scene().materials[size_t(part.material)];
    if (!view.labels() && material.alpha == Material::Alpha::blend) continue;
    if (pass.may_be_seen(part.bounds)) groups[{part.material, part.mirrored}].push_back(command(part, i));
  }
  for (const auto& [group, commands] : groups) {
    use_material(tools_, pass, view, group.first, group.second);
    multi_draw(commands);
  }
}

void MeshDrawer::draw_blended(const MeshPass& pass, const View& view) {
  const std::vector<BlendedTriangle> triangles = blended_triangles(tools_.scene, pass.may_be_seen);
  if (triangles.empty()) return;
  const std::vector<Part>& parts = tools_.scene.parts();
  const Scene& scene = tools_.scene.scene();
  std::vector<glm::uvec3> sorted;
  std::vector<uint32_t> ids;
  for (const BlendedTriangle& triangle : triangles) {
    const Part& part = parts[triangle.part];
    const Instance& instance = scene.instances[size_t(part.instance)];
    const uint32_t number = part.first_triangle - instance.first_triangle + triangle.number;
    sorted.push_back(scene.meshes[size_t(instance.mesh)].triangles[number] +
                     tools_.scene.first_vertex(size_t(instance.mesh)));
    ids.push_back(part.first_triangle + triangle.number);
  }
  const gl::Buffer indices{std::span<const glm::uvec3>(sorted)};
  const gl::Buffer id_buffer{std::span<const uint32_t>(ids)};
  const gl::Texture id_texels = gl::Texture::of_buffer(GL_R32UI, id_buffer);
  id_texels.bind(24);
  MeshPass sorted_pass = pass;
  sorted_pass.defines["SORTED"] = "";

  const SurfaceState state(tools_, true);
  glVertexArrayElementBuffer(tools_.scene.vertex_array().id(), indices.id());
  for (size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
    while (end < triangles.size() && triangles[end].part == triangles[begin].part) ++end;
    const Part& part = parts[triangles[begin].part];
    use_material(tools_, sorted_pass, view, part.material, part.mirrored).set("first_sorted", int(begin));
    const auto offset = reinterpret_cast<const void*>(begin * sizeof(glm::uvec3));
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, GLsizei(3 * (end - begin)), GL_UNSIGNED_INT, offset, 1,
                                        GLuint(triangles[begin].part));
  }
  glVertexArrayElementBuffer(tools_.scene.vertex_array().id(), tools_.scene.indices().id());
}

}  // namespace omma
