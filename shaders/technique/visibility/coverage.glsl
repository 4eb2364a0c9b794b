// How much of a surface is there, as coverage() of src/omma/scene/coverage.h says it.
layout(binding = 6) uniform usamplerBuffer attributes;
layout(binding = 7) uniform samplerBuffer colors;
layout(binding = 26) uniform samplerBuffer alpha_texels;  // the textures' finest levels

const uint WRAP_REPEAT = 0u, WRAP_CLAMP = 1u, WRAP_MIRROR = 2u;

// `i` is -1 or more: what % makes of less is undefined.
int wrapped(int i, int size, uint wrap) {
  if (wrap == WRAP_CLAMP) return clamp(i, 0, size - 1);
  int period = wrap == WRAP_MIRROR ? 2 * size : size;
  int inside = (i + period) % period;
  return inside < size ? inside : period - 1 - inside;
}

// Bilinear.
float alpha_at(vec2 uv, int first, ivec2 size, uint wraps) {
  // Two periods: mirroring has two.
  precise vec2 texel = fract(clamp(uv, vec2(-1e6), vec2(1e6)) * 0.5) * 2.0 * vec2(size) - 0.5;
  vec2 corner = floor(texel), part = texel - corner;
  float alpha = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1);
    int x = wrapped(int(corner.x) + step.x, size.x, wraps & 3u);
    int y = wrapped(int(corner.y) + step.y, size.y, wraps >> 2);
    vec2 weight = mix(1.0 - part, part, vec2(step));
    alpha += weight.x * weight.y * texelFetch(alpha_texels, first + y * size.x + x).x;
  }
  return alpha;
}

// `weights`: barycentric.
float coverage(TurnedTriangle t, vec3 weights) {
  uvec4 record = texelFetch(part_texels, PART_TEXELS * int(t.part.record) + 1);   // first texel, base alpha, -, -
  uvec4 image = texelFetch(part_texels, PART_TEXELS * int(t.part.record) + 2);  // first alpha, width, height, wraps
  float alpha = uintBitsToFloat(record.y);
  alpha *= dot(weights, vec3(texelFetch(colors, int(t.vertices.x)).a, texelFetch(colors, int(t.vertices.y)).a,
                             texelFetch(colors, int(t.vertices.z)).a));
  if (image.y == 0u) return alpha;
  vec2 uv = vec2(0.0);
  for (int i = 0; i < 3; ++i) {
    uv += weights[i] * uintBitsToFloat(texelFetch(attributes, int(t.vertices[i])).zw);
  }
  return alpha * alpha_at(uv, int(image.x), ivec2(image.yz), image.w);
}
