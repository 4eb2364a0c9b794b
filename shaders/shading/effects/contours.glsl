// Lines of equal height.
#include "shading/lines.glsl"

struct Contours {
  float interval_m, base_m, width_px;
  vec3 color;
};

vec4 contours(Contours parameters, Surface surface, vec4 color) {
  mat3 world = mat3(frame.worldFromCamera);
  // Level ground lies at one height: it has no line, or is one.
  if (length((world * surface.normal).xz) < 1e-3) return color;
  float height = (frame.worldFromCamera * vec4(surface.position, 1.0)).y - parameters.base_m;
  float change = length(vec2((world * surface.position_dx).y, (world * surface.position_dy).y)) / parameters.interval_m;
  float covered = stripes(height / parameters.interval_m, change, parameters.width_px * change);
  return lay_over(color, parameters.color, covered);
}
