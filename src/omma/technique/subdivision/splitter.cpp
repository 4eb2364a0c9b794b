#include "omma/technique/subdivision/splitter.h"

#include <map>
#include <tuple>

namespace omma {
namespace {

struct DrawElementsCommand {  // as glMultiDrawElementsIndirect reads it
  GLuint count, instance_count, first_index;
  GLint base_vertex;
  GLuint base_instance;
};

template <typename Command>
const void* command_at(GLsizei number) {
  return reinterpret_cast<const void*>(size_t(number) * sizeof(Command));
}

/// Enough for a first picture of most scenes.
constexpr uint32_t first_records = 4096;

}  // namespace

Splitter::Splitter(DrawTools& tools, const ScenePixels& pixels, SplitForm form)
    : tools_(tools),
      pixels_(pixels),
      form_(form),
      part_array_(create_triangle_array(1)),
      record_array_(create_record_array()) {
  plain_ = gl::Buffer(tools.scene.scene().triangle_count() * sizeof(glm::uvec3));
  for (RecordList* list : {&straight_, &border_, &next_[0], &next_[1]}) list->reserve(first_records);
  sort_parts();
}

void Splitter::scene_changed() { sort_parts(); }

void Splitter::sort_parts() {
  const Scene& scene = tools_.scene.scene();
  std::map<std::tuple<bool, int, bool>, std::vector<size_t>> sorted;
  for (size_t p = 0; p < tools_.scene.parts().size(); ++p) {
    const Part& part = tools_.scene.parts()[p];
    const bool blended = scene.materials[size_t(part.material)].alpha == Material::Alpha::blend;
    sorted[{blended, part.material, part.mirrored}].push_back(p);
  }
  groups_.clear();
  std::vector<SceneTriangle> firsts;
  std::vector<DrawArraysCommand> points;
  std::vector<DrawElementsCommand> plain;
  GLuint index = 0;
  for (const auto& [key, parts] : sorted) {
    const auto& [blended, material, mirrored] = key;
    groups_.push_back({material, mirrored, blended, GLsizei(points.size()), GLsizei(parts.size())});
    for (const size_t p : parts) {
      const Part& part = tools_.scene.parts()[p];
      points.push_back({part.index_count / 3, 1, 0, GLuint(firsts.size())});
      firsts.push_back(scene_triangle(tools_.scene, pixels_, part, 0));
      plain.push_back({part.index_count, 1, index, 0, GLuint(p)});
      index += part.index_count;
    }
  }
  part_records_ = gl::Buffer(std::span<const SceneTriangle>(firsts));
  point_commands_ = gl::Buffer(std::span<const DrawArraysCommand>(points));
  plain_commands_ = gl::Buffer(std::span<const DrawElementsCommand>(plain));
  glVertexArrayVertexBuffer(part_array_.id(), 0, part_records_.id(), 0, sizeof(SceneTriangle));
}

void Splitter::split(const View& view, const LensField& field, double tolerance_px, bool blended) {
  passes_ = overflows_ = 0;
  for (RecordList* list : {&straight_, &border_, &next_[0], &next_[1]}) list->clear();
  const gl::Program& program = split_program(tools_, view, field, form_, false);
  program.use();
  set_field(program, field, view, tolerance_px);
  tools_.scene.bind();
  tools_.scene.bind_vertex_textures();
  pixels_.bind();
  program.set("is_part", 0);
  first_pass(blended);
  program.set("is_part", 1);
  while (next_[0].size() > 0) {
    if (passes_ == most_passes - 1) program.set("edge_range", glm::vec2(4.0f));  // the rest is taken as it is
    next_pass();
  }
}

void Splitter::first_pass(bool blended) {
  std::vector<size_t> groups;
  for (size_t group = 0; group < groups_.size(); ++group) {
    if (blended || !groups_[group].blended) groups.push_back(group);
  }
  glBindVertexArray(part_array_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, point_commands_.id());
  capture(groups, [&](size_t group) {
    glMultiDrawArraysIndirect(GL_POINTS, command_at<DrawArraysCommand>(groups_[group].first_part),
                              groups_[group].part_count, 0);
  });
}

void Splitter::next_pass() {
  std::vector<size_t> groups;
  std::vector<RecordList::Run> runs(groups_.size());
  for (const RecordList::Run& run : next_[0].runs()) {
    groups.push_back(run.group);
    runs[run.group] = run;
  }
  glBindVertexArray(record_array_.id());
  glVertexArrayVertexBuffer(record_array_.id(), 0, next_[0].buffer().id(), 0, RecordList::record_bytes);
  capture(groups, [&](size_t group) { glDrawArrays(GL_POINTS, GLint(runs[group].first), GLsizei(runs[group].count)); });
}

void Splitter::capture(std::span<const size_t> groups, const std::function<void(size_t group)>& draw) {
  RecordList* const lists[3] = {&straight_, &next_[1], &border_};
  for (;;) {
    std::vector<std::array<gl::Query, 3>> queries(groups.size());
    {
      const Capture capture({straight_.end(), next_[1].end(), border_.end(), {plain_}});
      for (size_t g = 0; g < groups.size(); ++g) {
        for (GLuint stream = 0; stream < 3; ++stream) {
          queries[g][stream] = gl::create_query();
          glBeginQueryIndexed(GL_PRIMITIVES_GENERATED, stream, queries[g][stream].id());
        }
        draw(groups[g]);
        for (GLuint stream = 0; stream < 3; ++stream) glEndQueryIndexed(GL_PRIMITIVES_GENERATED, stream);
      }
    }
    std::array<std::vector<uint32_t>, 3> counts;
    bool complete = true;
    for (GLuint stream = 0; stream < 3; ++stream) {
      uint32_t needed = lists[stream]->size();
      for (const auto& of_group : queries) {
        GLuint count = 0;
        glGetQueryObjectuiv(of_group[stream].id(), GL_QUERY_RESULT, &count);
        counts[stream].push_back(count);
        needed += count;
      }
      complete &= needed <= lists[stream]->capacity();
      lists[stream]->reserve(needed);
    }
    if (complete) {
      for (GLuint stream = 0; stream < 3; ++stream) {
        for (size_t g = 0; g < groups.size(); ++g) lists[stream]->append(groups[g], counts[stream][g]);
      }
      break;
    }
    ++overflows_;  // what did not fit is lost: once more, with room to grow
  }
  std::swap(next_[0], next_[1]);
  next_[1].clear();
  ++passes_;
}

void Splitter::draw_plain(size_t group) const {
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, plain_commands_.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, command_at<DrawElementsCommand>(groups_[group].first_part),
                              groups_[group].part_count, 0);
}

size_t Splitter::bytes() const {
  size_t bytes = plain_.bytes() + part_records_.bytes() + point_commands_.bytes() + plain_commands_.bytes();
  for (const RecordList* list : {&straight_, &border_, &next_[0], &next_[1]}) bytes += list->bytes();
  return bytes;
}

}  // namespace omma
