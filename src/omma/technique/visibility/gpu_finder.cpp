#include "omma/technique/visibility/gpu_finder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

#include "omma/base/error.h"
#include "omma/technique/replication/dispatch.h"

namespace omma {
namespace {

// Counters: of the list that each step of a pass writes, then these.
constexpr uint32_t needed_counter = 14, layer_counter = 15, counter_count = 16;
constexpr size_t distance_steps = 512;  ///< as in shaders/technique/visibility/distance.glsl
constexpr int most_batches = 4;
constexpr uint32_t first_capacity = 1 << 16;

/// As `Solid` is to shaders/technique/visibility/groups.comp.
enum : uint32_t { look_for_opaque, look_for_labels, look_for_blended };

constexpr const char* folder = "technique/visibility/";

const gl::Program& program_of(DrawTools& tools, const char* file, const gl::Defines& defines) {
  const gl::Program& program = tools.programs.get({{GL_COMPUTE_SHADER, std::string(folder) + file}}, defines);
  program.use();
  return program;
}

void bind_storage(GLuint binding, const gl::Buffer& buffer) {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.id());
}

void fill(const gl::Buffer& buffer, uint32_t value, size_t first, size_t count) {
  glClearNamedBufferSubData(buffer.id(), GL_R32UI, GLintptr(first * sizeof(uint32_t)),
                            GLsizeiptr(count * sizeof(uint32_t)), GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

template <typename T>
std::vector<T> read(const gl::Buffer& buffer, size_t count) {
  std::vector<T> values(count);
  glGetNamedBufferSubData(buffer.id(), 0, GLsizeiptr(count * sizeof(T)), values.data());
  return values;
}

void reserve(gl::Buffer& buffer, size_t bytes) {
  if (!buffer || buffer.bytes() < bytes) buffer = gl::Buffer(bytes + bytes / 2);
}

/// The instance that a triangle belongs to.
uint32_t instance_of(const Scene& scene, uint32_t triangle) {
  const auto next = std::upper_bound(scene.instances.begin(), scene.instances.end(), triangle,
                                     [](uint32_t id, const Instance& i) { return id < i.first_triangle; });
  return uint32_t(next - scene.instances.begin()) - 1;
}

}  // namespace

GpuFinder::GpuFinder(DrawTools& tools, uint32_t most_entries)
    : tools_(tools),
      index_(tools.index.get()),
      bodies_(tools.scene, index_, tools.context.limits()),
      most_capacity_(
          uint32_t(std::min({size_t(tools.context.limits().buffer_texels),
                             tools.context.limits().storage_bytes / sizeof(glm::uvec4), size_t(most_entries)}))),
      seen_(tools.context.limits().atomics_64 ? GL_RG32UI : GL_R32UI),
      dispatch_(3 * sizeof(uint32_t)) {
  counts_.reserve(counter_count * sizeof(uint32_t));
  batches_.reserve(most_batches * sizeof(uint32_t));
  steps_ = gl::Buffer(distance_steps * sizeof(uint32_t));
  reserve_lists(std::min(first_capacity, most_capacity_));
}

gl::Defines GpuFinder::defines() const {
  gl::Defines defines;
  if (tools_.context.limits().atomics_64) defines["ATOMIC_64"] = "";
  return defines;
}

void GpuFinder::update() { bodies_.update(); }

void GpuFinder::set_view(const glm::dmat4& worldFromCamera) { bodies_.place(PlacedScene(index_, worldFromCamera)); }

void GpuFinder::reserve_lists(uint32_t capacity) {
  capacity_ = capacity;
  for (gl::Texels& list : lists_) list.reserve(capacity * sizeof(glm::uvec2));
}

void GpuFinder::reset_needed() { fill(counts_.buffer(), 0, needed_counter, 1); }

uint32_t GpuFinder::needed() const { return read<uint32_t>(counts_.buffer(), counter_count)[needed_counter]; }

void GpuFinder::make_room(const GpuRays& rays, uint32_t needed) {
  if (needed <= most_capacity_) return reserve_lists(std::min(most_capacity_, needed + needed / 4));
  if (capacity_ < most_capacity_) reserve_lists(most_capacity_);
  if (portions_ >= pair_count(rays)) {
    throw MachineError("256 triangles reach {} parts of the image, this driver's lists hold {}; set a tile", needed,
                       most_capacity_);
  }
  portions_ *= 2;
}

GpuFinder::Pairs GpuFinder::pairs_from(const GpuRays& rays, uint32_t first) const {
  const uint32_t count = pair_count(rays);
  return {first, first + std::min(count - first, divided_up(count, portions_))};
}

// Runs a program over the list that the step before has written.
void GpuFinder::run_listed(const gl::Program& program, uint32_t from, uint32_t invocations, uint32_t to) {
  bind_storage(0, counts_.buffer());
  bind_storage(1, dispatch_);
  const gl::Program& prepare = program_of(tools_, "prepare.comp", {});
  prepare.set("task_counter", from);
  prepare.set("task_capacity", capacity_);
  prepare.set("needed_counter", needed_counter);
  prepare.set("invocations", invocations);
  dispatch(1);

  program.use();
  program.set("task_counter", from);
  program.set("task_capacity", capacity_);
  program.set("list_counter", to);
  program.set("list_capacity", capacity_);
  bind_storage(1, lists_[(from + 1) % 2].buffer());
  lists_[from % 2].bind(18);
  counts_.bind(19);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, dispatch_.id());
  glDispatchComputeIndirect(0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
}

void GpuFinder::pass(const GpuRays& rays, Look look, Solid solid, int batch, const Pairs& pairs) {
  const std::vector<ConeLevels::Level>& levels = rays.levels();
  fill(counts_.buffer(), 0, 0, needed_counter);
  bodies_.bind();
  rays.bind();
  farthest_.bind(17);

  const gl::Program& groups = program_of(tools_, "groups.comp", {});
  groups.set("first_pair", pairs.first);
  groups.set("pair_end", pairs.end);
  groups.set("node_first", levels.back().first);
  groups.set("node_count", levels.back().count);
  groups.set("batch", batch);
  groups.set("solid", look == Look::blended    ? look_for_blended
                      : solid == Solid::labels ? look_for_labels
                                               : look_for_opaque);
  groups.set("list_counter", 0u);
  groups.set("list_capacity", capacity_);
  bind_storage(0, counts_.buffer());
  bind_storage(1, lists_[0].buffer());
  batches_.bind(24);
  dispatch(divided_up(pairs.end - pairs.first, group_size));
  bodies_.bind();

  uint32_t from = 0;
  for (size_t level = levels.size() - 1; level > 1; --level) {
    const gl::Program& nodes = program_of(tools_, "nodes.comp", {});
    nodes.set("node_first", levels[level].first);
    nodes.set("child_first", levels[level - 1].first);
    nodes.set("child_count", levels[level - 1].count);
    run_listed(nodes, from, 16, from + 1);
    ++from;
  }
  run_listed(program_of(tools_, "clusters.comp", {}), from, 16, from + 1);
  ++from;
  const gl::Program& triangles = program_of(tools_, "triangles.comp", {});
  triangles.set("node_first", levels[1].first);
  run_listed(triangles, from, 16, from + 1);
  ++from;

  gl::Defines with = defines();
  if (look == Look::blended) {
    with["COLLECT"] = "";
  } else if (bodies_.has_holes()) {
    with["HOLES"] = "technique/visibility/coverage.glsl";
  }
  const gl::Program& meet = program_of(tools_, "rays.comp", with);
  seen_.bind(11);
  if (look == Look::blended) {
    bind_storage(2, layers_);
  } else {
    bind_storage(2, seen_.buffer());
    if (!tools_.context.limits().atomics_64) {
      bind_storage(3, ids_);
      meet.set("keeps_ids", int(look == Look::ids));
    }
  }
  run_listed(meet, from, 1, look == Look::blended ? layer_counter : from + 1);
}

void GpuFinder::pass_over_all(const GpuRays& rays, Look look, Solid solid, int batch) {
  for (uint32_t first = 0; first < pair_count(rays);) {
    const Pairs pairs = pairs_from(rays, first);
    pass(rays, look, solid, batch, pairs);
    first = pairs.end;
  }
}

void GpuFinder::sort_groups(int batch_count) {
  fill(steps_, 0, 0, distance_steps);
  bodies_.bind();
  const gl::Program& distances = program_of(tools_, "distances.comp", {});
  distances.set("group_count", bodies_.placed_group_count());
  bind_storage(0, steps_);
  dispatch(divided_up(bodies_.placed_group_count(), group_size));
  const gl::Program& batches = program_of(tools_, "batches.comp", {});
  batches.set("group_count", bodies_.placed_group_count());
  batches.set("batch_count", unsigned(batch_count));
  bind_storage(1, batches_.buffer());
  dispatch(1);
}

void GpuFinder::find_farthest(const GpuRays& rays) {
  const std::vector<ConeLevels::Level>& levels = rays.levels();
  rays.bind();
  seen_.bind(11);
  farthest_.bind(17);
  bind_storage(0, farthest_.buffer());
  for (size_t level = 0; level < levels.size(); ++level) {
    gl::Defines with = defines();
    if (level == 0) with["LEAVES"] = "";
    const gl::Program& program = program_of(tools_, "farthest.comp", with);
    program.set("node_first", levels[level].first);
    program.set("node_count", levels[level].count);
    if (level > 0) {
      program.set("child_first", levels[level - 1].first);
      program.set("child_count", levels[level - 1].count);
    }
    dispatch(divided_up(levels[level].count, group_size));
  }
}

VisibleTriangles GpuFinder::nearest(const GpuRays& rays, Solid solid) {
  VisibleTriangles visible{rays.size(), {}};
  visible.hits.assign(size_t(rays.size().width) * size_t(rays.size().height),
                      glm::uvec2(VisibleTriangles::nothing, VisibleTriangles::no_ray));
  if (rays.ray_count() == 0) return visible;
  const bool wide = tools_.context.limits().atomics_64;
  const size_t words = rays.ray_count() * (wide ? 2 : 1);
  seen_.reserve(words * sizeof(uint32_t));
  fill(seen_.buffer(), 0, 0, words);
  farthest_.reserve(rays.node_count() * sizeof(uint32_t));
  if (!wide) reserve(ids_, rays.ray_count() * sizeof(uint32_t));
  const uint32_t groups = bodies_.placed_group_count();
  const int batch_count = groups >= 64 ? most_batches : groups >= 4 ? 2 : 1;
  sort_groups(batch_count);
  find_farthest(rays);
  // What a list has no room for is found by going through all of it again: nothing is lost by finding a thing twice.
  for (;;) {
    reset_needed();
    for (int batch = 0; batch < batch_count; ++batch) {
      pass_over_all(rays, Look::nearest, solid, batch);
      find_farthest(rays);
    }
    if (!wide) {
      fill(ids_, VisibleTriangles::nothing, 0, rays.ray_count());
      pass_over_all(rays, Look::ids, solid, -1);
    }
    const uint32_t longest = needed();
    if (longest <= capacity_) break;
    make_room(rays, longest);
  }

  const std::vector<uint32_t> found = read<uint32_t>(wide ? seen_.buffer() : ids_, words);
  tbb::parallel_for(size_t{0}, rays.block_count(), [&](size_t block) {
    glm::uvec2 last(VisibleTriangles::nothing);
    rays.each_ray(block, [&](size_t ray, size_t pixel) {
      // An inverse distance of 0 is nothing.
      const uint32_t id = !wide ? found[ray] : found[2 * ray + 1] == 0 ? VisibleTriangles::nothing : ~found[2 * ray];
      if (id != last.x) {
        last = {id, id == VisibleTriangles::nothing ? id : instance_of(index_.scene(), id)};
      }
      visible.hits[pixel] = last;
    });
  });
  return visible;
}

std::vector<std::vector<RayHit>> GpuFinder::blended(const GpuRays& rays) {
  std::vector<std::vector<RayHit>> found(size_t(rays.size().width) * size_t(rays.size().height));
  if (rays.ray_count() == 0) return found;
  for (uint32_t first = 0; first < pair_count(rays);) {
    const Pairs pairs = pairs_from(rays, first);
    reserve(layers_, capacity_ * sizeof(glm::uvec4));
    reset_needed();
    fill(counts_.buffer(), 0, layer_counter, 1);
    pass(rays, Look::blended, Solid::opaque, -1, pairs);
    const std::vector<uint32_t> counts = read<uint32_t>(counts_.buffer(), counter_count);
    if (const uint32_t longest = std::max(counts[needed_counter], counts[layer_counter]); longest > capacity_) {
      make_room(rays, longest);
      continue;
    }
    for (const glm::uvec4& layer : read<glm::uvec4>(layers_, counts[layer_counter])) {
      found[rays.pixel_of(layer.x)].push_back(
          {layer.y, instance_of(index_.scene(), layer.y), 1.0f / std::bit_cast<float>(layer.z)});
    }
    first = pairs.end;
  }
  tbb::parallel_for(size_t{0}, found.size(), [&](size_t pixel) {
    std::sort(found[pixel].begin(), found[pixel].end(), [](const RayHit& a, const RayHit& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
    });
  });
  return found;
}

size_t GpuFinder::bytes() const {
  return bodies_.bytes() + index_.bytes() + lists_[0].bytes() + lists_[1].bytes() + counts_.bytes() + seen_.bytes() +
         farthest_.bytes() + batches_.bytes() + ids_.bytes() + steps_.bytes() + layers_.bytes();
}

}  // namespace omma
