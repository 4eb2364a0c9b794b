// Adds one pass of sample positions to the picture.
layout(binding = 0) uniform sampler2D picture;
uniform float weight;
layout(location = 0) out vec4 color;

void main() {
  color = weight * texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
}
