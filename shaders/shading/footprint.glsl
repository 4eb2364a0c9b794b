// A pixel's footprint in a texture as up to sixteen trilinear taps along its longer axis. On the software rasterizer they
// cost half as much again as one trilinear read, its own anisotropic filter three times as much.
struct Footprint {
  vec2 axis;  // texture coordinates
  float taps;
  float lod;  // of each tap
};

Footprint footprint_of(vec2 dx, vec2 dy, vec2 texels) {
  float x_length = length(dx * texels), y_length = length(dy * texels);
  float longer = max(x_length, y_length), shorter = min(x_length, y_length);
  // Magnified, texels are larger than the pixel either way.
  float taps = longer <= 1.0 ? 1.0 : clamp(ceil(longer / max(shorter, 1e-6)), 1.0, 16.0);
  return Footprint(x_length > y_length ? dx : dy, taps, log2(max(longer / taps, 1e-6)));
}
