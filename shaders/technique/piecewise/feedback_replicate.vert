// Second pass: last frame's list, on its way to the geometry shader.
layout(location = 0) in uvec2 in_entry;  // slot, number

flat out uvec2 vertex_entry;

void main() {
  vertex_entry = in_entry;
}
