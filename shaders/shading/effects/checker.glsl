// Squares of two colours in turn.
#ifndef __cplusplus
#include "shading/lines.glsl"
#include "shading/mapping.glsl"
#endif

struct Checker {
  float size_m;
  vec3 color, other_color;
};

SHADING vec4 checker(Checker parameters, Surface surface, vec4 color) {
  Mapping mapping = world_mapping(surface);
  vec2 at = 0.5 * mapping.at / parameters.size_m - 0.25, footprint = 0.5 * footprint_of(mapping) / parameters.size_m;
  // +1 and -1 in turn along each axis; their product says which colour.
  real x = 2.0 * stripes(at.x, footprint.x, 0.5) - 1.0, y = 2.0 * stripes(at.y, footprint.y, 0.5) - 1.0;
  return vec4(mix(parameters.other_color, parameters.color, 0.5 + 0.5 * x * y), color.w);
}
