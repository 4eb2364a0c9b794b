// OpenGL objects that own and move. An object made by its default constructor is empty (id 0); `create` makes one.
// `id()` mixes with a host's own GL.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

#include "omma/math/ray.h"

namespace omma::gl {

/// `Traits` knows how to delete one kind of object.
template <typename Traits>
class Object {
 public:
  Object() = default;
  explicit Object(GLuint id) : id_(id) {}
  Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Object() {
    if (id_ != 0) Traits::destroy(id_);
  }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  GLuint id_ = 0;
};

struct BufferTraits {
  static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct TextureTraits {
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct FramebufferTraits {
  static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct VertexArrayTraits {
  static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct SamplerTraits {
  static void destroy(GLuint id) { glDeleteSamplers(1, &id); }
};
struct QueryTraits {
  static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};

using Framebuffer = Object<FramebufferTraits>;
using VertexArray = Object<VertexArrayTraits>;
using Sampler = Object<SamplerTraits>;
using Query = Object<QueryTraits>;

inline Framebuffer create_framebuffer() {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  return Framebuffer(id);
}

inline VertexArray create_vertex_array() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return VertexArray(id);
}

inline Sampler create_sampler() {
  GLuint id = 0;
  glCreateSamplers(1, &id);
  return Sampler(id);
}

/// A name only; its first use makes it a query. (Mesa 22.3 refuses pipeline statistics in glCreateQueries.)
inline Query create_query() {
  GLuint id = 0;
  glGenQueries(1, &id);
  return Query(id);
}

/// A buffer of a fixed size whose content may change.
class Buffer : public Object<BufferTraits> {
 public:
  Buffer() = default;
  explicit Buffer(size_t bytes, const void* data = nullptr) : Object(create()), bytes_(bytes) {
    // GL has no empty buffers; a scene without lights still binds one.
    glNamedBufferStorage(id(), GLsizeiptr(bytes > 0 ? bytes : 16), data, GL_DYNAMIC_STORAGE_BIT | GL_MAP_WRITE_BIT);
  }
  template <typename T>
  explicit Buffer(std::span<const T> values) : Buffer(values.size_bytes(), values.data()) {}

  size_t bytes() const { return bytes_; }

  template <typename T>
  void write(std::span<const T> values, size_t byte_offset = 0) {
    if (!values.empty()) {
      glNamedBufferSubData(id(), GLintptr(byte_offset), GLsizeiptr(values.size_bytes()), values.data());
    }
  }

 private:
  static GLuint create() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    return id;
  }
  size_t bytes_ = 0;
};

/// A buffer's first `count` values for writing, from any thread, for as long as this lives. What stood in the buffer is
/// lost. The buffer holds so many.
template <typename T>
class WriteMapping {
 public:
  WriteMapping(const Buffer& buffer, size_t count)
      : buffer_(buffer.id()),
        values_(static_cast<T*>(glMapNamedBufferRange(buffer_, 0, GLsizeiptr(count * sizeof(T)),
                                                      GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT)),
                count) {}
  ~WriteMapping() { glUnmapNamedBuffer(buffer_); }
  WriteMapping(const WriteMapping&) = delete;
  WriteMapping& operator=(const WriteMapping&) = delete;

  std::span<T> values() const { return values_; }

 private:
  GLuint buffer_;
  std::span<T> values_;
};

class Texture : public Object<TextureTraits> {
 public:
  Texture() = default;

  /// Nearest filtering and clamping by default: an integer texture with GL's default filter is incomplete and reads 0.
  static Texture image(GLenum format, ImageSize size, int levels = 1) {
    Texture texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.id(), levels, format, size.width, size.height);
    texture.nearest();
    return texture;
  }
  static Texture array(GLenum format, ImageSize size, int layers, int levels = 1) {
    Texture texture(GL_TEXTURE_2D_ARRAY);
    glTextureStorage3D(texture.id(), levels, format, size.width, size.height, layers);
    texture.nearest();
    return texture;
  }
  static Texture multisample(GLenum format, ImageSize size, int samples) {
    Texture texture(GL_TEXTURE_2D_MULTISAMPLE);
    glTextureStorage2DMultisample(texture.id(), samples, format, size.width, size.height, GL_TRUE);
    return texture;
  }
  static Texture multisample_array(GLenum format, ImageSize size, int layers, int samples) {
    Texture texture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY);
    glTextureStorage3DMultisample(texture.id(), samples, format, size.width, size.height, layers, GL_TRUE);
    return texture;
  }
  /// A view of a buffer as texels; the buffer must outlive the texture.
  static Texture of_buffer(GLenum format, const Buffer& buffer) {
    Texture texture(GL_TEXTURE_BUFFER);
    glTextureBuffer(texture.id(), format, buffer.id());
    return texture;
  }

  void filter(GLenum minification, GLenum magnification) {
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, GLint(minification));
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, GLint(magnification));
  }

  void bind(GLuint unit) const { glBindTextureUnit(unit, id()); }

 private:
  explicit Texture(GLenum target) : Object(create(target)) {}
  static GLuint create(GLenum target) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    return id;
  }
  void nearest() {
    filter(GL_NEAREST, GL_NEAREST);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
};

/// A table that shaders read as texels and that grows with what is written.
class Texels {
 public:
  explicit Texels(GLenum format) : format_(format) {}

  template <typename T>
  void write(std::span<const T> values, size_t byte_offset = 0) {
    reserve(byte_offset + values.size_bytes());
    buffer_.write(values, byte_offset);
  }
  /// Contents are lost where it grows: by half as much again, so that a little more each frame is not a new one each.
  void reserve(size_t bytes) {
    if (buffer_ && buffer_.bytes() >= bytes) return;
    buffer_ = Buffer(bytes + bytes / 2);
    texture_ = Texture::of_buffer(format_, buffer_);
  }
  void bind(GLuint unit) const { texture_.bind(unit); }
  const Buffer& buffer() const { return buffer_; }
  size_t bytes() const { return buffer_.bytes(); }

 private:
  GLenum format_;
  Buffer buffer_;
  Texture texture_;
};

}  // namespace omma::gl
