#include "omma/technique/replication/scene_clusters.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "omma/technique/replication/dispatch.h"

namespace omma {
namespace {

static_assert(part_triangles % SceneClusters::cluster_triangles == 0);
static_assert(part_triangles <= 1u << 10, "an item has ten bits for a triangle of a part");

/// A texel, as in shaders/technique/replication/scene_triangle.glsl.
struct PartRecord {
  uint32_t instance, first_triangle, count;
  float cull_sign;
};

/// Two texels, as in shaders/technique/replication/slots.glsl.
struct ClusterRecord {
  glm::vec4 sphere;
  glm::uvec4 triangles;
};

std::vector<glm::vec4> cluster_spheres(const Mesh& mesh) {
  std::vector<glm::vec4> spheres;
  for (size_t first = 0; first < mesh.triangles.size(); first += SceneClusters::cluster_triangles) {
    const size_t last = std::min(first + SceneClusters::cluster_triangles, mesh.triangles.size());
    Bounds bounds;
    for (size_t t = first; t < last; ++t) {
      for (int c = 0; c < 3; ++c) bounds.add(mesh.positions[mesh.triangles[t][c]]);
    }
    double radius = 0.0;
    for (size_t t = first; t < last; ++t) {
      for (int c = 0; c < 3; ++c) {
        radius = std::max(radius, glm::distance(bounds.center(), glm::dvec3(mesh.positions[mesh.triangles[t][c]])));
      }
    }
    spheres.emplace_back(glm::vec3(bounds.center()), float(radius * 1.00001));
  }
  return spheres;
}

}  // namespace

SceneClusters::SceneClusters(const GpuScene& scene) : scene_(scene), spheres_(scene.scene().meshes.size()) {
  update({});
}

bool SceneClusters::update(const SceneChanges& changes) {
  const Scene& scene = scene_.scene();
  for (size_t m = 0; m < scene.meshes.size(); ++m) {
    if (spheres_[m].empty() || changes.deformed.contains(int(m))) spheres_[m] = cluster_spheres(scene.meshes[m]);
  }

  std::vector<PartRecord> parts;
  std::map<std::tuple<bool, int, bool>, std::vector<ClusterRecord>> sorted;
  for (const Part& part : scene_.parts()) {
    const Instance& instance = scene.instances[size_t(part.instance)];
    const Material& material = scene.materials[size_t(part.material)];
    const uint32_t count = part.index_count / 3;
    const float cull_sign = material.double_sided ? 0.0f : part.mirrored ? -1.0f : 1.0f;
    const std::vector<glm::vec4>& spheres = spheres_[size_t(instance.mesh)];
    auto& clusters = sorted[{material.alpha == Material::Alpha::blend, part.material, part.mirrored}];
    for (uint32_t first = 0; first < count; first += cluster_triangles) {
      const uint32_t in_mesh = part.first_triangle - instance.first_triangle + first;
      clusters.push_back(
          {spheres[in_mesh / cluster_triangles], {parts.size(), first, std::min(cluster_triangles, count - first), 0}});
    }
    parts.push_back({uint32_t(part.instance), part.first_triangle, count, cull_sign});
  }

  const std::vector<ClusterGroup> groups_before = std::exchange(groups_, {});
  std::vector<ClusterRecord> all;
  solid_cluster_count_ = 0;
  for (const auto& [key, clusters] : sorted) {
    const auto& [blended, material, mirrored] = key;
    const auto first = uint32_t(all.size());
    all.insert(all.end(), clusters.begin(), clusters.end());
    groups_.push_back({material, mirrored, blended, first, uint32_t(all.size())});
    if (!blended) solid_cluster_count_ = uint32_t(all.size());
  }
  cluster_count_ = uint32_t(all.size());
  parts_.write(std::span<const PartRecord>(parts));
  clusters_.write(std::span<const ClusterRecord>(all));
  return groups_ != groups_before;
}

void SceneClusters::bind() const {
  scene_.bind_vertex_textures();
  parts_.bind(19);
}

void SceneClusters::narrow(DrawTools& tools, const ConeTree& tree) {
  tools.timer.mark("clusters");
  ranges_.reserve(cluster_count_ * sizeof(glm::uvec2));
  const gl::Program& program = tools.programs.get({{GL_COMPUTE_SHADER, "technique/replication/narrow.comp"}}, {});
  program.use();
  tree.set_uniforms(program);
  program.set("cluster_count", unsigned(cluster_count_));
  scene_.bind();
  tree.bind();
  bind();
  clusters_.bind(20);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, ranges_.buffer().id());
  dispatch(divided_up(cluster_count_, group_size));
  ranges_.bind(25);
}

DrawnGroups SceneClusters::unordered(bool labels) const {
  DrawnGroups drawn;
  for (const ClusterGroup& group : groups_) {
    if (group.blended && !labels) continue;
    drawn.groups.push_back(group);
    drawn.ranges.push_back(cluster_triangles * glm::uvec2(group.first_cluster, group.last_cluster));
    drawn.clusters = group.last_cluster;
  }
  return drawn;
}

}  // namespace omma
