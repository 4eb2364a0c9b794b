// A corner of the polygon around a triangle, or of a square of the image in which it may be seen. Clip distances cut off
// of the square what lies beyond the triangle's edges.
#include "technique/replication/cone_tree.glsl"
#include "technique/nonlinear/exact_output.glsl"
#include "technique/nonlinear/image_tile.glsl"
#include "technique/nonlinear/forms.glsl"
#ifdef PROJECTS
#include "common/camera.glsl"
#include "technique/nonlinear/outline.glsl"
#endif

layout(binding = 21) uniform usamplerBuffer replica_texels;  // item, node or OUTLINE

uniform vec2 tile_size;  // pixels

out float gl_ClipDistance[3];

vec2 corner_of_square(int node, int number, Pyramid pyramid) {
  ivec3 square = square_of(node_of(node).data);
  number = min(number, 3);
  vec2 at = vec2(number == 1 || number == 2, number >= 2);
  LinearRays rays = linear_rays(node);
  if (rays.off >= 0.0) {
    float side = float(square.z);
    vec2 uv = 2.0 * (at + square_shift / side) - 1.0;
    vec3 ray = rays.middle + uv.x * rays.across + uv.y * rays.down;
    for (int i = 0; i < 3; ++i) {
      gl_ClipDistance[i] = dot(pyramid.side[i], ray) + side_leeway(rays, pyramid.side[i], side, SQUARE_MARGIN);
    }
  }
  return vec2(square.xy) + float(square.z) * at;
}

void main() {
  uvec2 replica = texelFetch(replica_texels, gl_VertexID / 6).xy;
  int number = gl_VertexID % 6;
  PartRecord part = part_of(item_part(replica.x));
  InstanceRecord instance = instance_of(part.instance);
  uvec3 corner = item_corners(replica.x, part, instance);
  vec3 a = corner_position(instance, corner.x);
  vec3 b = corner_position(instance, corner.y);
  vec3 c = corner_position(instance, corner.z);
  write_exact(uvec2(part.first_triangle + item_triangle(replica.x), part.instance), a, b, c);

  Pyramid pyramid;
  pyramid_of(a, b, c, 0.0, pyramid);
  for (int i = 0; i < 3; ++i) gl_ClipDistance[i] = 1.0;
  vec2 place;
#ifdef PROJECTS
  if (replica.y == OUTLINE) {
    Outline outline;
    outline_of(a, b, c, pyramid.axis, pyramid.sine, pyramid.cosine, outline);
    place = hexagon_corner(outline, outline.bulge + SQUARE_MARGIN, number) - pixel_offset;
  } else
#endif
  {
    place = corner_of_square(int(replica.y), number, pyramid);
  }
  gl_Position = vec4(place / tile_size * 2.0 - 1.0, nearest_depth(a, b, c), 1.0);
}
