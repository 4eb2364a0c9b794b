// Adds to each pixel what was shaded for it elsewhere. Matches technique/fragment_sheet.cpp.
layout(binding = 0) uniform sampler2D sheet;
layout(binding = 17) uniform usamplerBuffer positions;  // on the sheet, pixel by pixel
layout(binding = 18) uniform usamplerBuffer runs;       // by pixel: the first of its positions, and in four bits how many
uniform int visible_width;
layout(location = 0) out vec4 color;

void main() {
  uint run = texelFetch(runs, int(gl_FragCoord.y) * visible_width + int(gl_FragCoord.x)).x;
  if (run == 0u) discard;
  color = vec4(0.0);
  for (uint i = run >> 4; i < (run >> 4) + (run & 15u); ++i) {
    color += texelFetch(sheet, ivec2(texelFetch(positions, int(i)).xy), 0);
  }
}
