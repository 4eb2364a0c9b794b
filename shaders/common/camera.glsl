// The camera as the GPU sees it: a lens's formulae or a map of measured rays. Camera frame: +X right, +Y up, -Z ahead.
// Pixels are those of the whole image, y down; a target's row 0 is the top row of its tile, so that
// gl_FragCoord.xy + pixel_offset is a pixel without any flip.

#include "models/language.h"

uniform vec2 pixel_offset;  // the tile's corner and the sub-pixel shift of this pass

#ifdef PIECE_CAMERA

#include "common/piece_camera.glsl"

#elif defined(RAY_MAP)

layout(binding = 8) uniform sampler2D ray_map;  // xyz; zero where there is no ray

bool camera_unproject(vec2 pixel, out vec3 direction) {
  // Bilinear by hand: a neighbour without a ray must not pull the others towards zero. The outer half pixel goes on as
  // the last two pixels began, so that derivatives hold up to the border.
  ivec2 last = textureSize(ray_map, 0) - 1;
  vec2 corner = pixel - 0.5;
  ivec2 at = clamp(ivec2(floor(corner)), ivec2(0), max(last - 1, 0));
  vec2 part = vec2(last.x > 0 ? corner.x - float(at.x) : 0.0, last.y > 0 ? corner.y - float(at.y) : 0.0);
  ivec2 next = min(at + 1, last);
  vec3 r00 = texelFetch(ray_map, at, 0).xyz;
  vec3 r10 = texelFetch(ray_map, ivec2(next.x, at.y), 0).xyz;
  vec3 r01 = texelFetch(ray_map, ivec2(at.x, next.y), 0).xyz;
  vec3 r11 = texelFetch(ray_map, next, 0).xyz;
  vec4 weight = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
  direction = weight.x * r00 + weight.y * r10 + weight.z * r01 + weight.w * r11;
  bool valid = (weight.x == 0.0 || r00 != vec3(0.0)) && (weight.y == 0.0 || r10 != vec3(0.0)) &&
               (weight.z == 0.0 || r01 != vec3(0.0)) && (weight.w == 0.0 || r11 != vec3(0.0));
  direction = valid ? normalize(direction) : vec3(0.0, 0.0, -1.0);
  return valid;
}

#else

#include "models/radial.h"
#include "models/${LENS}.h"

uniform float lens_k[16];
uniform float lens_max_angle;
uniform vec2 lens_focal;
uniform vec2 lens_centre;
uniform mat3 cameraFromLens;

Params lens_params() {
  return Params(lens_k, lens_max_angle);
}

bool camera_unproject(vec2 pixel, out vec3 direction) {
  vec3 optical;
  bool valid = LENS_UNPROJECT(lens_params(), (pixel - lens_centre) / lens_focal, optical);
  direction = cameraFromLens * vec3(optical.x, -optical.y, -optical.z);
  return valid;
}

bool camera_project_within(float max_angle, vec3 direction, out vec2 pixel) {
  vec2 plane;
  vec3 in_lens = direction * cameraFromLens;
  bool valid = LENS_PROJECT(Params(lens_k, max_angle), vec3(in_lens.x, -in_lens.y, -in_lens.z), plane);
  pixel = lens_centre + lens_focal * plane;
  return valid;
}

bool camera_project(vec3 direction, out vec2 pixel) { return camera_project_within(lens_max_angle, direction, pixel); }

#endif

// A pixel's ray and how it changes from pixel to pixel.
struct PixelRay {
  bool valid;
  vec3 direction;  // unit length
  vec3 dx, dy;     // per pixel to the right and down
};

// A change per pixel from those over the half pixels before and after: where one side has no ray, or jumps to another
// part of the world as cube layouts do, the other side alone.
vec3 per_pixel(bool has_before, vec3 before, bool has_after, vec3 after) {
  if (has_before && has_after) {
    float before2 = dot(before, before), after2 = dot(after, after);
    has_before = before2 < 16.0 * after2;
    has_after = after2 < 16.0 * before2;
    if (has_before == has_after) return before + after;
  }
  return has_before ? 2.0 * before : has_after ? 2.0 * after : vec3(0.0);
}

#ifdef PIECE_CAMERA
// Analytic: a piece's rays are linear in the pixel, and its neighbours' need not continue them.
PixelRay camera_ray(vec2 pixel) {
  PixelRay ray;
  int piece = camera_piece(pixel);
  ray.valid = piece >= 0;
  mat3 rayFromImage = camera_rayFromImage(max(piece, 0));
  vec3 along = rayFromImage * vec3(pixel, 1.0);
  float scale = 1.0 / length(along);
  ray.direction = along * scale;
  ray.dx = (rayFromImage[0] - ray.direction * dot(ray.direction, rayFromImage[0])) * scale;
  ray.dy = (rayFromImage[1] - ray.direction * dot(ray.direction, rayFromImage[1])) * scale;
  return ray;
}
#else
// Central differences over one pixel.
PixelRay camera_ray(vec2 pixel) {
  PixelRay ray;
  ray.valid = camera_unproject(pixel, ray.direction);
  vec3 left, right, up, down;
  bool has_left = camera_unproject(pixel - vec2(0.5, 0.0), left);
  bool has_right = camera_unproject(pixel + vec2(0.5, 0.0), right);
  bool has_up = camera_unproject(pixel - vec2(0.0, 0.5), up);
  bool has_down = camera_unproject(pixel + vec2(0.0, 0.5), down);
  ray.dx = per_pixel(has_left, ray.direction - left, has_right, right - ray.direction);
  ray.dy = per_pixel(has_up, ray.direction - up, has_down, down - ray.direction);
  return ray;
}
#endif
