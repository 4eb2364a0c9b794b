// A corner of a square of the image in which a triangle may be seen.
#include "technique/replication/scene_triangle.glsl"
#include "technique/nonlinear/exact_output.glsl"
#include "technique/nonlinear/image_tile.glsl"

layout(binding = 18) uniform usamplerBuffer node_texels;
layout(binding = 21) uniform usamplerBuffer replica_texels;  // item, node

uniform vec2 tile_size;  // pixels

void main() {
  uvec2 replica = texelFetch(replica_texels, gl_VertexID / 6).xy;
  PartRecord part = part_of(item_part(replica.x));
  InstanceRecord instance = instance_of(part.instance);
  uvec3 corner = item_corners(replica.x, part, instance);
  vec3 a = corner_position(instance, corner.x);
  vec3 b = corner_position(instance, corner.y);
  vec3 c = corner_position(instance, corner.z);
  write_exact(uvec2(part.first_triangle + item_triangle(replica.x), part.instance), a, b, c);

  ivec3 square = square_of(texelFetch(node_texels, 2 * int(replica.y) + 1).w);
  int number = min(gl_VertexID % 6, 3);
  vec2 place = vec2(square.xy + square.z * ivec2(number == 1 || number == 2, number >= 2));
  gl_Position = vec4(place / tile_size * 2.0 - 1.0, nearest_depth(a, b, c), 1.0);
}
