// What rays that meet nothing bring.
#include "technique/sight.glsl"
#include "common/frame.glsl"

layout(location = 0) out vec4 color;

void main() {
  if (visible_at(ivec2(gl_FragCoord.xy)) != NOTHING) discard;
  vec3 direction;
  bool valid = camera_unproject(sight_pixel(), direction);
  color = vec4(valid ? background(direction) : vec3(0.0), 1.0) * sight_share();
}
