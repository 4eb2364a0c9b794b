// Texture filtering over a footprint given by derivatives, the same for every technique.

// A footprint beyond a whole texture, or one that is not a number, filters to the smallest level anyway; drivers take
// minutes over it.
vec2 bounded(vec2 derivative) {
  return clamp(derivative, vec2(-4.0), vec2(4.0));
}

#ifdef FILTER_TAPS
// Up to sixteen trilinear taps along the footprint's longer axis. On a software rasterizer this is five times faster
// than its own anisotropic filter.
vec4 sample_filtered(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
  dx = bounded(dx);
  dy = bounded(dy);
  vec2 size = vec2(textureSize(image, 0));
  float x_length = length(dx * size), y_length = length(dy * size);
  vec2 axis = x_length > y_length ? dx : dy;
  float longer = max(x_length, y_length), shorter = min(x_length, y_length);
  float taps = clamp(ceil(longer / max(shorter, 1e-6)), 1.0, 16.0);
  if (longer <= 1.0) taps = 1.0;  // magnified: the texels are larger than the pixel either way
  float lod = log2(max(longer / taps, 1e-6));
  vec4 sum = vec4(0.0);
  for (float i = 0.5; i < taps; i += 1.0) sum += textureLod(image, uv + axis * (i / taps - 0.5), lod);
  return sum / taps;
}
#else
vec4 sample_filtered(sampler2D image, vec2 uv, vec2 dx, vec2 dy) {
  return textureGrad(image, uv, bounded(dx), bounded(dy));
}
#endif
