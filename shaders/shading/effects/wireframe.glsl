// The triangle's edges, by their distance in pixels: a barycentric coordinate is zero at an edge, and its change per
// pixel says how far that is (Baerentzen et al. 2006, with derivatives instead of distances between vertices).
#include "shading/lines.glsl"

struct Wireframe {
  float width_px;
  vec3 color;
};

vec4 wireframe(Wireframe parameters, Surface surface, vec4 color) {
  float covered = 0.0;
  for (int i = 0; i < 3; ++i) {
    float change = length(vec2(surface.barycentric_dx[i], surface.barycentric_dy[i]));
    // A surface that does not change from pixel to pixel has no edge near.
    if (change > 0.0) covered = max(covered, line_coverage(abs(surface.barycentric[i]) / change, parameters.width_px));
  }
  return lay_over(color, parameters.color, covered);
}
