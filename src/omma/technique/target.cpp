#include "omma/technique/target.h"

#include <algorithm>
#include <cctype>

#include "omma/base/error.h"

namespace omma {
namespace {

size_t texel_bytes(GLenum format) {
  switch (format) {
    case GL_RGBA32F:
      return 16;
    case GL_RG32F:
    case GL_RGBA16F:
      return 8;
    default:
      return 4;
  }
}

gl::Texture make_image(GLenum format, ImageSize size, int samples, int layers) {
  if (samples > 1) {
    return layers > 0 ? gl::Texture::multisample_array(format, size, layers, samples)
                      : gl::Texture::multisample(format, size, samples);
  }
  return layers > 0 ? gl::Texture::array(format, size, layers) : gl::Texture::image(format, size);
}

}  // namespace

gl::Defines output_defines(std::span<const Channel> outputs) {
  gl::Defines defines;
  for (size_t i = 0; i < outputs.size(); ++i) {
    std::string name = channel_info(outputs[i]).name;
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    defines["OUTPUT_" + name] = std::to_string(i);
  }
  return defines;
}

GLenum gl_format(Channel channel) {
  switch (channel) {
    case Channel::color:
      return GL_RGBA16F;
    case Channel::distance:
    case Channel::z:
      return GL_R32F;
    case Channel::normal:
    case Channel::position:
      return GL_RGBA32F;
    case Channel::uv:
      return GL_RG32F;
    case Channel::id:
    case Channel::object:
    case Channel::material:
      break;
  }
  return GL_R32I;
}

Target::Target(ImageSize size, std::span<const Channel> outputs, int samples, int layers)
    : size_(size),
      outputs_(outputs.begin(), outputs.end()),
      samples_(samples),
      layers_(layers),
      framebuffer_(gl::create_framebuffer()),
      depth_(make_image(depth_format, size, samples, layers)) {
  for (Channel channel : outputs_) {
    const auto attachment = GLenum(GL_COLOR_ATTACHMENT0 + images_.size());
    images_.push_back(make_image(gl_format(channel), size, samples, layers));
    glNamedFramebufferTexture(framebuffer(), attachment, images_.back().id(), 0);
  }
  glNamedFramebufferTexture(framebuffer(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
  draw_all();
  if (glCheckNamedFramebufferStatus(framebuffer(), GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw MachineError("this driver cannot draw to a {} x {} image with {} samples", size.width, size.height, samples);
  }
}

bool Target::fits(ImageSize size, std::span<const Channel> outputs, int samples, int layers) const {
  return framebuffer_ && size_ == size && samples_ == samples && layers_ == layers &&
         std::equal(outputs_.begin(), outputs_.end(), outputs.begin(), outputs.end());
}

void clear_outputs(GLuint framebuffer, std::span<const Channel> outputs) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    const ChannelInfo& info = channel_info(outputs[i]);
    if (info.integer) {
      const GLint value[4] = {GLint(info.nothing), 0, 0, 0};
      glClearNamedFramebufferiv(framebuffer, GL_COLOR, GLint(i), value);
    } else {
      const GLfloat value[4] = {info.nothing, info.nothing, info.nothing, 0.0f};
      glClearNamedFramebufferfv(framebuffer, GL_COLOR, GLint(i), value);
    }
  }
  const GLfloat far_depth = 0.0f;
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
}

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer());
  glViewport(0, 0, size_.width, size_.height);
}

void Target::begin() const {
  bind();
  clear_outputs(framebuffer(), outputs_);
}

void Target::draw_only(Channel channel) const {
  const auto at = std::find(outputs_.begin(), outputs_.end(), channel) - outputs_.begin();
  glNamedFramebufferDrawBuffer(framebuffer(), GLenum(GL_COLOR_ATTACHMENT0 + at));
}

void Target::draw_all() const {
  std::vector<GLenum> attachments;
  for (size_t i = 0; i < outputs_.size(); ++i) attachments.push_back(GLenum(GL_COLOR_ATTACHMENT0 + i));
  glNamedFramebufferDrawBuffers(framebuffer(), GLsizei(attachments.size()), attachments.data());
}

void Target::resolve_color(const Target& destination) const {
  glBlitNamedFramebuffer(framebuffer(), destination.framebuffer(), 0, 0, size_.width, size_.height, 0, 0, size_.width,
                         size_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

const gl::Texture& Target::image(Channel channel) const {
  return images_[size_t(std::find(outputs_.begin(), outputs_.end(), channel) - outputs_.begin())];
}

size_t Target::bytes() const {
  size_t texel = 4;
  for (Channel channel : outputs_) texel += texel_bytes(gl_format(channel));
  return texel * size_t(size_.width) * size_t(size_.height) * size_t(std::max(samples_, 1)) *
         size_t(std::max(layers_, 1));
}

Image read_back(const gl::Texture& texture, Channel channel, ImageSize size) {
  constexpr GLenum float_formats[] = {GL_RED, GL_RG, GL_RGB};
  const ChannelInfo& info = channel_info(channel);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  const auto read = [&](auto& image, GLenum format, GLenum type) {
    glGetTextureSubImage(texture.id(), 0, 0, 0, 0, size.width, size.height, 1, format, type,
                         GLsizei(image.values.size() * sizeof image.values[0]), image.values.data());
  };
  if (info.integer) {
    IntImage image(size, info.components);
    read(image, GL_RED_INTEGER, GL_INT);
    return image;
  }
  FloatImage image(size, info.components);
  read(image, float_formats[info.components - 1], GL_FLOAT);
  return image;
}

}  // namespace omma
