// What becomes of bounding shapes (Gascuel et al., figure 9): where in its triangle a fragment lies, in red and green;
// blue, behind everything else, where it meets nothing.
#include "technique/nonlinear/exact_coverage.glsl"

layout(location = 0) out vec4 color;
layout(depth_less) out float gl_FragDepth;

void main() {
  PixelRay ray;
  if (find_coverage(ray)) {
    vec3 beside = beside_planes(ray.direction);
    color = vec4(beside.xy / (beside.x + beside.y + beside.z), 0.0, 1.0);
    gl_FragDepth = depth_along(ray.direction);
  } else {
#if SAMPLES > 1
    gl_SampleMask[0] = ~0;
#endif
    color = vec4(0.0, 0.0, 1.0, 1.0);
    gl_FragDepth = min(1e-30, gl_FragCoord.z);
  }
}
