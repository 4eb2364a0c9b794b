// What rays that meet nothing bring.
#include "technique/visible.glsl"
#include "common/frame.glsl"
#include "common/camera.glsl"

layout(location = 0) out vec4 color;

void main() {
  if (visible_at(ivec2(gl_FragCoord.xy)) != NOTHING) discard;
  vec3 direction;
  bool valid = camera_unproject(gl_FragCoord.xy + pixel_offset, direction);
  color = vec4(valid ? background(direction) : vec3(0.0), 1.0);
}
