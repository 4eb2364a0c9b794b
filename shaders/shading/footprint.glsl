// A pixel's footprint in a texture as up to sixteen trilinear taps along its longer axis. On the software rasterizer they
// cost half as much again as one trilinear read, its own anisotropic filter three times as much.
#ifndef __cplusplus
#include "shading/language.glsl"
#endif

struct Footprint {
  vec2 axis;  // texture coordinates
  real taps;
  real lod;  // of each tap
};

SHADING Footprint footprint_of(vec2 dx, vec2 dy, vec2 texels) {
  real x_length = length(dx * texels), y_length = length(dy * texels);
  real longer = max(x_length, y_length), shorter = min(x_length, y_length);
  Footprint footprint;
  footprint.axis = choose(x_length > y_length, dx, dy);
  // Magnified, texels are larger than the pixel either way.
  footprint.taps = choose(longer <= 1.0, real(1.0), clamp(ceil(longer / max(shorter, 1e-6)), 1.0, 16.0));
  footprint.lod = log2(max(longer / footprint.taps, 1e-6));
  return footprint;
}

// A footprint beyond a whole texture, or one that is not a number, filters to the smallest level anyway; drivers take
// minutes over it.
SHADING vec2 bounded(vec2 derivative) {
  return clamp(derivative, vec2(-4.0), vec2(4.0));
}
