#include "omma/technique/subdivision/record_list.h"

namespace omma {

void RecordList::clear() {
  runs_.clear();
  size_ = 0;
}

void RecordList::append(size_t group, uint32_t count) {
  if (count > 0) runs_.push_back({group, size_, count});
  size_ += count;
}

void RecordList::reserve(uint32_t records) {
  if (buffer_ && capacity() >= records) return;
  gl::Buffer larger(record_bytes * (size_t(records) + records / 2 + 1));
  if (size_ > 0) glCopyNamedBufferSubData(buffer_.id(), larger.id(), 0, 0, GLsizeiptr(size_ * record_bytes));
  buffer_ = std::move(larger);
  texture_ = gl::Texture::of_buffer(GL_RGBA32UI, buffer_);
}

gl::VertexArray create_record_array() {
  gl::VertexArray array = gl::create_vertex_array();
  constexpr GLuint texel_bytes = 16;
  for (GLuint texel = 0; texel < RecordList::record_bytes / texel_bytes; ++texel) {
    glEnableVertexArrayAttrib(array.id(), texel);
    glVertexArrayAttribIFormat(array.id(), texel, 4, GL_UNSIGNED_INT, texel * texel_bytes);
    glVertexArrayAttribBinding(array.id(), texel, 0);
  }
  return array;
}

}  // namespace omma
