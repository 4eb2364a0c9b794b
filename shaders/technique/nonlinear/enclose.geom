// A triangle's bounding shape (Gascuel et al. 2008, section 3.6): SHAPE_QUAD one quad, else up to four triangles.
#include "technique/nonlinear/exact_output.glsl"
#include "common/camera.glsl"
#include "bounds/bounding_shape.h"

layout(triangles) in;
#ifdef SHAPE_QUAD
layout(triangle_strip, max_vertices = 4) out;
#else
layout(triangle_strip, max_vertices = 12) out;
#endif

in vec3 corner[];
flat in uvec2 part[];

uniform LensBound lens_bound;
uniform vec2 tile_size;   // pixels
uniform float cull_sign;  // 1: faces that turn away are left out; -1: in a mirrored instance; 0: none is

#ifdef SORTED
layout(binding = 24) uniform usamplerBuffer sorted_triangles;  // ids in the order in which they are drawn
uniform int first_sorted;
#endif

uint triangle_number() {
#ifdef SORTED
  return texelFetch(sorted_triangles, first_sorted + gl_PrimitiveIDIn).x;
#else
  return part[0].y + uint(gl_PrimitiveIDIn);
#endif
}

vec3 optical(vec3 position) {
  vec3 in_lens = position * cameraFromLens;
  return vec3(in_lens.x, -in_lens.y, -in_lens.z);
}

void emit(BoundPart shape, vec3 a, vec3 b, vec3 c) {
  vec2 place[4];
  vec2 low = vec2(1e30), high = vec2(-1e30);
  for (int i = 0; i < shape.corners; ++i) {
    place[i] = (lens_centre + lens_focal * shape.corner[i] - pixel_offset) / tile_size * 2.0 - 1.0;
    low = min(low, place[i]);
    high = max(high, place[i]);
  }
  if (any(greaterThan(low, vec2(1.0))) || any(lessThan(high, vec2(-1.0)))) return;
  float depth = nearest_depth(a, b, c);
  for (int i = 0; i < shape.corners; ++i) {
    // A strip's order: the quad's last corner comes before the third.
    int k = shape.corners == 4 && i >= 2 ? 5 - i : i;
    write_exact(uvec2(triangle_number(), part[0].x), a, b, c);
    gl_Position = vec4(place[k], depth, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}

void main() {
  vec3 a = corner[0], b = corner[1], c = corner[2];
  if (cull_sign * dot(a, cross(b - a, c - a)) > 0.0) return;
  vec3 p = optical(a), q = optical(b), r = optical(c);
#ifdef SHAPE_QUAD
  emit(bounding_quad(lens_params(), lens_bound, p, q, r), a, b, c);
#else
  BoundParts shapes = bounding_triangles(lens_params(), lens_bound, p, q, r);
  for (int i = 0; i < shapes.count; ++i) emit(shapes.part[i], a, b, c);
#endif
}
