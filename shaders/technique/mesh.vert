// Vertices for a flat image: one matrix.
#include "technique/mesh_input.glsl"

uniform mat4 clipFromCamera;

void main() {
  read_vertex();
  gl_Position = clipFromCamera * vec4(vertex.position, 1.0);
}
