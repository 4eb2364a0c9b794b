// A fragment of a triangle's bounding shape: kept where its rays meet the triangle, with what they see there.
#define TRIANGLE_COLORS
#ifdef TANGENTS
#define TRIANGLE_TANGENTS
#endif
#include "shading/output.glsl"
#include "technique/nonlinear/exact_coverage.glsl"
#include "technique/triangle_surface.glsl"

// The rasterized depth is the nearest that the triangle has: where even that is hidden, no fragment needs to run.
layout(depth_less) out float gl_FragDepth;

void main() {
  PixelRay ray;
  if (!find_coverage(ray)) discard;
  Surface surface = surface_of(triangle_of(exact.number.x, instance_of(exact.number.y)), exact.number.x, ray);
  if (surface_is_hole(surface)) discard;
  gl_FragDepth = depth_along(ray.direction);
  write_outputs(surface);
}
