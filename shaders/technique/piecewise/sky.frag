// What a piece's ray sees where it meets nothing.
#include "common/frame.glsl"

noperspective in vec3 ray;
layout(location = 0) out vec4 color;

void main() {
  color = vec4(background(normalize(ray)), 1.0);
}
