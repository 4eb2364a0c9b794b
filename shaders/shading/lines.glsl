// Lines and stripes without jagged edges: how much of a pixel they cover.

// A straight line of a width, at a distance from the pixel's centre, both in pixels.
float line_coverage(float distance_px, float width_px) {
  return clamp(min(distance_px + 0.5, 0.5 * width_px) - max(distance_px - 0.5, -0.5 * width_px), 0.0, 1.0);
}

float stripes_up_to(float x, float width) {
  float nearest = floor(x + 0.5);
  return nearest * width + clamp(x - nearest, -0.5 * width, 0.5 * width);
}

// Stripes of a width (0 to 1) around all whole numbers: their share of what the pixel's footprint around x holds.
float stripes(float x, float footprint, float width) {
  float extent = clamp(footprint, 1e-6, 1e3);
  float near_zero = x - floor(x), covered = clamp(width, 0.0, 1.0);
  float share = (stripes_up_to(near_zero + 0.5 * extent, covered) - stripes_up_to(near_zero - 0.5 * extent, covered)) / extent;
  return clamp(share, 0.0, 1.0);
}

vec4 lay_over(vec4 below, vec3 color, float coverage) {
  return mix(below, vec4(color, 1.0), coverage);
}
