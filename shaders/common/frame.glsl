// What holds for a whole frame. Matches FrameBlock in technique/gpu_scene.cpp and LightRecord in scene/lights.h.
#ifndef __cplusplus
#include "shading/language.glsl"
#endif

struct LightRecord {
  vec4 position;   // camera frame; w: range in metres, 0 none
  vec4 direction;  // camera frame, the way the light travels; w: its kind
  vec4 color;      // suns: irradiance; others: radiant intensity
  vec4 cone;       // cosines of the spot's inner and outer angle; first and number of its shadow maps
};
const int LIGHT_SUN = 0, LIGHT_POINT = 1, LIGHT_SPOT = 2;

#ifndef __cplusplus
layout(std140, binding = 0) uniform FrameBlock {
  mat4 worldFromCamera;
  vec4 ambient;     // linear radiance from everywhere
  vec4 background;  // linear; w is 0 for a sky
  uvec4 counts;     // x: lights; y: the object that reflects; z: the one that is hidden
  vec4 reflection;  // of its maps: focal length and size in texels, last level
} frame;

layout(binding = 15) uniform samplerBuffer light_texels;

LightRecord light_of(uint number) {
  int at = 4 * int(number);
  return LightRecord(texelFetch(light_texels, at), texelFetch(light_texels, at + 1), texelFetch(light_texels, at + 2),
                     texelFetch(light_texels, at + 3));
}
int kind_of_light(uint number) {
  return int(texelFetch(light_texels, 4 * int(number) + 1).w);
}
#endif

SHADING vec3 sky(vec3 world_direction) {
  real height = world_direction.y;
  vec3 horizon = vec3(0.72, 0.80, 0.88);
  vec3 above = mix(horizon, vec3(0.16, 0.34, 0.66), pow(max(height, 0.0), 0.55));
  vec3 below = mix(horizon * 0.8, vec3(0.20, 0.19, 0.18), min(1.0, -4.0 * height));
  return choose(height > 0.0, above, below);
}

// Radiance of a ray that meets nothing.
SHADING vec3 background(vec3 direction) {
  return choose(frame.background.w > 0.0, xyz_of(frame.background), sky(mat3(frame.worldFromCamera) * direction));
}
