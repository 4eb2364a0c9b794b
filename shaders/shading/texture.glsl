// Texture filtering over a footprint given by derivatives, the same for every technique.

// A footprint beyond a whole texture, or one that is not a number, filters to the smallest level anyway; drivers take
// minutes over it.
vec2 bounded(vec2 derivative) {
  return clamp(derivative, vec2(-4.0), vec2(4.0));
}

#ifdef FILTER_TAPS
#include "shading/footprint.glsl"

vec4 sample_filtered(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
  Footprint footprint = footprint_of(bounded(dx), bounded(dy), vec2(textureSize(image, 0)));
  vec4 sum = vec4(0.0);
  for (float i = 0.5; i < footprint.taps; i += 1.0) {
    sum += textureLod(image, uv + footprint.axis * (i / footprint.taps - 0.5), footprint.lod);
  }
  return sum / footprint.taps;
}
#else
vec4 sample_filtered(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
  return textureGrad(image, uv, bounded(dx), bounded(dy));
}
#endif
