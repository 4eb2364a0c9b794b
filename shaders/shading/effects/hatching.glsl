// Pen and ink. Strokes lie at the multiples of a power of two in a coordinate of the surface, so that they stay where
// they are; the power is the one that gives the spacing asked for on the screen, and what lies between two powers is
// made up by strokes that grow between the others.
#include "shading/lines.glsl"
#include "shading/mapping.glsl"

struct Hatching {
  float width_px, spacing_px, angle_deg, crossing;
  int map;
  vec3 ink, paper;
};

float hatching_strokes(float at, float change, float width_px, float spacing_px) {
  float wanted = 1.0 / (spacing_px * change);  // strokes per unit
  if (!(wanted > 1e-12 && wanted < 1e12)) return 0.0;
  float frequency = exp2(floor(log2(wanted)));
  float per_pixel = change * frequency, width = width_px * per_pixel, grown = wanted / frequency - 1.0;
  return min(stripes(at * frequency, per_pixel, width) + stripes(at * frequency + 0.5, per_pixel, width * grown), 1.0);
}

vec4 hatching(Hatching parameters, Surface surface, vec4 color) {
  Mapping mapping = uv_mapping(surface);
  if (parameters.map != 0 || footprint_of(mapping) == vec2(0.0)) mapping = world_mapping(surface);
  float angle = radians(parameters.angle_deg);
  mat2 turned = mat2(cos(angle), -sin(angle), sin(angle), cos(angle));  // along and across the strokes
  vec2 at = turned * mapping.at;
  vec2 change = footprint_of(Mapping(at, turned * mapping.dx, turned * mapping.dy));

  // Half as bright as white to the eye, half as dark as black.
  float luminance = dot(color.rgb, vec3(0.2126, 0.7152, 0.0722));
  float darkness = 1.0 - pow(clamp(luminance, 0.0, 1.0), 1.0 / 2.2);
  float first = min(darkness, parameters.crossing), second = darkness - first;
  float ink = hatching_strokes(at.y, change.y, parameters.width_px, parameters.spacing_px / first);
  float crossed = hatching_strokes(at.x, change.x, parameters.width_px, parameters.spacing_px / second);
  return vec4(mix(parameters.paper, parameters.ink, ink + crossed - ink * crossed), color.a);
}
