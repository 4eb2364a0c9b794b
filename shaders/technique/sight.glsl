// What a fragment of the resolve pass shades, where in the image, and which share of its pixel that is.
#include "technique/visible.glsl"
#include "common/camera.glsl"

#ifdef SAMPLES
layout(binding = 17) uniform isamplerBuffer coverage;  // x: how many samples see it; yz: where it is shaded, 1/256 px
uniform float sample_share;                            // of a pixel
#endif
#ifdef ON_SHEET
layout(binding = 18) uniform usamplerBuffer sheet_pixels;  // in the tile, by position on the sheet
#endif

int sight_number() { return int(gl_FragCoord.y) * visible_width + int(gl_FragCoord.x); }

float sight_share() {
#ifdef SAMPLES
  return float(texelFetch(coverage, sight_number()).x) * sample_share;
#else
  return 1.0;
#endif
}

vec2 sight_pixel() {
#ifdef ON_SHEET
  vec2 pixel = vec2(texelFetch(sheet_pixels, sight_number()).xy) + 0.5 + pixel_offset;
#else
  vec2 pixel = gl_FragCoord.xy + pixel_offset;
#endif
#if defined SAMPLES && !defined EFFECTS
  // Effects measure a pixel from its middle: a line of a pixel's width would come out thinner beside it.
  pixel += vec2(texelFetch(coverage, sight_number()).yz) / 256.0;
#endif
  return pixel;
}
