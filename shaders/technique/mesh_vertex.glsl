// A vertex on its way through the rasterizer: the same for every technique that rasterizes.
#include "common/geometry.glsl"

#define MESH_VERTEX MeshVertex { \
  vec3 position; /* camera frame */ \
  vec3 normal;                      \
  vec4 tangent;                     \
  vec2 uv;                          \
  vec4 color;                       \
  flat uvec2 part; /* instance, id of its first triangle in this draw */ \
}
