// Lines of equal height.
#ifndef __cplusplus
#include "shading/lines.glsl"
#endif

struct Contours {
  float interval_m, base_m, width_px;
  vec3 color;
};

SHADING vec4 contours(Contours parameters, Surface surface, vec4 color) {
  mat3 world = mat3(frame.worldFromCamera);
  vec3 normal = world * surface.normal;
  real height = (frame.worldFromCamera * vec4(surface.position, 1.0)).y - parameters.base_m;
  real change = length(vec2((world * surface.position_dx).y, (world * surface.position_dy).y)) / parameters.interval_m;
  real covered = stripes(height / parameters.interval_m, change, parameters.width_px * change);
  // Level ground lies at one height: it has no line, or is one.
  return choose(length(vec2(normal.x, normal.z)) < 1e-3, color, lay_over(color, parameters.color, covered));
}
