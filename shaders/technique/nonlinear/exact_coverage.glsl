// Whether a pixel's rays meet the triangle, and which of its samples do.
#include "common/camera.glsl"
#include "technique/nonlinear/exact_triangle.glsl"
#include "technique/nonlinear/forms.glsl"

in EXACT_TRIANGLE exact;

vec3 beside_planes(vec3 ray) {
  precise vec3 beside;
  for (int i = 0; i < 3; ++i) {
    vec3 plane = exact.plane[i];
    beside[i] = plane.x * ray.x + plane.y * ray.y + plane.z * ray.z;
  }
  return beside;
}

bool meets(vec3 ray, PixelRay change) {
  vec3 beside = beside_planes(ray);
  for (int i = 0; i < 3; ++i) {
#ifdef SOME_ARE_STRAIGHT
    if ((exact.number.z >> i & 8u) != 0u) {
      vec2 per_pixel = vec2(dot(exact.plane[i], change.dx), dot(exact.plane[i], change.dy));
      if (beside[i] < -EDGE_OVERLAP * length(per_pixel)) return false;
      continue;
    }
#endif
    if (!(beside[i] > 0.0 || (beside[i] == 0.0 && (exact.number.z >> i & 1u) != 0u))) return false;
  }
  return true;
}

#if SAMPLES > 1
uniform ivec2 sample_places[SAMPLES];  // within a pixel, in 1/256 px

// True when no edge comes near the pixel, so that all of it sees the triangle.
bool is_inside(PixelRay ray) {
  vec3 beside = beside_planes(ray.direction);
  for (int i = 0; i < 3; ++i) {
    if (beside[i] <= abs(dot(exact.plane[i], ray.dx)) + abs(dot(exact.plane[i], ray.dy))) return false;
  }
  return true;
}

vec2 sample_place(vec2 pixel, int s) { return pixel - 0.5 + vec2(sample_places[s]) / 256.0; }

// Where the centre is beyond the edge of what the camera sees, a sample's that is not.
PixelRay ray_of_pixel(vec2 pixel) {
  PixelRay ray = camera_ray(pixel);
  for (int s = ray.valid ? -1 : SAMPLES - 1; s >= 0; --s) {
    PixelRay other = camera_ray(sample_place(pixel, s));
    if (other.valid) ray = other;
  }
  return ray;
}

// The samples that see the triangle, as bits. Where not all do, the ray becomes the middle of those that do, which meets
// the triangle as they do: a surface extended beyond its edges may be anywhere.
int samples_that_meet(vec2 pixel, inout PixelRay ray) {
  int all = (1 << SAMPLES) - 1;
  bool inside = is_inside(ray);
  int samples = inside ? all : 0;
  vec3 sum = vec3(0.0);
  // A loop that is not entered is the one way to leave work out where a driver runs both sides of every branch.
  for (int s = inside ? -1 : SAMPLES - 1; s >= 0; --s) {
    vec3 direction;
    if (camera_unproject(sample_place(pixel, s), direction) && meets(direction, ray)) {
      samples |= 1 << s;
      sum += direction;
    }
  }
  if (samples != 0 && !inside) ray.direction = normalize(sum);
  return samples;
}
#else
PixelRay ray_of_pixel(vec2 pixel) { return camera_ray(pixel); }
int samples_that_meet(vec2 pixel, PixelRay ray) { return meets(ray.direction, ray) ? 1 : 0; }
#endif

// False when the pixel does not see the triangle. Else its samples are those that do, and the ray meets it.
bool find_coverage(out PixelRay ray) {
  vec2 pixel = gl_FragCoord.xy + pixel_offset;
  ray = ray_of_pixel(pixel);
  int samples = ray.valid ? samples_that_meet(pixel, ray) : 0;
#if SAMPLES > 1
  gl_SampleMask[0] = samples;
#endif
  return samples != 0;
}

// Along a ray that meets the triangle, as every technique has it: near over distance.
float depth_along(vec3 ray) {
  return clamp(NEAR * dot(exact.inverse_distance.xyz, ray) / exact.inverse_distance.w, 0.0, gl_FragCoord.z);
}
