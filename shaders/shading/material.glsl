// What a surface looks like: metallic-roughness under suns, points, spots and ambient light. Every technique calls
// shade(); none knows what is in it. Matches MaterialBlock in shading/materials.cpp.
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
#endif

layout(std140, binding = 1) uniform MaterialBlock {
  vec4 base_color;
  vec4 emissive;    // w: scale of the normal map
  vec4 parameters;  // metallic, roughness, alpha cutoff
} material;

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D normal_texture;
layout(binding = 2) uniform sampler2D metallic_roughness_texture;
layout(binding = 3) uniform sampler2D emissive_texture;

// Linear colour and coverage of the surface before any light.
vec4 surface_color(Surface surface) {
  vec4 color = material.base_color * surface.color;
#ifdef BASE_COLOR_TEXTURE
  color *= sample_filtered(base_color_texture, surface.uv, surface.uv_dx, surface.uv_dy);
#endif
  return color;
}

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

vec3 shading_normal(Surface surface) {
#ifdef NORMAL_TEXTURE
  vec3 local = sample_filtered(normal_texture, surface.uv, surface.uv_dx, surface.uv_dy).xyz * 2.0 - 1.0;
  local.xy *= material.emissive.w;
  vec3 tangent = surface.tangent.xyz - surface.normal * dot(surface.normal, surface.tangent.xyz);
  float tangent_length = length(tangent);
  if (tangent_length < 1e-6) return surface.normal;
  tangent /= tangent_length;
  vec3 bitangent = cross(surface.normal, tangent) * surface.tangent.w;
  return normalize(tangent * local.x + bitangent * local.y + surface.normal * max(local.z, 1e-3));
#else
  return surface.normal;
#endif
}

// GGX with Smith's masking and Schlick's Fresnel, times the cosine.
vec3 specular(vec3 f0, float alpha, vec3 normal, vec3 view, vec3 light, float n_l, float n_v) {
  vec3 halfway = normalize(view + light);
  float n_h = max(dot(normal, halfway), 0.0), v_h = max(dot(view, halfway), 0.0);
  float a2 = alpha * alpha;
  float d = n_h * n_h * (a2 - 1.0) + 1.0;
  float distribution = a2 / (3.14159265 * d * d);
  float masking = 0.5 / max(n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2), 1e-5);
  float grazing = 1.0 - v_h, grazing2 = grazing * grazing;
  vec3 fresnel = f0 + (1.0 - f0) * (grazing2 * grazing2 * grazing);
  return fresnel * (distribution * masking * n_l);
}

// Irradiance perpendicular to the light's direction, which is returned too.
vec3 incoming_light(LightRecord light, vec3 position, out vec3 towards) {
  if (light.direction.w == 0.0) {
    towards = -light.direction.xyz;
    return light.color.rgb;
  }
  vec3 offset = light.position.xyz - position;
  float distance2 = max(dot(offset, offset), 1e-8);
  towards = offset * inversesqrt(distance2);
  float falloff = 1.0 / distance2;
  if (light.position.w > 0.0) {
    float reach = distance2 / (light.position.w * light.position.w);
    falloff *= pow(clamp(1.0 - reach * reach, 0.0, 1.0), 2.0);
  }
  if (light.direction.w == 2.0) {
    float cosine = dot(-towards, light.direction.xyz);
    falloff *= smoothstep(light.cone.y, light.cone.x, cosine);
  }
  return light.color.rgb * falloff;
}

// Coverage: one unless the material lets through what is behind it.
float surface_coverage(vec4 base) {
#ifdef ALPHA_BLEND
  return base.a;
#else
  return 1.0;
#endif
}

// Linear radiance towards the camera of a surface of this colour, and coverage.
vec4 lit(Surface surface, vec4 base) {
#ifdef UNLIT
  return vec4(base.rgb, surface_coverage(base));
#else
  float metallic = material.parameters.x, roughness = material.parameters.y;
#ifdef METALLIC_ROUGHNESS_TEXTURE
  vec4 measured = sample_filtered(metallic_roughness_texture, surface.uv, surface.uv_dx, surface.uv_dy);
  metallic *= measured.b;
  roughness *= measured.g;
#endif
  vec3 emitted = material.emissive.rgb;
#ifdef EMISSIVE_TEXTURE
  emitted *= sample_filtered(emissive_texture, surface.uv, surface.uv_dx, surface.uv_dy).rgb;
#endif
  vec3 normal = shading_normal(surface);
  vec3 view = -normalize(surface.position);
  float n_v = max(dot(normal, view), 1e-4);
  float alpha = max(roughness * roughness, 1e-3);
  vec3 diffuse = base.rgb * (1.0 - metallic);
  vec3 f0 = mix(vec3(0.04), base.rgb, metallic);

  // Light from everywhere: more from above than from below, and a soft reflection for metals.
  float up = dot(normal, transpose(mat3(frame.worldFromCamera))[1]);
  vec3 ambient = frame.ambient.rgb * (0.75 + 0.25 * up);
  vec3 radiance = emitted + ambient * (diffuse + f0);
#ifdef REFLECTION
  // A rough surface shows less of the brightening at grazing angles (Lagarde 2011).
  if (surface.object == int(frame.counts.y)) {
    float grazing = 1.0 - n_v, grazing2 = grazing * grazing;
    vec3 fresnel = f0 + (max(vec3(1.0 - roughness), f0) - f0) * (grazing2 * grazing2 * grazing);
    radiance = emitted + ambient * diffuse + fresnel * surroundings_along(reflect(-view, normal), alpha);
  }
#endif
  for (uint i = 0u; i < frame.counts.x; ++i) {
    vec3 light;
    vec3 irradiance = incoming_light(light_of(i), surface.position, light);
    float n_l = max(dot(normal, light), 0.0);
#ifdef SHADOWS
    if (n_l > 0.0) irradiance *= light_reaching(light_of(i), surface);
#endif
    radiance += irradiance * (diffuse * (n_l / 3.14159265) + specular(f0, alpha, normal, view, light, n_l, n_v));
  }
  return vec4(radiance, surface_coverage(base));
#endif
}

// What the camera sees of a surface: linear radiance and coverage.
vec4 shade(Surface surface) {
#ifdef EFFECTS
  return draw_over(surface, lit(surface, paint(surface, surface_color(surface))));
#else
  return lit(surface, surface_color(surface));
#endif
}
