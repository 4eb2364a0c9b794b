// One of an item's three vertices, fetched by number, into a piece.
#include "technique/replication/scene_triangle.glsl"
#include "technique/piecewise/piece_vertex.glsl"

void pull_vertex(uint item, uint piece, int corner_number) {
  PartRecord part = part_of(item_part(item));
  InstanceRecord instance = instance_of(part.instance);
  uint corner = item_corners(item, part, instance)[corner_number];
  vec3 position = corner_position(instance, corner);
  write_vertex(instance, position, texelFetch(attributes, int(corner)), texelFetch(colors, int(corner)),
               uvec2(part.instance, part.first_triangle + item_triangle(item)));
  place_vertex(piece, position);
}
