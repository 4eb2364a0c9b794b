// The files of shaders/ that say what surfaces look like, as C++: sixteen fragments of one material at a time. Included
// once for every SIMD target, by Highway's rules.
#if defined(OMMA_SOFTWARE_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_SOFTWARE_SHADER_INL_H_
#undef OMMA_SOFTWARE_SHADER_INL_H_
#else
#define OMMA_SOFTWARE_SHADER_INL_H_
#endif

#include <cstdint>
#include <span>
#include <string_view>

#include "omma/software/effect_parameters-inl.h"
#include "omma/software/sample_surroundings-inl.h"
#include "omma/software/sample_texture-inl.h"
#include "omma/software/shade_fragments.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// What is global in GLSL is a member here: uniforms, textures, functions.
class Shader {
 public:
  using uint = uint32_t;
#include "common/frame.glsl"
#include "shading/footprint.glsl"
#include "shading/surface.glsl"

  explicit Shader(const ShadedScene& scene) : anisotropic_(scene.anisotropic) {
    frame.worldFromCamera = mat4(glm::mat4(scene.worldFromCamera));
    frame.ambient = vec4(glm::vec4(scene.scene->ambient, 0.0f));
    frame.background = vec4(scene.background ? glm::vec4(*scene.background, 1.0f) : glm::vec4(0.0f));
    frame.counts.x = uint(scene.lights.size());
    lights_ = scene.lights.data();
    effects_ = scene.effects;
    shadow_maps_ = scene.shadow_maps;
    shadow_depths_ = scene.shadow_depths;
    shadow_size_ = scene.shadow_size;
    surroundings_ = scene.surroundings;
    if (surroundings_ != nullptr) {
      const Surroundings& of = *surroundings_;
      frame.reflection = vec4(glm::vec4(of.focal, float(of.size), float(of.levels - 1), 0.0f));
    }
  }

  void set_material(const ShadedScene& scene, int index, bool shows_surroundings) {
    reflects_ = shows_surroundings;
    const Material& of = scene.scene->materials[size_t(index)];
    const auto texture = [&](int number) { return number < 0 ? nullptr : &scene.textures[size_t(number)]; };
    base_color_texture = texture(of.base_color_texture);
    normal_texture = texture(of.normal_texture);
    metallic_roughness_texture = texture(of.metallic_roughness_texture);
    emissive_texture = texture(of.emissive_texture);
    has.base_color_texture = base_color_texture != nullptr;
    has.normal_texture = normal_texture != nullptr;
    has.metallic_roughness_texture = metallic_roughness_texture != nullptr;
    has.emissive_texture = emissive_texture != nullptr;
    has.blended = of.alpha == Material::Alpha::blend;
    has.unlit = of.unlit;
    material.base_color = vec4(of.base_color);
    material.emissive = vec4(glm::vec4(of.emissive, of.normal_scale));
    material.parameters = vec4(glm::vec4(of.metallic, of.roughness, of.alpha_cutoff, 0.0f));
  }

  /// What of a surface is used; all else may hold anything.
  bool needs_tangents() const { return has.normal_texture; }
  bool needs_changes() const { return !effects_.empty(); }

#include "shading/reflection.glsl"
#include "shading/shadow.glsl"

#include "shading/lines.glsl"
#include "shading/mapping.glsl"

// All files of shaders/shading/effects.
#include "omma/software/effect_files.inc"

#include "shading/material.glsl"

 private:
  LightRecord light_of(uint number) const {
    const auto& light = lights_[number];
    return {vec4(light.position), vec4(light.direction), vec4(light.color), vec4(light.cone)};
  }
  int kind_of_light(uint number) const { return int(lights_[number].direction.w); }

  int first_map_of_light(uint number) const { return int(lights_[number].cone.z); }
  int maps_of_light(uint number) const { return int(lights_[number].cone.w); }
  vec4 map_texel(int number, int part) const {
    const ShadowMapRecord& map = shadow_maps_[size_t(number)];
    return vec4(part < 3 ? map.mapFromCamera[part] : map.lens);
  }
  vec4 map_texel(const real& number, int part) const {
    constexpr int record_floats = sizeof(ShadowMapRecord) / sizeof(float);
    const auto* floats = reinterpret_cast<const float*>(shadow_maps_.data()) + 4 * part;
    const Places first = places_of(number * real(record_floats), last_map() * record_floats);
    return {gathered(floats, first), gathered(floats + 1, first), gathered(floats + 2, first),
            gathered(floats + 3, first)};
  }
  int last_map() const { return int(shadow_maps_.size()) - 1; }
  float shadow_map_side() const { return float(shadow_size_); }
  real shadow_texel(const real& number, const vec2& texel) const {
    const int last = shadow_size_ - 1;
    const Places row = in_rows(places_of(number, last_map()), shadow_size_, places_of(texel.y, last));
    return gathered(shadow_depths_, in_rows(row, shadow_size_, places_of(texel.x, last)));
  }

  bool reflects(const Surface&) const { return reflects_; }
  HWY_NOINLINE vec3 surroundings_at(int side, const vec2& at, const real& level) const {
    return sample_surroundings(*surroundings_, side, at, level);
  }

  HWY_NOINLINE vec4 with_effect(const Effect& effect, const Surface& surface, const vec4& color) {
    const std::string_view name = effect.info->name;
#define OMMA_EFFECT(type, function) \
  if (name == #function) return function(parameters_of<type>(effect), surface, color);
#include "omma/software/effect_list.inc"
#undef OMMA_EFFECT
    return color;
  }
  vec4 with_effects(bool that_paint, const Surface& surface, vec4 color) {
    for (const Effect& effect : effects_) {
      if (effect.info->paints == that_paint) color = with_effect(effect, surface, color);
    }
    return color;
  }
  /// As in shading/effects.glsl.
  vec4 paint(const Surface& surface, const vec4& color) { return with_effects(true, surface, color); }
  vec4 draw_over(const Surface& surface, const vec4& color) { return with_effects(false, surface, color); }

  /// As in shading/texture.glsl.
  HWY_NOINLINE vec4 sample_filtered(const MipTexture* texture, const vec2& uv, const vec2& dx, const vec2& dy) {
    const vec2 size{real(float(texture->width)), real(float(texture->height))};
    const vec2 across = bounded(dx), down = bounded(dy);
    if (!anisotropic_) {
      return sample_texture(*texture, uv, log2(max(max(length(across * size), length(down * size)), 1e-6)));
    }
    const Footprint footprint = footprint_of(across, down, size);
    const real share = real(1.0f) / footprint.taps;
    vec4 sum(real(0.0f));
    for (float i = 0.5f;; i += 1.0f) {
      const truth taken = real(i) < footprint.taps;
      if (bits(taken) == 0) return sum * share;
      const vec4 tap = sample_texture(*texture, uv + footprint.axis * (real(i) * share - 0.5), footprint.lod);
      sum = choose(taken, sum + tap, sum);
    }
  }

  struct {
    mat4 worldFromCamera;
    vec4 ambient, background;
    struct {
      uint x;
    } counts;
    vec4 reflection;
  } frame;
  struct {
    vec4 base_color, emissive, parameters;
  } material;
  MaterialParts has{};  ///< none before set_material
  const MipTexture *base_color_texture, *normal_texture, *metallic_roughness_texture, *emissive_texture;
  const omma::LightRecord* lights_;
  std::span<const Effect> effects_;
  std::span<const ShadowMapRecord> shadow_maps_;
  const float* shadow_depths_;
  int shadow_size_;
  const Surroundings* surroundings_;
  bool reflects_ = false;
  bool anisotropic_;
};

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
