// The effects of a picture one after another. Which files, the declarations of their parameters and the calls come
// from shading/effects.cpp.
#include "shading/effects/${EFFECT_0}.glsl"
#include "shading/effects/${EFFECT_1}.glsl"
#include "shading/effects/${EFFECT_2}.glsl"
#include "shading/effects/${EFFECT_3}.glsl"

EFFECT_UNIFORMS

// The colour of a surface before light falls on it.
vec4 paint(Surface surface, vec4 color) {
  PAINT_EFFECTS
  return color;
}

// What is drawn over its lit colour.
vec4 draw_over(Surface surface, vec4 color) {
  DRAW_EFFECTS
  return color;
}
