// A slot to a patch.
flat out uint vertex_slot;

void main() {
  vertex_slot = uint(gl_VertexID);
}
