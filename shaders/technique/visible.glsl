// Visible triangles by number: x is the triangle's id, y its instance. Whoever finds them fills such a texture.
#include "common/geometry.glsl"

layout(binding = 4) uniform usampler2D visible;
const uint NOTHING = 0xffffffffu;
