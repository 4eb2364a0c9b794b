// What a surface looks like: metallic-roughness under suns, points, spots and ambient light. Every technique calls
// shade(); none knows what is in it. Matches MaterialBlock in technique/materials.cpp and software/shader-inl.h.
#ifndef __cplusplus
#include "common/frame.glsl"
#include "shading/surface.glsl"
#include "shading/texture.glsl"
#ifdef SHADOWS
#include "shading/shadow.glsl"
#endif
#ifdef REFLECTION
#include "shading/reflection.glsl"
#endif
#ifdef EFFECTS
#include "shading/effects.glsl"
#else
vec4 paint(Surface surface, vec4 color) {
  return color;
}
vec4 draw_over(Surface surface, vec4 color) {
  return color;
}
#endif
#endif

// The parts of a material that others do without.
struct MaterialParts {
  bool base_color_texture, normal_texture, metallic_roughness_texture, emissive_texture, blended, unlit;
};

#ifndef __cplusplus
const MaterialParts has = MaterialParts(BASE_COLOR_TEXTURE, NORMAL_TEXTURE, METALLIC_ROUGHNESS_TEXTURE, EMISSIVE_TEXTURE,
                                        ALPHA_BLEND, UNLIT);

layout(std140, binding = 1) uniform MaterialBlock {
  vec4 base_color;
  vec4 emissive;    // w: scale of the normal map
  vec4 parameters;  // metallic, roughness, alpha cutoff
} material;

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 2) uniform sampler2D metallic_roughness_texture;
layout(binding = 3) uniform sampler2D emissive_texture;
#endif

// Linear colour and coverage of the surface before any light.
SHADING vec4 surface_color(Surface surface) {
  vec4 color = material.base_color * surface.color;
  if (has.base_color_texture) color *= sample_filtered(base_color_texture, surface.uv, surface.uv_dx, surface.uv_dy);
  return color;
}

#ifndef __cplusplus
// True where a masked material has a hole, and all over the object that is hidden.
bool surface_is_hole(Surface surface) {
#ifdef HIDDEN_OBJECT
  if (surface.object == int(frame.counts.z)) return true;
#endif
#ifdef ALPHA_MASK
  return surface_color(surface).a < material.parameters.z;
#else
  return false;
#endif
}
#endif

SHADING vec3 shading_normal(Surface surface) {
  if (!has.normal_texture) return surface.normal;
  vec3 local = xyz_of(sample_filtered(normal_texture, surface.uv, surface.uv_dx, surface.uv_dy)) * 2.0 - 1.0;
  vec3 tangent = xyz_of(surface.tangent) - surface.normal * dot(surface.normal, xyz_of(surface.tangent));
  real tangent_length = length(tangent);
  tangent /= max(tangent_length, 1e-6);
  vec3 bitangent = cross(surface.normal, tangent) * surface.tangent.w;
  vec3 along = (tangent * local.x + bitangent * local.y) * material.emissive.w;
  return choose(tangent_length < 1e-6, surface.normal, normalize(along + surface.normal * max(local.z, 1e-3)));
}

// GGX with Smith's masking and Schlick's Fresnel, times the cosine.
SHADING vec3 specular(vec3 f0, real alpha, vec3 normal, vec3 view, vec3 light, real n_l, real n_v) {
  vec3 halfway = normalize(view + light);
  real n_h = max(dot(normal, halfway), 0.0), v_h = max(dot(view, halfway), 0.0);
  real a2 = alpha * alpha;
  real d = n_h * n_h * (a2 - 1.0) + 1.0;
  real distribution = a2 / (3.14159265 * d * d);
  real masking = 0.5 / max(n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2), 1e-5);
  real grazing = 1.0 - v_h, grazing2 = grazing * grazing;
  vec3 fresnel = f0 + (1.0 - f0) * (grazing2 * grazing2 * grazing);
  return fresnel * (distribution * masking * n_l);
}

