#include "omma/technique/piecewise/feedback_lists.h"

#include <algorithm>

namespace omma {
namespace {

/// Two texels, as in shaders/technique/piecewise/feedback_slots.glsl.
struct SlotRecord {
  uint32_t total = 0, entries = 1;
  glm::uvec2 run[FeedbackLists::max_runs]{};
};

gl::Defines defines() {
  return {{"MAX_RUNS", std::to_string(FeedbackLists::max_runs)}, {"GROWTH", std::to_string(FeedbackLists::growth)}};
}

/// Nothing is rasterized while it lives: what vertices become is captured.
class Capture {
 public:
  explicit Capture(const gl::Buffer& buffer) {
    glEnable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.id());
    glBeginTransformFeedback(GL_POINTS);
  }
  ~Capture() {
    glEndTransformFeedback();
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glDisable(GL_RASTERIZER_DISCARD);
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
};

}  // namespace

FeedbackLists::FeedbackLists(DrawTools& tools)
    : tools_(tools), limited_(sizeof(uint32_t)), entries_array_(gl::create_vertex_array()) {
  glEnableVertexArrayAttrib(entries_array_.id(), 0);
  glVertexArrayAttribIFormat(entries_array_.id(), 0, 2, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(entries_array_.id(), 0, 0);
}

void FeedbackLists::start(const SceneClusters& clusters) {
  // Every slot has one entry, even where it reaches no piece: what is not in a list cannot come back.
  const size_t slot_count = size_t(clusters.cluster_count()) * SceneClusters::cluster_triangles;
  const std::vector<SlotRecord> records(slot_count);
  for (gl::Texels& slots : slots_) slots.write(std::span<const SlotRecord>(records));
  for (const ClusterGroup& group : clusters.groups()) {
    std::vector<glm::uvec2> entries;
    for (uint32_t slot = group.first_cluster * SceneClusters::cluster_triangles;
         slot < group.last_cluster * SceneClusters::cluster_triangles; ++slot) {
      entries.emplace_back(slot, 0);
    }
    List& list = lists_.emplace_back();
    list.entries[size_t(now_)] = gl::Buffer(std::span<const glm::uvec2>(entries));
    list.counts[size_t(now_)] = uint32_t(entries.size());
  }
}

void FeedbackLists::update(const GpuPieces& pieces, const SceneClusters& clusters) {
  if (lists_.empty()) start(clusters);
  rounds_ = overflows_ = 0;
  bool complete = false;
  while (!complete) {
    ++rounds_;
    tools_.timer.mark("count");
    complete = count_pieces(pieces, clusters);
    tools_.timer.mark("replicate");
    slots_[size_t(1 - now_)].bind(22);
    slots_[size_t(now_)].bind(23);
    for (List& list : lists_) replicate(list);
    now_ = 1 - now_;
  }
}

bool FeedbackLists::count_pieces(const GpuPieces& pieces, const SceneClusters& clusters) {
  const gl::Program& program =
      tools_.programs.get({{GL_VERTEX_SHADER, "technique/piecewise/feedback_count.vert"}}, defines());
  program.use();
  pieces.set_uniforms(program);
  program.set("cluster_count", unsigned(clusters.cluster_count()));
  tools_.scene.bind();
  pieces.bind();
  clusters.bind();
  const uint32_t none = 0;
  limited_.write(std::span<const uint32_t>(&none, 1));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, limited_.id());
  slots_[size_t(now_)].bind(23);
  glBindVertexArray(tools_.no_vertices.id());
  {
    const Capture capture(slots_[size_t(1 - now_)].buffer());
    glDrawArrays(GL_POINTS, 0, GLsizei(clusters.cluster_count() * SceneClusters::cluster_triangles));
  }
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  uint32_t limited = 0;
  glGetNamedBufferSubData(limited_.id(), 0, sizeof limited, &limited);
  return limited == 0;
}

void FeedbackLists::replicate(List& list) {
  const auto from = size_t(now_), to = size_t(1 - now_);
  const gl::Program& program =
      tools_.programs.get({{GL_VERTEX_SHADER, "technique/piecewise/feedback_replicate.vert"},
                           {GL_GEOMETRY_SHADER, "technique/piecewise/feedback_replicate.geom"}},
                          defines());
  program.use();
  glVertexArrayVertexBuffer(entries_array_.id(), 0, list.entries[from].id(), 0, sizeof(glm::uvec2));
  glBindVertexArray(entries_array_.id());
  if (!list.entries[to]) list.entries[to] = gl::Buffer(list.entries[from].bytes());
  for (;;) {
    const gl::Query generated = gl::create_query();
    {
      const Capture capture(list.entries[to]);
      glBeginQuery(GL_PRIMITIVES_GENERATED, generated.id());
      glDrawArrays(GL_POINTS, 0, GLsizei(list.counts[from]));
      glEndQuery(GL_PRIMITIVES_GENERATED);
    }
    glGetQueryObjectuiv(generated.id(), GL_QUERY_RESULT, &list.counts[to]);
    const size_t needed = list.counts[to] * sizeof(glm::uvec2);
    if (needed <= list.entries[to].bytes()) return;
    // What did not fit is lost: once more, with room to grow.
    ++overflows_;
    list.entries[to] = gl::Buffer(needed + needed / 2);
  }
}

void FeedbackLists::bind() const { slots_[size_t(now_)].bind(22); }

void FeedbackLists::draw(size_t group) const {
  const List& list = lists_[group];
  glVertexArrayVertexBuffer(entries_array_.id(), 0, list.entries[size_t(now_)].id(), 0, sizeof(glm::uvec2));
  glBindVertexArray(entries_array_.id());
  glDrawArrays(GL_POINTS, 0, GLsizei(list.counts[size_t(now_)]));
}

size_t FeedbackLists::bytes() const {
  size_t bytes = slots_[0].bytes() + slots_[1].bytes();
  for (const List& list : lists_) bytes += list.entries[0].bytes() + list.entries[1].bytes();
  return bytes;
}

}  // namespace omma
