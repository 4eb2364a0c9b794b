// As overdraw.frag, of a triangle that is its own bounding shape.
in vec2 corner_weight;

layout(location = 0) out vec4 color;

void main() { color = vec4(corner_weight, 0.0, 1.0); }
