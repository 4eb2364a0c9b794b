// Vertices projected by the lens; what lies between them is left to the rasterizer.
#include "technique/mesh_input.glsl"
#include "common/camera.glsl"

uniform vec2 tile_size;  // pixels
flat out int vertex_visible;

void main() {
  read_vertex();
  vec2 pixel;
  vertex_visible = int(camera_project(vertex.position, pixel));
  // w is the distance: attributes are then interpolated as nearly right as straight edges allow, and depth is its
  // inverse as in every other technique.
  float w = length(vertex.position);
  gl_Position = vec4(((pixel - pixel_offset) / tile_size * 2.0 - 1.0) * w, NEAR, w);
}
