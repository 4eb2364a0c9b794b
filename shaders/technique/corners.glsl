// A triangle's corners, fetched by its number.
#include "common/geometry.glsl"

layout(binding = 5) uniform samplerBuffer positions;
layout(binding = 9) uniform usamplerBuffer triangles;

uvec3 corners_of(InstanceRecord instance, uint triangle) {
  return texelFetch(triangles, int(instance.numbers.y + triangle - instance.numbers.x)).xyz;
}

// In the camera frame.
vec3 corner_position(InstanceRecord instance, uint corner) {
  return to_camera(instance, texelFetch(positions, int(corner)).xyz);
}
