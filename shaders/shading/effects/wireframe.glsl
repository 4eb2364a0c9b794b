// The triangle's edges, by their distance in pixels: a barycentric coordinate is zero at an edge, and its change per
// pixel says how far that is (Baerentzen et al. 2006, with derivatives instead of distances between vertices).
#ifndef __cplusplus
#include "shading/lines.glsl"
#endif

struct Wireframe {
  float width_px;
  vec3 color;
};

SHADING real wireframe_edge(real coordinate, real dx, real dy, real width_px) {
  real change = length(vec2(dx, dy));
  // A surface that does not change from pixel to pixel has no edge near.
  return choose(change > 0.0, line_coverage(abs(coordinate) / change, width_px), real(0.0));
}

SHADING vec4 wireframe(Wireframe parameters, Surface surface, vec4 color) {
  vec3 at = surface.barycentric, dx = surface.barycentric_dx, dy = surface.barycentric_dy;
  real covered = max(wireframe_edge(at.x, dx.x, dy.x, parameters.width_px),
                     max(wireframe_edge(at.y, dx.y, dy.y, parameters.width_px),
                         wireframe_edge(at.z, dx.z, dy.z, parameters.width_px)));
  return lay_over(color, parameters.color, covered);
}
