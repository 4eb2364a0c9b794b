// Texture filtering over a footprint given by derivatives, the same for every technique.
#include "shading/footprint.glsl"

vec4 sample_filtered(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
#ifdef FILTER_TAPS
  Footprint footprint = footprint_of(bounded(dx), bounded(dy), vec2(textureSize(image, 0)));
  vec4 sum = vec4(0.0);
  for (float i = 0.5; i < footprint.taps; i += 1.0) {
    sum += textureLod(image, uv + footprint.axis * (i / footprint.taps - 0.5), footprint.lod);
  }
  return sum / footprint.taps;
#else
  return textureGrad(image, uv, bounded(dx), bounded(dy));
#endif
}
