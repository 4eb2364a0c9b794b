// A small triangle across a seam, a fold or the border of what the lens sees: drawn once on each side, as far as it
// would reach if the lens went on there. Corners that are joined by sound edges are on one side.
#include "technique/mesh_vertex.glsl"
#include "technique/subdivision/edge.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 12) out;

in MESH_VERTEX vertex_in[];
flat in vec2 vertex_pixel[];
flat in uint vertex_broken[];
out MESH_VERTEX vertex;

bool is_joined(int i, int j) {
  int edge = (i + 1) % 3 == j ? i : j;
  return (vertex_broken[0] >> edge & 1u) == 0u;
}

void emit_corner(int i, vec2 pixel) {
  vertex.position = vertex_in[i].position;
  vertex.normal = vertex_in[i].normal;
  vertex.tangent = vertex_in[i].tangent;
  vertex.uv = vertex_in[i].uv;
  vertex.color = vertex_in[i].color;
  vertex.part = vertex_in[i].part;
  gl_Position = clip_position(pixel, vertex_in[i].position);
  EmitVertex();
}

void emit_onward(int from, int to) {
  emit_corner(to, onward(vertex_in[from].position, vertex_in[to].position, vertex_pixel[from]));
}

void main() {
  uint broken = vertex_broken[0];
  int count = bitCount(broken);
  if (count < 2 && is_seen(vertex_pixel[0]) && is_seen(vertex_pixel[1]) && is_seen(vertex_pixel[2])) {
    for (int i = 0; i < 3; ++i) emit_corner(i, vertex_pixel[i]);
    EndPrimitive();
    // What the neighbour draws beyond the broken edge begins there.
    for (int i = 0; i < 3; ++i) {
      int j = (i + 1) % 3;
      if (is_joined(i, j)) continue;
      emit_corner(i, vertex_pixel[i]);
      emit_onward(i, j);
      emit_corner(j, vertex_pixel[j]);
      EndPrimitive();
      emit_corner(i, vertex_pixel[i]);
      emit_onward(j, i);
      emit_corner(j, vertex_pixel[j]);
      EndPrimitive();
    }
    return;
  }
  for (int i = 0; i < 3; ++i) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    if (!is_seen(vertex_pixel[i])) continue;
    if (is_joined(i, j) && is_seen(vertex_pixel[j])) {
      emit_corner(i, vertex_pixel[i]);
      emit_corner(j, vertex_pixel[j]);
      emit_onward(i, k);
      emit_onward(j, k);
      EndPrimitive();
    } else if (!is_joined(i, k) || !is_seen(vertex_pixel[k])) {
      emit_corner(i, vertex_pixel[i]);
      emit_onward(i, j);
      emit_onward(i, k);
      EndPrimitive();
    }
  }
}
