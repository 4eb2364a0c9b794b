// Materials: every format's words for a surface turned into metallic-roughness.
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "omma/base/error.h"
#include "omma/scene/file/import.h"

namespace omma::file {
namespace {

float get(const aiMaterial& source, const char* key, unsigned type, unsigned index, float otherwise) {
  float value = otherwise;
  source.Get(key, type, index, value);
  return std::isfinite(value) ? value : otherwise;
}

std::optional<glm::vec4> get_color(const aiMaterial& source, const char* key, unsigned type, unsigned index) {
  aiColor4D color(0, 0, 0, 1);
  if (source.Get(key, type, index, color) != AI_SUCCESS) return std::nullopt;
  const glm::vec4 result(color.r, color.g, color.b, color.a);
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(result[i])) return std::nullopt;
  }
  return glm::max(result, glm::vec4(0.0f));
}

Texture::Wrap to_wrap(int mode) {
  switch (mode) {
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal:
      return Texture::Wrap::clamp;
    case aiTextureMapMode_Mirror:
      return Texture::Wrap::mirror;
    default:
      return Texture::Wrap::repeat;
  }
}

/// The textures of one material; they share the first one's uvs.
class TextureReader {
 public:
  TextureReader(Import& import, const aiMaterial& source) : import_(import), source_(source) {}

  /// The first of `types` that the material has, or -1.
  int read(std::initializer_list<aiTextureType> types, bool srgb) {
    for (const aiTextureType type : types) {
      aiString name;
      if (source_.Get(AI_MATKEY_TEXTURE(type, 0), name) != AI_SUCCESS || name.length == 0) continue;
      int channel = 0;
      source_.Get(AI_MATKEY_UVWSRC(type, 0), channel);
      if (!uv_channel_) uv_channel_ = channel;
      if (channel != *uv_channel_) ++import_.repairs.second_uv_sets;
      int u = aiTextureMapMode_Wrap, v = aiTextureMapMode_Wrap;
      source_.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), u);
      source_.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), v);
      return import_texture(import_, name.C_Str(), srgb, to_wrap(u), to_wrap(v));
    }
    return -1;
  }

  unsigned uv_channel() const {
    const int channel = uv_channel_.value_or(0);
    return channel >= 0 && channel < AI_MAX_NUMBER_OF_TEXTURECOORDS ? static_cast<unsigned>(channel) : 0;
  }

 private:
  Import& import_;
  const aiMaterial& source_;
  std::optional<int> uv_channel_;
};

/// glTF says it outright. In the others an opacity below 1 blends, and a picture with holes (leaves, fences) cuts out.
void import_alpha(const Import& import, const aiMaterial& source, Material& material) {
  if (import.gltf) {
    aiString mode;
    source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
    if (mode == aiString("MASK")) material.alpha = Material::Alpha::mask;
    if (mode == aiString("BLEND")) material.alpha = Material::Alpha::blend;
    material.alpha_cutoff = get(source, AI_MATKEY_GLTF_ALPHACUTOFF, 0.5f);
    return;
  }
  // Some exporters write transparency where opacity is meant, and a model that is wholly invisible is of no use to
  // anyone: 0 is taken for opaque.
  const float opacity = std::clamp(get(source, AI_MATKEY_OPACITY, 1.0f), 0.0f, 1.0f);
  material.base_color.a = opacity > 0.0f ? opacity : 1.0f;
  if (material.base_color.a < 1.0f) {
    material.alpha = Material::Alpha::blend;
  } else if (material.base_color_texture >= 0) {
    const Texture& texture = import.scene.textures[material.base_color_texture];
    if (std::any_of(texture.texels.begin(), texture.texels.end(),
                    [](const glm::u8vec4& texel) { return texel.a < 255; })) {
      material.alpha = Material::Alpha::mask;
    }
  }
}

