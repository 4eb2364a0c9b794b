// What a fragment of the resolve pass shades, where in the image, and which share of its pixel that is.
#include "technique/visible.glsl"
#include "common/camera.glsl"

#ifdef SAMPLES
layout(binding = 17) uniform usamplerBuffer coverage;  // x: how many samples see it; y: at which of them it is shaded
uniform vec2 sample_shifts[16];                        // pixels, from pixels' centres
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
#ifdef SAMPLES
  pixel += sample_shifts[texelFetch(coverage, sight_number()).y];
#endif
  return pixel;
}
