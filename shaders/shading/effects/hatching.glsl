// Pen and ink. Strokes lie at the multiples of a power of two in a coordinate of the surface, so that they stay where
// they are; the power is the one that gives the spacing asked for on the screen, and what lies between two powers is
// made up by strokes that grow between the others.
#ifndef __cplusplus
#include "shading/lines.glsl"
#include "shading/mapping.glsl"
#endif

struct Hatching {
  float width_px, spacing_px, angle_deg, crossing;
  int map;
  vec3 ink, paper;
};

SHADING real hatching_strokes(real at, real change, real width_px, real spacing_px) {
  real wanted = 1.0 / (spacing_px * change);  // strokes per unit
  real frequency = exp2(floor(log2(clamp(wanted, 1e-12, 1e12))));
  real per_pixel = change * frequency, width = width_px * per_pixel, grown = wanted / frequency - 1.0;
  real strokes = min(stripes(at * frequency, per_pixel, width) + stripes(at * frequency + 0.5, per_pixel, width * grown), 1.0);
  return choose(wanted > 1e-12, choose(wanted < 1e12, strokes, real(0.0)), real(0.0));
}

// From a mapping's axes to along and across the strokes.
SHADING vec2 hatching_turned(vec2 v, real angle) {
  return vec2(cos(angle) * v.x + sin(angle) * v.y, cos(angle) * v.y - sin(angle) * v.x);
}

SHADING vec4 hatching(Hatching parameters, Surface surface, vec4 color) {
  Mapping by_uv = uv_mapping(surface), by_world = world_mapping(surface);
  vec2 uv_footprint = footprint_of(by_uv);
  truth has_uv = (parameters.map == 0 ? max(uv_footprint.x, uv_footprint.y) : real(0.0)) > 0.0;
  real angle = radians(parameters.angle_deg);
  Mapping mapping;
  mapping.at = hatching_turned(choose(has_uv, by_uv.at, by_world.at), angle);
  mapping.dx = hatching_turned(choose(has_uv, by_uv.dx, by_world.dx), angle);
  mapping.dy = hatching_turned(choose(has_uv, by_uv.dy, by_world.dy), angle);
  vec2 change = footprint_of(mapping);

  // Half as bright as white to the eye, half as dark as black.
  real luminance = dot(xyz_of(color), vec3(0.2126, 0.7152, 0.0722));
  real darkness = 1.0 - pow(clamp(luminance, 0.0, 1.0), 1.0 / 2.2);
  real first = min(darkness, parameters.crossing), second = darkness - first;
  real ink = hatching_strokes(mapping.at.y, change.y, parameters.width_px, parameters.spacing_px / first);
  real crossed = hatching_strokes(mapping.at.x, change.x, parameters.width_px, parameters.spacing_px / second);
  return vec4(mix(parameters.paper, parameters.ink, ink + crossed - ink * crossed), color.w);
}
