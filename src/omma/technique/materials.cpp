#include "omma/technique/materials.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "omma/base/error.h"
#include "omma/scene/coverage.h"

namespace omma {
namespace {

/// std140, as in shading/material.glsl.
struct MaterialBlock {
  glm::vec4 base_color;
  glm::vec4 emissive;
  glm::vec4 parameters;
};

constexpr GLuint texture_units = 4;

std::array<int, texture_units> textures_of(const Material& material) {
  return {material.base_color_texture, material.normal_texture, material.metallic_roughness_texture,
          material.emissive_texture};
}

GLint gl_wrap(Texture::Wrap wrap) {
  switch (wrap) {
    case Texture::Wrap::clamp:
      return GL_CLAMP_TO_EDGE;
    case Texture::Wrap::mirror:
      return GL_MIRRORED_REPEAT;
    case Texture::Wrap::repeat:
      break;
  }
  return GL_REPEAT;
}

gl::Sampler make_sampler(const Texture& texture, float anisotropy) {
  gl::Sampler sampler = gl::create_sampler();
  glSamplerParameteri(sampler.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glSamplerParameteri(sampler.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glSamplerParameteri(sampler.id(), GL_TEXTURE_WRAP_S, gl_wrap(texture.wrap_u));
  glSamplerParameteri(sampler.id(), GL_TEXTURE_WRAP_T, gl_wrap(texture.wrap_v));
  if (anisotropy > 1.0f) glSamplerParameterf(sampler.id(), GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
  return sampler;
}

}  // namespace

Materials::Materials(const Scene& scene, const gl::Context& context) : scene_(&scene), software_(context.software()) {
  const float anisotropy = software_ ? 1.0f : std::min(16.0f, context.limits().anisotropy);
  for (const Texture& texture : scene.textures) {
    if (std::max(texture.width, texture.height) > context.limits().texture_size) {
      throw MachineError("texture '{}' is {} x {} pixels, this driver takes up to {}", texture.name, texture.width,
                         texture.height, context.limits().texture_size);
    }
    const auto longest = unsigned(std::max(texture.width, texture.height));
    const ImageSize size{texture.width, texture.height};
    gl::Texture image =
        gl::Texture::image(texture.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, size, int(std::bit_width(longest)));
    glTextureSubImage2D(image.id(), 0, 0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, texture.texels.data());
    glGenerateTextureMipmap(image.id());
    bytes_ += texture.texels.size() * 4 * 4 / 3;
    textures_.push_back(std::move(image));
    trilinear_.push_back(make_sampler(texture, 1.0f));
    anisotropic_.push_back(make_sampler(texture, anisotropy));
  }
  white_ = gl::Texture::image(GL_RGBA8, {1, 1});
  const glm::u8vec4 white(255);
  glTextureSubImage2D(white_.id(), 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, &white);

  GLint alignment = 256;
  glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
  block_stride_ = (sizeof(MaterialBlock) + size_t(alignment) - 1) / size_t(alignment) * size_t(alignment);
  update();
}

void Materials::update() {
  std::vector<std::byte> blocks(block_stride_ * scene_->materials.size());
  for (size_t i = 0; i < scene_->materials.size(); ++i) {
    const Material& material = scene_->materials[i];
    const MaterialBlock block{material.base_color, glm::vec4(material.emissive, material.normal_scale),
                              glm::vec4(material.metallic, material.roughness, coverage_cutoff(material), 0.0f)};
    std::memcpy(blocks.data() + i * block_stride_, &block, sizeof block);
  }
  blocks_ = gl::Buffer(std::span<const std::byte>(blocks));
}

gl::Defines Materials::defines(int index, bool anisotropic, bool labels) const {
  const Material& material = scene_->materials[size_t(index)];
  const auto truth = [](bool value) { return value ? "true" : "false"; };
  gl::Defines defines{{"BASE_COLOR_TEXTURE", truth(material.base_color_texture >= 0)},
                      {"NORMAL_TEXTURE", truth(!labels && material.normal_texture >= 0)},
                      {"METALLIC_ROUGHNESS_TEXTURE", truth(!labels && material.metallic_roughness_texture >= 0)},
                      {"EMISSIVE_TEXTURE", truth(!labels && material.emissive_texture >= 0)},
                      {"ALPHA_BLEND", truth(!labels && material.alpha == Material::Alpha::blend)},
                      {"UNLIT", truth(!labels && material.unlit)}};
  const bool masked = material.alpha == Material::Alpha::mask || (labels && material.alpha == Material::Alpha::blend);
  if (masked) defines["ALPHA_MASK"] = "1";
  if (anisotropic && software_) defines["FILTER_TAPS"] = "1";
  // So that triangles bring their tangents along.
  if (!labels && material.normal_texture >= 0) defines["TANGENTS"] = "1";
  return defines;
}

void Materials::bind(int index, bool anisotropic) const {
  const auto textures = textures_of(scene_->materials[size_t(index)]);
  for (GLuint unit = 0; unit < texture_units; ++unit) {
    const bool present = textures[unit] >= 0;
    const size_t texture = present ? size_t(textures[unit]) : 0;
    (present ? textures_[texture] : white_).bind(unit);
    glBindSampler(unit, present ? (anisotropic ? anisotropic_ : trilinear_)[texture].id() : 0);
  }
  glBindBufferRange(GL_UNIFORM_BUFFER, 1, blocks_.id(), GLintptr(size_t(index) * block_stride_), sizeof(MaterialBlock));
}

}  // namespace omma
