// What a camera sees where the scene is not. What has no ray becomes black and, with reversed depth, nearest: no triangle
// that strays beyond the image circle can be drawn over it. Of several samples those without a ray are left as the target
// was cleared.
#include "common/frame.glsl"
#include "common/camera.glsl"

#ifdef OUTPUT_COLOR
layout(location = 0) out vec4 color;
#endif

#ifdef SAMPLES
uniform ivec2 sample_places[SAMPLES];  // within a pixel, in 1/256 px

// The middle of the rays of those samples that have one.
bool background_ray(out vec3 direction) {
  vec2 corner = gl_FragCoord.xy + pixel_offset - 0.5;
  vec3 sum = vec3(0.0);
  int samples = 0;
  for (int s = 0; s < SAMPLES; ++s) {
    vec3 ray;
    if (camera_unproject(corner + vec2(sample_places[s]) / 256.0, ray)) {
      samples |= 1 << s;
      sum += ray;
    }
  }
  gl_SampleMask[0] = samples;
  direction = samples != 0 ? normalize(sum) : vec3(0.0);
  return samples != 0;
}
#else
bool background_ray(out vec3 direction) { return camera_unproject(gl_FragCoord.xy + pixel_offset, direction); }
#endif

void main() {
  vec3 direction;
  bool valid = background_ray(direction);
#ifdef OUTPUT_COLOR
  color = vec4(valid ? background(direction) : vec3(0.0), 1.0);
#endif
  gl_FragDepth = valid ? 0.0 : 1.0;
}
