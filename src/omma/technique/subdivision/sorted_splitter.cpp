#include "omma/technique/subdivision/sorted_splitter.h"

#include <algorithm>
#include <map>

#include "omma/technique/mesh_pass.h"
#include "omma/technique/subdivision/splitter.h"

namespace omma {

SortedSplitter::SortedSplitter(DrawTools& tools, const ScenePixels& pixels, SplitForm form)
    : tools_(tools),
      pixels_(pixels),
      form_(form),
      triangle_array_(create_triangle_array(0)),
      record_array_(create_record_array()) {}

void SortedSplitter::split(const View& view, const LensField& field, double tolerance_px) {
  lists_[0].clear();
  std::vector<SceneTriangle> triangles;
  for (const BlendedTriangle& triangle : blended_triangles(tools_.scene, [](const Bounds&) { return true; })) {
    triangles.push_back(scene_triangle(tools_.scene, pixels_, tools_.scene.parts()[triangle.part], triangle.number));
  }
  if (triangles.empty()) return;
  const gl::Program& program = split_program(tools_, view, field, form_, true);
  program.use();
  set_field(program, field, view, tolerance_px);
  tools_.scene.bind();
  tools_.scene.bind_vertex_textures();
  pixels_.bind();
  const gl::Buffer attributes{std::span<const SceneTriangle>(triangles)};
  glVertexArrayVertexBuffer(triangle_array_.id(), 0, attributes.id(), 0, sizeof(SceneTriangle));
  glBindVertexArray(triangle_array_.id());
  program.set("is_part", 0);
  bool more = pass(uint32_t(triangles.size()));
  program.set("is_part", 1);
  for (int passes = 1; more && passes < Splitter::most_passes; ++passes) {
    glBindVertexArray(record_array_.id());
    glVertexArrayVertexBuffer(record_array_.id(), 0, lists_[0].buffer().id(), 0, RecordList::record_bytes);
    if (passes == Splitter::most_passes - 1) program.set("edge_range", glm::vec2(4.0f));
    more = pass(lists_[0].size());
  }
  find_runs();
}

bool SortedSplitter::pass(uint32_t count) {
  RecordList& to = lists_[1];
  to.clear();
  to.reserve(count);
  for (;;) {
    const gl::Query records = gl::create_query(), split = gl::create_query();
    {
      const Capture capture({to.end()});
      glBeginQueryIndexed(GL_PRIMITIVES_GENERATED, 0, records.id());
      glBeginQueryIndexed(GL_PRIMITIVES_GENERATED, 1, split.id());
      glDrawArrays(GL_POINTS, 0, GLsizei(count));
      glEndQueryIndexed(GL_PRIMITIVES_GENERATED, 0);
      glEndQueryIndexed(GL_PRIMITIVES_GENERATED, 1);
    }
    GLuint record_count = 0, split_count = 0;
    glGetQueryObjectuiv(records.id(), GL_QUERY_RESULT, &record_count);
    glGetQueryObjectuiv(split.id(), GL_QUERY_RESULT, &split_count);
    if (record_count > to.capacity()) {
      to.reserve(record_count);
      continue;
    }
    to.append(0, record_count);
    std::swap(lists_[0], lists_[1]);
    return split_count > 0;
  }
}

void SortedSplitter::find_runs() {
  // A material and a winding for each instance, which the records name.
  std::map<uint32_t, size_t> part_of_instance;
  for (size_t p = 0; p < tools_.scene.parts().size(); ++p) {
    part_of_instance.emplace(uint32_t(tools_.scene.parts()[p].instance), p);
  }
  struct Record {
    uint32_t words[22], instance, id;
  };
  static_assert(sizeof(Record) == RecordList::record_bytes);
  std::vector<Record> records(lists_[0].size());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(lists_[0].buffer().id(), 0, GLsizeiptr(records.size() * sizeof(Record)), records.data());
  lists_[0].clear();
  for (size_t begin = 0, end = 0; begin < records.size(); begin = end) {
    const size_t part = part_of_instance.at(records[begin].instance);
    while (end < records.size() && part_of_instance.at(records[end].instance) == part) ++end;
    lists_[0].append(part, uint32_t(end - begin));
  }
}

}  // namespace omma
