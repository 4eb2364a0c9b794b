#include "omma/technique/visibility/gpu_bodies.h"

#include <algorithm>
#include <bit>

#include "omma/base/error.h"

namespace omma {
namespace {

constexpr uint32_t clusters_in_group = 16;
constexpr size_t most_placed_groups = size_t(1) << 24;  ///< of 256 triangles, whose numbers have 32 bits

/// As in shaders/technique/visibility/bodies.glsl.
struct PlacementRecord {
  glm::vec4 cameraFromBody[3];  ///< columns, scaled, and the origin
  float scale, pad;
  uint32_t first_part, blended;
};

/// As in shaders/technique/visibility/turned_triangle.glsl and coverage.glsl.
struct PartRecord {
  float front;
  uint32_t alpha;
  float cutoff;
  uint32_t first_triangle;
  uint32_t first_texel;
  float base_alpha;
  uint32_t unused[2];
  uint32_t first_alpha, width, height, wraps;
};

/// Of each cluster, from the tree over them.
std::vector<Box> cluster_boxes(const Body& body) {
  std::vector<Box> boxes(body.clusters.size());
  for (const BoxNode& node : body.tree.nodes) {
    for (uint32_t lane = 0; lane < node.count; ++lane) {
      if (node.child[lane] & BoxNode::leaf) boxes[node.child[lane] & ~BoxNode::leaf] = node.box(lane);
    }
  }
  return boxes;
}

}  // namespace

GpuBodies::GpuBodies(const GpuScene& gpu_scene, const SceneIndex& index, const gl::Limits& limits)
    : gpu_scene_(gpu_scene), index_(index), most_texels_(size_t(limits.buffer_texels)) {
  upload_alphas();
  update();
}

void GpuBodies::check(size_t texels, const char* of_what) const {
  if (texels > most_texels_) {
    throw MachineError("{} need {} texels of a buffer, this driver has {}", of_what, texels, most_texels_);
  }
}

void GpuBodies::upload_alphas() {
  const Scene& scene = index_.scene();
  std::vector<bool> used(scene.textures.size(), false);
  for (const Material& material : scene.materials) {
    has_holes_ |= material.alpha != Material::Alpha::opaque;
    if (material.alpha != Material::Alpha::opaque && material.base_color_texture >= 0) {
      used[size_t(material.base_color_texture)] = true;
    }
  }
  std::vector<uint8_t> alphas;
  for (size_t t = 0; t < scene.textures.size(); ++t) {
    first_alpha_.push_back(uint32_t(alphas.size()));
    if (!used[t]) continue;
    for (const auto& texel : scene.textures[t].texels) alphas.push_back(texel.a);
    check(alphas.size(), "the textures of materials with holes");
  }
  alphas_.write(std::span<const uint8_t>(alphas));
}

void GpuBodies::update() {
  std::vector<BoxRecord> groups, clusters;
  std::vector<uint32_t> triangles;
  first_group_.clear();
  for (const Body& body : index_.bodies().bodies()) {
    first_group_.push_back(uint32_t(groups.size()));
    const std::vector<Box> boxes = cluster_boxes(body);
    const auto record = [](const Box& box, size_t first, size_t count) {
      BoxNode rounded;
      rounded.set_box(0, box);
      return BoxRecord{{rounded.centre[0][0], rounded.centre[1][0], rounded.centre[2][0]},
                       uint32_t(first),
                       {rounded.half[0][0], rounded.half[1][0], rounded.half[2][0]},
                       uint32_t(count)};
    };
    for (size_t first = 0; first < boxes.size(); first += clusters_in_group) {
      const size_t count = std::min<size_t>(clusters_in_group, boxes.size() - first);
      Box whole;
      for (size_t i = first; i < first + count; ++i) whole.add(boxes[i]);
      groups.push_back(record(whole, clusters.size(), count));
      for (size_t i = first; i < first + count; ++i) clusters.push_back(record(boxes[i], body.part[i], Cluster::size));
    }
    for (const Cluster& cluster : body.clusters) {
      triangles.insert(triangles.end(), cluster.triangle, cluster.triangle + Cluster::size);
    }
  }
  first_group_.push_back(uint32_t(groups.size()));
  check(triangles.size(), "the triangles of the scene");
  groups_.write(std::span<const BoxRecord>(groups));
  clusters_.write(std::span<const BoxRecord>(clusters));
  triangles_.write(std::span<const uint32_t>(triangles));
}

void GpuBodies::place(const PlacedScene& seen) {
  const Scene& scene = index_.scene();
  std::vector<PlacementRecord> placements;
  std::vector<PartRecord> parts;
  std::vector<glm::uvec2> placed_groups;
  for (const PlacedBody& placed : seen.bodies()) {
    PlacementRecord record{{}, placed.scale, placed.pad, uint32_t(parts.size()), placed.blended ? 1u : 0u};
    for (int axis = 0; axis < 3; ++axis) record.cameraFromBody[axis] = {placed.columns[axis], placed.origin[axis]};
    const auto shape = size_t(placed.body - index_.bodies().bodies().data());
    for (uint32_t group = first_group_[shape]; group < first_group_[shape + 1]; ++group) {
      placed_groups.emplace_back(placements.size(), group);
    }
    placements.push_back(record);
    for (size_t i = 0; i < placed.body->meshes.size(); ++i) {
      const PlacedPart& part = placed.parts[i];
      const auto mesh = size_t(placed.body->meshes[i]);
      const Material& material = scene.materials[size_t(part.mesh->material)];
      PartRecord& made = parts.emplace_back(PartRecord{part.front,
                                                       uint32_t(part.alpha),
                                                       part.cutoff,
                                                       part.first_triangle,
                                                       gpu_scene_.first_triangle(mesh),
                                                       material.base_color.a,
                                                       {},
                                                       0,
                                                       0,
                                                       0,
                                                       0});
      if (part.hidden) {  // whatever it covers is too little
        made.alpha = uint32_t(Material::Alpha::mask);
        made.cutoff = std::numeric_limits<float>::infinity();
        has_holes_ = true;
      }
      if (material.base_color_texture < 0 || part.mesh->uvs.empty()) continue;
      const Texture& texture = scene.textures[size_t(material.base_color_texture)];
      made.first_alpha = first_alpha_[size_t(material.base_color_texture)];
      made.width = uint32_t(texture.width);
      made.height = uint32_t(texture.height);
      made.wraps = uint32_t(texture.wrap_u) | uint32_t(texture.wrap_v) << 2;
    }
  }
  check(3 * parts.size(), "the instances of the scene");
  check(placed_groups.size(), "the triangles of all instances");
  if (placed_groups.size() > most_placed_groups) {
    throw MachineError("{} groups of triangles, each as often as it is placed; visibility:gpu numbers {}",
                       placed_groups.size(), most_placed_groups);
  }
  placed_group_count_ = uint32_t(placed_groups.size());
  placements_.write(std::span<const PlacementRecord>(placements));
  placed_groups_.write(std::span<const glm::uvec2>(placed_groups));
  parts_.write(std::span<const PartRecord>(parts));
}

void GpuBodies::bind() const {
  gpu_scene_.bind_vertex_textures();
  placements_.bind(20);
  placed_groups_.bind(21);
  groups_.bind(22);
  clusters_.bind(23);
  triangles_.bind(24);
  parts_.bind(25);
  alphas_.bind(26);
}

}  // namespace omma
