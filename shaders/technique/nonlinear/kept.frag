// To count those fragments of bounding shapes that meet their triangles.
#include "technique/nonlinear/exact_coverage.glsl"

void main() {
  PixelRay ray;
  if (!find_coverage(ray)) discard;
}
