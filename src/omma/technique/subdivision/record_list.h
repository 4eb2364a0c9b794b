// Records (shaders/technique/subdivision/record.glsl) on the GPU, in runs.
#pragma once

#include <cstdint>
#include <vector>

#include "omma/gl/objects.h"
#include "omma/technique/subdivision/capture.h"

namespace omma {

class RecordList {
 public:
  static constexpr size_t record_bytes = 96;

  struct Run {
    size_t group;
    uint32_t first, count;
  };

  void clear();
  void append(size_t group, uint32_t count);
  /// Room for so many, with what is in it kept.
  void reserve(uint32_t records);
  /// The buffer holds one record more: what is captured goes behind the last one, and may not go to nowhere.
  uint32_t capacity() const { return uint32_t(buffer_.bytes() / record_bytes) - 1; }
  CaptureTarget end() const { return {buffer_, size_ * record_bytes}; }

  const std::vector<Run>& runs() const { return runs_; }
  uint32_t size() const { return size_; }
  const gl::Buffer& buffer() const { return buffer_; }
  void bind(GLuint unit) const { texture_.bind(unit); }
  size_t bytes() const { return buffer_.bytes(); }

 private:
  gl::Buffer buffer_;
  gl::Texture texture_;
  std::vector<Run> runs_;
  uint32_t size_ = 0;
};

/// A vertex array whose first six attributes are the texels of a record.
gl::VertexArray create_record_array();

}  // namespace omma
