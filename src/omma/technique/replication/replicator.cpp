#include "omma/technique/replication/replicator.h"

#include <algorithm>

#include "omma/base/error.h"
#include "omma/technique/replication/dispatch.h"

namespace omma {
namespace {

constexpr size_t command_bytes = 5 * sizeof(uint32_t);  ///< as in shaders/technique/replication/commands.comp
constexpr size_t max_levels = 7;                        ///< as in shaders/technique/replication/offsets.glsl

/// Grows by half as much again as is needed, so that a moving camera does not make a new one every frame.
void reserve(gl::Buffer& buffer, size_t bytes) {
  if (!buffer || buffer.bytes() < bytes) buffer = gl::Buffer(bytes + bytes / 2);
}

}  // namespace

void Replicator::replicate_clusters(const ConeTree& tree, SceneClusters& clusters, uint32_t cluster_count) {
  clusters.narrow(tools_, tree);
  replicate(tree, clusters, cluster_count, {}, "cluster_count", cluster_count);
}

void Replicator::replicate_items(const ConeTree& tree, const SceneClusters& clusters, std::span<const uint32_t> items) {
  items_.write(items);
  items_.bind(20);
  replicate(tree, clusters, divided_up(uint32_t(items.size()), group_size), {{"ITEM_LIST", "1"}}, "item_count",
            uint32_t(items.size()));
}

void Replicator::replicate(const ConeTree& tree, const SceneClusters& clusters, uint32_t groups, gl::Defines defines,
                           const char* size_name, uint32_t size) {
  level_first_.clear();
  level_sizes_ = {groups * group_size};
  while (level_sizes_.back() > 1) level_sizes_.push_back(divided_up(level_sizes_.back(), group_size));
  uint32_t slots = 0;
  for (uint32_t level_size : level_sizes_) {
    level_first_.push_back(slots);
    slots += level_size;
  }
  reserve(counts_, slots * sizeof(uint32_t));
  reserve(found_pieces_, level_sizes_.front() * sizeof(glm::uvec4));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counts_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, found_pieces_.id());
  tools_.scene.bind();
  clusters.bind();
  tree.bind();

  const auto run = [&](const gl::Defines& with) {
    const gl::Program& program =
        tools_.programs.get({{GL_COMPUTE_SHADER, "technique/replication/replicate.comp"}}, with);
    program.use();
    tree.set_uniforms(program);
    set_levels(program);
    program.set(size_name, size);
    dispatch(groups);
  };
  defines.merge(tree.coverage_defines());
  tools_.timer.mark("count");
  run(defines);
  tools_.timer.mark("sum");
  sum();
  glGetNamedBufferSubData(counts_.id(), GLintptr(level_first_.back() * sizeof(uint32_t)), sizeof(uint32_t),
                          &replica_count_);
  // A draw's vertices have 32-bit numbers, three to a replica.
  const uint32_t most = 0x7fffffffu / indices_per_replica();
  if (replica_count_ > most) {
    throw MachineError(
        "{} replicas of triangles are more than one draw holds, {}; ask for a smaller image or fewer pieces",
        replica_count_, most);
  }
  replicas_.reserve(replica_count_ * sizeof(glm::uvec2));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, replicas_.buffer().id());
  tools_.timer.mark("replicate");
  defines["WRITE"] = "1";
  run(defines);
}

void Replicator::set_levels(const gl::Program& program) const {
  program.set("level_first", std::span<const uint32_t>(level_first_));
  program.set("level_sizes", std::span<const uint32_t>(level_sizes_));
  program.set("level_count", int(level_sizes_.size()));
}

void Replicator::sum() {
  const gl::Program& program = tools_.programs.get({{GL_COMPUTE_SHADER, "technique/replication/scan.comp"}}, {});
  program.use();
  set_levels(program);
  for (size_t level = 0; level + 1 < level_sizes_.size(); ++level) {
    program.set("level", int(level));
    dispatch(divided_up(level_sizes_[level + 1], group_size));
  }
}

void Replicator::prepare_draws(std::span<const glm::uvec2> ranges) {
  reserve(ranges_, ranges.size_bytes());
  ranges_.write(ranges);
  reserve(commands_, ranges.size() * command_bytes);
  reserve_indices();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counts_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, ranges_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, commands_.id());
  const gl::Program& program = tools_.programs.get({{GL_COMPUTE_SHADER, "technique/replication/commands.comp"}}, {});
  program.use();
  set_levels(program);
  program.set("range_count", unsigned(ranges.size()));
  program.set("indices_per_replica", indices_per_replica());
  dispatch(divided_up(uint32_t(ranges.size()), group_size));
}

void Replicator::reserve_indices() {
  if (shape_ == ReplicaShape::triangle) return;
  const size_t per_replica = indices_per_replica(), bytes = per_replica * sizeof(uint32_t);
  if (indices_ && indices_.bytes() >= replica_count_ * bytes) return;
  constexpr uint32_t fan[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5};
  std::vector<uint32_t> indices((replica_count_ + replica_count_ / 2 + 1) * per_replica);
  for (size_t i = 0; i < indices.size(); ++i) indices[i] = uint32_t(i / per_replica) * 6 + fan[i % per_replica];
  indices_ = gl::Buffer(std::span<const uint32_t>(indices));
  glVertexArrayElementBuffer(vertices_.id(), indices_.id());
}

void Replicator::bind() const { replicas_.bind(21); }

void Replicator::draw(size_t range) const {
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  glBindVertexArray(vertices_.id());
  const auto* offset = reinterpret_cast<const void*>(range * command_bytes);
  if (shape_ == ReplicaShape::triangle) {
    glDrawArraysIndirect(GL_TRIANGLES, offset);
  } else {
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, offset);
  }
}

}  // namespace omma