// Irradiance perpendicular to the light's direction, which is returned too.
SHADING vec3 incoming_light(LightRecord light, int kind, vec3 position, OUT(vec3) towards) {
  if (kind == LIGHT_SUN) {
    towards = -xyz_of(light.direction);
    return xyz_of(light.color);
  }
  vec3 offset = xyz_of(light.position) - position;
  real distance2 = max(dot(offset, offset), 1e-8);
  towards = offset * inversesqrt(distance2);
  real falloff = 1.0 / distance2;
  real reach = distance2 / (light.position.w * light.position.w);
  real within = clamp(1.0 - reach * reach, 0.0, 1.0);
  falloff *= choose(light.position.w > 0.0, within * within, real(1.0));
  if (kind == LIGHT_SPOT) falloff *= smoothstep(light.cone.y, light.cone.x, dot(-towards, xyz_of(light.direction)));
  return xyz_of(light.color) * falloff;
}

// Coverage: one unless the material lets through what is behind it.
SHADING real surface_coverage(vec4 base) {
  return has.blended ? base.w : real(1.0);
}

// Linear radiance towards the camera of a surface of this colour, and coverage.
SHADING vec4 lit(Surface surface, vec4 base) {
  if (has.unlit) return vec4(xyz_of(base), surface_coverage(base));
  real metallic = material.parameters.x, roughness = material.parameters.y;
  if (has.metallic_roughness_texture) {
    vec4 measured = sample_filtered(metallic_roughness_texture, surface.uv, surface.uv_dx, surface.uv_dy);
    metallic *= measured.z;
    roughness *= measured.y;
  }
  vec3 emitted = xyz_of(material.emissive);
  if (has.emissive_texture) {
    emitted *= xyz_of(sample_filtered(emissive_texture, surface.uv, surface.uv_dx, surface.uv_dy));
  }
  vec3 normal = shading_normal(surface);
  vec3 view = -normalize(surface.position);
  real n_v = max(dot(normal, view), 1e-4);
  real alpha = max(roughness * roughness, 1e-3);
  vec3 diffuse = xyz_of(base) * (1.0 - metallic);
  vec3 f0 = mix(vec3(0.04), xyz_of(base), metallic);

  // Light from everywhere: more from above than from below, and a soft reflection for metals.
  real up = dot(normal, transpose(mat3(frame.worldFromCamera))[1]);
  vec3 ambient = xyz_of(frame.ambient) * (0.75 + 0.25 * up);
  vec3 radiance = emitted + ambient * (diffuse + f0);
#if defined(REFLECTION) || defined(__cplusplus)
  // A rough surface shows less of the brightening at grazing angles (Lagarde 2011).
  if (reflects(surface)) {
    real grazing = 1.0 - n_v, grazing2 = grazing * grazing;
    vec3 fresnel = f0 + (max(vec3(1.0 - roughness), f0) - f0) * (grazing2 * grazing2 * grazing);
    radiance = emitted + ambient * diffuse + fresnel * surroundings_along(reflect(-view, normal), alpha);
  }
#endif
  for (uint i = 0u; i < frame.counts.x; ++i) {
    vec3 light;
    vec3 irradiance = incoming_light(light_of(i), kind_of_light(i), surface.position, light);
    real n_l = max(dot(normal, light), 0.0);
#if defined(SHADOWS) || defined(__cplusplus)
    irradiance *= choose(n_l > 0.0, light_reaching(i, surface), real(1.0));
#endif
    radiance += irradiance * (diffuse * (n_l / 3.14159265) + specular(f0, alpha, normal, view, light, n_l, n_v));
  }
  return vec4(radiance, surface_coverage(base));
}

// What the camera sees of a surface: linear radiance and coverage.
SHADING vec4 shade(Surface surface) {
  return draw_over(surface, lit(surface, paint(surface, surface_color(surface))));
}
