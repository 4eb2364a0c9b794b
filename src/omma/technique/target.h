// Where a technique draws: a colour image, or one image for each other channel, and a depth image.
#pragma once

#include <span>
#include <vector>

#include "omma/gl/objects.h"
#include "omma/gl/program.h"
#include "omma/image/image.h"

namespace omma {

/// OUTPUT_COLOR, OUTPUT_ID, …: each channel's attachment. Matches shaders/shading/output.glsl.
gl::Defines output_defines(std::span<const Channel> outputs);

GLenum gl_format(Channel channel);

/// Reversed depth in floats: 1 / distance-like, cleared to 0, larger is nearer.
inline constexpr GLenum depth_format = GL_DEPTH_COMPONENT32F;

/// Metres. Depth is near_depth / distance; what is nearer than this is drawn all the same, with equal depth.
inline constexpr float near_depth = 1e-3f;

class Target {
 public:
  Target() = default;
  /// `layers` above 0 makes arrays. `samples` above 1 makes multisample images.
  Target(ImageSize size, std::span<const Channel> outputs, int samples = 1, int layers = 0);

  bool fits(ImageSize size, std::span<const Channel> outputs, int samples, int layers = 0) const;

  /// Only this channel is drawn to, as the program's first output, until draw_all.
  void draw_only(Channel channel) const;
  void draw_all() const;
  /// Binds the framebuffer and sets the viewport.
  void bind() const;
  /// Binds, and clears every channel to nothing and depth to far.
  void begin() const;
  /// Copies a multisample colour image, averaged, into `destination` of the same size.
  void resolve_color(const Target& destination) const;

  ImageSize size() const { return size_; }
  GLuint framebuffer() const { return framebuffer_.id(); }
  const gl::Texture& image(Channel channel) const;
  const gl::Texture& depth() const { return depth_; }
  size_t bytes() const;

 private:
  ImageSize size_;
  std::vector<Channel> outputs_;
  int samples_ = 1, layers_ = 0;
  gl::Framebuffer framebuffer_;
  std::vector<gl::Texture> images_;
  gl::Texture depth_;
};

/// Clears the first attachments of a framebuffer to what `outputs` hold where there is nothing, and its depth to far.
void clear_outputs(GLuint framebuffer, std::span<const Channel> outputs);

/// A channel's pixels, rows from the top.
Image read_back(const gl::Texture& texture, Channel channel, ImageSize size);

}  // namespace omma
