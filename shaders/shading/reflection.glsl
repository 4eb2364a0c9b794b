// What surrounds the reflecting object, from two paraboloid maps around its middle. Matches
// technique/reflection/reflection_maps.cpp.

layout(binding = 27) uniform sampler2DArray surroundings;

vec3 surroundings_in(float side, vec3 from_map, float alpha) {
  // A level's texel should be about as wide as the lobe, some 2 alpha radians; a map's are wider at its middle.
  float texels_per_radian = frame.reflection.x * 2.0 / (1.0 + from_map.z);
  float level = clamp(log2(2.0 * alpha * texels_per_radian), 0.0, frame.reflection.z);
  vec2 plane = 2.0 * from_map.xy / (1.0 + from_map.z);
  vec2 at = 0.5 + plane * (frame.reflection.x / frame.reflection.y);
  return textureLod(surroundings, vec3(at, side), level).rgb;
}

// Radiance from a direction of the camera frame, blurred as far as a surface of this roughness (squared) scatters.
vec3 surroundings_along(vec3 direction, float alpha) {
  vec3 d = normalize(mat3(frame.worldFromCamera) * direction);
  // Right, down, ahead: the first map looks along -Z, the second along +Z. Blurred, they differ where they meet.
  float first = smoothstep(-0.1, 0.1, -d.z);
  vec3 seen = vec3(0.0);
  if (first > 0.0) seen += first * surroundings_in(0.0, vec3(d.x, -d.y, -d.z), alpha);
  if (first < 1.0) seen += (1.0 - first) * surroundings_in(1.0, vec3(-d.x, -d.y, d.z), alpha);
  return seen;
}
