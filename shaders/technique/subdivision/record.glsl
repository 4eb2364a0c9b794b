// A triangle of the scene, or a part of one, on its way through the passes.
struct Record {
  vec3 position[3];  // camera frame
  vec2 pixel[3];
  vec2 weight[3];  // barycentric, of the scene's triangle: of its second and third vertex
  uvec2 whose;     // instance, id
  uint broken;     // bits of the edges 01, 12 and 20 that no straight line stands for
  uvec3 decided;   // of these edges: how often each is halved to be drawn, plus one; 0 where that is open
};

const int RECORD_TEXELS = 6;

uvec4[RECORD_TEXELS] pack_record(Record r) {
  return uvec4[RECORD_TEXELS](
      floatBitsToUint(vec4(r.position[0], r.pixel[0].x)), floatBitsToUint(vec4(r.position[1], r.pixel[1].x)),
      floatBitsToUint(vec4(r.position[2], r.pixel[2].x)),
      uvec4(floatBitsToUint(vec3(r.pixel[0].y, r.pixel[1].y, r.pixel[2].y)), r.broken | r.decided.x << 4 | r.decided.y << 8 | r.decided.z << 12),
      floatBitsToUint(vec4(r.weight[0], r.weight[1])), uvec4(floatBitsToUint(r.weight[2]), r.whose));
}

Record unpack_record(uvec4 texel[RECORD_TEXELS]) {
  vec4 a = uintBitsToFloat(texel[0]), b = uintBitsToFloat(texel[1]), c = uintBitsToFloat(texel[2]);
  vec3 y = uintBitsToFloat(texel[3].xyz);
  vec4 weights = uintBitsToFloat(texel[4]);
  Record r;
  r.position = vec3[3](a.xyz, b.xyz, c.xyz);
  r.pixel = vec2[3](vec2(a.w, y.x), vec2(b.w, y.y), vec2(c.w, y.z));
  r.weight = vec2[3](weights.xy, weights.zw, uintBitsToFloat(texel[5].xy));
  r.whose = texel[5].zw;
  r.broken = texel[3].w & 7u;
  r.decided = texel[3].www >> uvec3(4u, 8u, 12u) & 15u;
  return r;
}
