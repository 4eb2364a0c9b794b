// A square of pixels for each instance.
uniform vec2 target_size;  // pixels
uniform float side;        // of a square, pixels
layout(location = 0) in uvec2 in_tile;  // in squares from the target's corner

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 pixel = min((vec2(in_tile) + corner) * side, target_size);
  gl_Position = vec4(pixel / target_size * 2.0 - 1.0, 0.0, 1.0);
}
