// Transform feedback.
#pragma once

#include <epoxy/gl.h>

#include <initializer_list>

#include "omma/gl/objects.h"

namespace omma {

struct CaptureTarget {
  const gl::Buffer& buffer;
  size_t first_byte = 0;
};

/// Nothing is rasterized while it lives: what points become is captured, each stream in the target of its number.
class Capture {
 public:
  explicit Capture(std::initializer_list<CaptureTarget> targets) : count_(GLuint(targets.size())) {
    glEnable(GL_RASTERIZER_DISCARD);
    GLuint index = 0;
    for (const CaptureTarget& target : targets) {
      glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, index++, target.buffer.id(), GLintptr(target.first_byte),
                        GLsizeiptr(target.buffer.bytes() - target.first_byte));
    }
    glBeginTransformFeedback(GL_POINTS);
  }
  ~Capture() {
    glEndTransformFeedback();
    for (GLuint index = 0; index < count_; ++index) glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, index, 0);
    glDisable(GL_RASTERIZER_DISCARD);
  }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

 private:
  GLuint count_;
};

struct DrawArraysCommand {  // as glMultiDrawArraysIndirect reads it
  GLuint count, instance_count, first, base_instance;
};

}  // namespace omma
