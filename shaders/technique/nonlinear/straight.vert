// A vertex of a triangle that the lens leaves straight, fetched by number.
#include "technique/replication/scene_triangle.glsl"
#include "technique/vertex_output.glsl"
#include "common/camera.glsl"
#include "technique/nonlinear/outline.glsl"

layout(binding = 21) uniform usamplerBuffer replica_texels;  // item

uniform vec2 tile_size;  // pixels

out vec2 corner_weight;  // of the first two

void main() {
  uint item = texelFetch(replica_texels, gl_VertexID / 3).x;
  PartRecord part = part_of(item_part(item));
  InstanceRecord instance = instance_of(part.instance);
  uint corner = item_corners(item, part, instance)[gl_VertexID % 3];
  vec3 position = corner_position(instance, corner);
  write_vertex(instance, position, texelFetch(attributes, int(corner)), texelFetch(colors, int(corner)),
               uvec2(part.instance, part.first_triangle + item_triangle(item)));
  corner_weight = vec2(gl_VertexID % 3 == 0, gl_VertexID % 3 == 1);
  vec2 pixel;
  formula_project(position, pixel);
  float w = length(position);
  gl_Position = vec4(((pixel - pixel_offset) / tile_size * 2.0 - 1.0) * w, NEAR, w);
}