void import_colors(const Import& import, const aiMaterial& source, Material& material) {
  auto base = get_color(source, AI_MATKEY_BASE_COLOR);
  const bool own_base = base.has_value();
  if (!base) base = get_color(source, AI_MATKEY_COLOR_DIFFUSE);
  material.base_color = base.value_or(glm::vec4(1.0f));
  if (!import.gltf) material.base_color.a = 1.0f;
  auto emissive = get_color(source, AI_MATKEY_COLOR_EMISSIVE);
  material.emissive = glm::vec3(emissive.value_or(glm::vec4(0.0f)));
  if (import.gltf) return;
  // OBJ and FBX exporters write black where a picture takes the colour's place.
  if (!own_base && material.base_color_texture >= 0 && glm::vec3(material.base_color) == glm::vec3(0.0f)) {
    material.base_color = glm::vec4(1.0f);
  }
  if (material.emissive_texture >= 0 && material.emissive == glm::vec3(0.0f)) {
    material.emissive = glm::vec3(1.0f);
  }
}

void import_gloss(const Import& import, const aiMaterial& source, Material& material) {
  if (import.gltf) {
    material.metallic = get(source, AI_MATKEY_METALLIC_FACTOR, 1.0f);
    material.roughness = get(source, AI_MATKEY_ROUGHNESS_FACTOR, 1.0f);
    float glossiness = 0.0f;
    if (source.Get(AI_MATKEY_GLOSSINESS_FACTOR, glossiness) == AI_SUCCESS) {
      material.metallic = 0.0f;  // KHR_materials_pbrSpecularGlossiness
      material.roughness = 1.0f - glossiness;
    }
  } else {
    // A Phong exponent n is a microfacet distribution of roughness² = sqrt(2 / (n + 2)) (Walter et al. 2007).
    const float exponent = std::max(get(source, AI_MATKEY_SHININESS, 0.0f), 0.0f);
    const auto specular = get_color(source, AI_MATKEY_COLOR_SPECULAR);
    const bool shiny = exponent > 0.0f && specular && glm::vec3(*specular) != glm::vec3(0.0f);
    const float phong = shiny ? std::pow(2.0f / (exponent + 2.0f), 0.25f) : 0.9f;
    material.metallic = get(source, AI_MATKEY_METALLIC_FACTOR, 0.0f);
    material.roughness = get(source, AI_MATKEY_ROUGHNESS_FACTOR, phong);
  }
  material.metallic = std::clamp(material.metallic, 0.0f, 1.0f);
  material.roughness = std::clamp(material.roughness, 0.0f, 1.0f);
}

}  // namespace

int import_material(Import& import, unsigned source_index) {
  const auto [entry, fresh] =
      import.material_of_source.try_emplace(source_index, static_cast<int>(import.scene.materials.size()));
  if (!fresh) return entry->second;
  Material material;
  unsigned uv_channel = 0;
  if (source_index < import.source.mNumMaterials) {
    const aiMaterial& source = *import.source.mMaterials[source_index];
    material.name = source.GetName().C_Str();
    TextureReader textures(import, source);
    material.base_color_texture = textures.read({aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, true);
    material.normal_texture = textures.read({aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA}, false);
    material.emissive_texture = textures.read({aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR}, true);
    // Only glTF promises roughness in G and metallic in B of one picture.
    if (import.gltf) {
      material.metallic_roughness_texture = textures.read({aiTextureType_UNKNOWN}, false);
    }
    if (source.GetTextureCount(aiTextureType_HEIGHT) > 0 && material.normal_texture < 0) {
      ++import.repairs.height_maps;
    }
    // A picture that is its own opacity map has an alpha channel, and import_alpha finds it.
    aiString opacity, base;
    source.Get(AI_MATKEY_TEXTURE_DIFFUSE(0), base);
    if (source.Get(AI_MATKEY_TEXTURE_OPACITY(0), opacity) == AI_SUCCESS && opacity != base) {
      ++import.repairs.opacity_maps;
    }
    uv_channel = textures.uv_channel();
    import_colors(import, source, material);
    import_gloss(import, source, material);
    import_alpha(import, source, material);
    material.normal_scale = get(source, AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0), 1.0f);
    int shading = 0;
    source.Get(AI_MATKEY_SHADING_MODEL, shading);
    material.unlit = shading == aiShadingMode_Unlit;
    // Other formats leave sidedness open, and many of their models are wound at random.
    int two_sided = 0;
    source.Get(AI_MATKEY_TWOSIDED, two_sided);
    material.double_sided = two_sided != 0 || !import.gltf;
  }
  import.scene.materials.push_back(std::move(material));
  import.uv_channel.push_back(uv_channel);
  return entry->second;
}

}  // namespace omma::file
