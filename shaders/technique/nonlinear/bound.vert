// A corner of the polygon around a triangle, or of a square of the image in which it may be seen.
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

const float OUTLINE_MARGIN = 0.0625;  // px; far more than single precision moves a corner

vec2 corner_of_square(uint node, int number) {
  ivec3 square = square_of(texelFetch(node_texels, 2 * int(node) + 1).w);
  number = min(number, 3);
  return vec2(square.xy + square.z * ivec2(number == 1 || number == 2, number >= 2));
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

  vec2 place;
#ifdef PROJECTS
  if (replica.y == OUTLINE) {
    Pyramid pyramid;
    Outline outline;
    pyramid_of(a, b, c, 0.0, pyramid);
    outline_of(a, b, c, pyramid.axis, pyramid.sine, pyramid.cosine, outline);
    place = hexagon_corner(outline, outline.bulge + OUTLINE_MARGIN, number) - pixel_offset;
  } else {
    place = corner_of_square(replica.y, number);
  }
#else
  place = corner_of_square(replica.y, number);
#endif
  gl_Position = vec4(place / tile_size * 2.0 - 1.0, nearest_depth(a, b, c), 1.0);
}
