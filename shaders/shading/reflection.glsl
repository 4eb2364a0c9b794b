// What surrounds the reflecting object, from two paraboloid maps around its middle. Matches
// shading/reflection_layers.h and software/shader-inl.h.

#ifndef __cplusplus
layout(binding = 27) uniform sampler2DArray surroundings;

vec3 surroundings_at(int side, vec2 at, float level) {
  return textureLod(surroundings, vec3(at, float(side)), level).rgb;
}
bool reflects(Surface surface) {
  return surface.object == int(frame.counts.y);
}
#endif

SHADING vec3 surroundings_in(int side, vec3 from_map, real alpha) {
  // Far behind the map no texel is asked for, and any number will do.
  real scale = 2.0 / max(1.0 + from_map.z, 0.5);
  // A level's texel should be about as wide as the lobe, some 2 alpha radians; a map's are wider at its middle.
  real texels_per_radian = frame.reflection.x * scale;
  real level = clamp(log2(2.0 * alpha * texels_per_radian), 0.0, frame.reflection.z);
  vec2 plane = vec2(from_map.x, from_map.y) * scale;
  return surroundings_at(side, 0.5 + plane * (frame.reflection.x / frame.reflection.y), level);
}

// Radiance from a direction of the camera frame, blurred as far as a surface of this roughness (squared) scatters.
SHADING vec3 surroundings_along(vec3 direction, real alpha) {
  vec3 d = normalize(mat3(frame.worldFromCamera) * direction);
  // Right, down, ahead: the first map looks along -Z, the second along +Z. Blurred, they differ where they meet.
  real first = smoothstep(-0.1, 0.1, -d.z);
  vec3 seen = vec3(0.0);
  if (some(first > 0.0)) seen += first * surroundings_in(0, vec3(d.x, -d.y, -d.z), alpha);
  if (some(first < 1.0)) seen += (1.0 - first) * surroundings_in(1, vec3(-d.x, -d.y, d.z), alpha);
  return seen;
}
