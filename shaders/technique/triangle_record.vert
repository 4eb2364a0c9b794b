// What is constant over a visible triangle, once for all its pixels, written by transform feedback.
#include "technique/visible.glsl"
#include "technique/triangle_record.glsl"

layout(xfb_buffer = 0, xfb_offset = 0) out vec4 record[TRIANGLE_TEXELS];

void main() {
  uvec2 hit = texelFetch(visible_triangles, gl_VertexID).xy;
  pack_triangle(triangle_of(hit.x, instance_of(hit.y)), record);
}
