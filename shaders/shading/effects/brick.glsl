// Bricks in running bond: every other course is moved by half a brick.
#ifndef __cplusplus
#include "shading/lines.glsl"
#include "shading/mapping.glsl"
#endif

struct Brick {
  float length_m, height_m, mortar_m;
  vec3 color, mortar_color;
};

SHADING vec4 brick(Brick parameters, Surface surface, vec4 color) {
  Mapping mapping = world_mapping(surface);
  vec2 size = vec2(parameters.length_m, parameters.height_m);
  vec2 at = mapping.at / size, footprint = footprint_of(mapping) / size, width = parameters.mortar_m / size;
  real bed = stripes(at.y, footprint.y, width.y);
  // A pixel may see courses of both kinds.
  real moved = stripes(0.5 * at.y - 0.75, 0.5 * footprint.y, 0.5);
  real joint = mix(stripes(at.x, footprint.x, width.x), stripes(at.x + 0.5, footprint.x, width.x), moved);
  real mortar = bed + joint - bed * joint;
  return vec4(mix(parameters.color, parameters.mortar_color, mortar), color.w);
}
