// Lines and stripes without jagged edges: how much of a pixel they cover.

// A straight line of a width, at a distance from the pixel's centre, both in pixels.
SHADING real line_coverage(real distance_px, real width_px) {
  return clamp(min(distance_px + 0.5, 0.5 * width_px) - max(distance_px - 0.5, -0.5 * width_px), 0.0, 1.0);
}

SHADING real stripes_up_to(real x, real width) {
  real nearest = floor(x + 0.5);
  return nearest * width + clamp(x - nearest, -0.5 * width, 0.5 * width);
}

// Stripes of a width (0 to 1) around all whole numbers: their share of what the pixel's footprint around x holds.
SHADING real stripes(real x, real footprint, real width) {
  real extent = clamp(footprint, 1e-6, 1e3);
  real near_zero = x - floor(x), covered = clamp(width, 0.0, 1.0);
  real share = (stripes_up_to(near_zero + 0.5 * extent, covered) - stripes_up_to(near_zero - 0.5 * extent, covered)) / extent;
  return clamp(share, 0.0, 1.0);
}

SHADING vec4 lay_over(vec4 below, vec3 color, real coverage) {
  return mix(below, vec4(color, 1.0), coverage);
}
