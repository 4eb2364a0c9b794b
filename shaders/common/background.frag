// What a camera sees where the scene is not. Pixels without a ray become black and, with reversed depth, nearest: no
// triangle that strays beyond the image circle can be drawn over them.
#include "common/frame.glsl"
#include "common/camera.glsl"

#ifdef OUTPUT_COLOR
layout(location = 0) out vec4 color;
#endif

void main() {
  vec3 direction;
  bool valid = camera_unproject(gl_FragCoord.xy + pixel_offset, direction);
#ifdef OUTPUT_COLOR
  color = vec4(valid ? background(direction) : vec3(0.0), 1.0);
#endif
  gl_FragDepth = valid ? 0.0 : 1.0;
}
