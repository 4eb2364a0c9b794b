// Passes on the triangles that straight edges can stand for at all: those whose vertices the lens sees and whose edges
// do not jump across a seam of the image.
#include "technique/mesh_vertex.glsl"
#include "common/camera.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

uniform vec2 tile_size;  // pixels
uniform vec2 image_size;

in MESH_VERTEX vertex_in[];
flat in int vertex_visible[];
out MESH_VERTEX vertex;

// An edge that runs to the other side of a seam has its middle far from where its ends say.
bool jumps(int a, int b) {
  vec2 middle;
  vec3 between = normalize(vertex_in[a].position) + normalize(vertex_in[b].position);
  if (!camera_project(between, middle)) return true;
  vec2 straight = 0.5 * (gl_in[a].gl_Position.xy / gl_in[a].gl_Position.w + gl_in[b].gl_Position.xy / gl_in[b].gl_Position.w);
  vec2 straight_pixel = (straight * 0.5 + 0.5) * tile_size + pixel_offset;
  return distance(middle, straight_pixel) > 0.25 * max(image_size.x, image_size.y);
}

void main() {
  if (vertex_visible[0] + vertex_visible[1] + vertex_visible[2] < 3) return;
  if (jumps(0, 1) || jumps(1, 2) || jumps(2, 0)) return;
  for (int i = 0; i < 3; ++i) {
    vertex.position = vertex_in[i].position;
    vertex.normal = vertex_in[i].normal;
    vertex.tangent = vertex_in[i].tangent;
    vertex.uv = vertex_in[i].uv;
    vertex.color = vertex_in[i].color;
    vertex.part = vertex_in[i].part;
    gl_PrimitiveID = gl_PrimitiveIDIn;
    gl_Position = gl_in[i].gl_Position;
    EmitVertex();
  }
  EndPrimitive();
}
