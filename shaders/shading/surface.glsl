#ifndef __cplusplus
#include "shading/language.glsl"
#endif

// A point of a surface, whichever technique found it. All in the camera frame, whose origin is the camera's centre.
struct Surface {
  vec3 position;  // metres
  vec3 normal;    // interpolated, unit length, on the camera's side of the triangle
  vec4 tangent;   // unit length; w is the bitangent's sign
  vec2 uv;
  vec2 uv_dx, uv_dy;  // change per pixel to the right and down
  vec4 color;         // of the vertices, linear
#ifndef __cplusplus
  int triangle, object, material;
#endif
#if defined(SHADOWS) || defined(__cplusplus)
  vec3 plane;  // of its triangle: a normal of any length, to either side
#endif
#if defined(EFFECTS) || defined(__cplusplus)
  vec3 position_dx, position_dy;  // metres per pixel to the right and down
  vec3 barycentric, barycentric_dx, barycentric_dy;
#endif
};
