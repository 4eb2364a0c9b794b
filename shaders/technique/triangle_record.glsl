// A Triangle as texels of a buffer. Matches technique/triangle_records.cpp.
#include "technique/triangle.glsl"

const int TEXELS_OF_COLORS = 7;
#ifdef TRIANGLE_COLORS
const int TEXELS_OF_TANGENTS = TEXELS_OF_COLORS + 3;
#else
const int TEXELS_OF_TANGENTS = TEXELS_OF_COLORS;
#endif
#ifdef TRIANGLE_TANGENTS
const int TEXELS_OF_EDGES = TEXELS_OF_TANGENTS + 3;
#else
const int TEXELS_OF_EDGES = TEXELS_OF_TANGENTS;
#endif
#ifdef EFFECTS
const int TRIANGLE_TEXELS = TEXELS_OF_EDGES + 2;
#else
const int TRIANGLE_TEXELS = TEXELS_OF_EDGES;
#endif

void pack_triangle(Triangle t, out vec4 texels[TRIANGLE_TEXELS]) {
  texels[0] = vec4(t.sum, t.volume);
  texels[1] = vec4(t.plane_b, t.uv.x);
  texels[2] = vec4(t.plane_c, t.uv.y);
  texels[3] = vec4(t.uv_b, t.uv_c);
  texels[4] = vec4(t.normal, t.normal_b.x);
  texels[5] = vec4(t.normal_b.yz, t.normal_c.xy);
  texels[6] = vec4(t.normal_c.z, t.material, t.object, 0.0);
#ifdef TRIANGLE_COLORS
  texels[TEXELS_OF_COLORS] = t.color;
  texels[TEXELS_OF_COLORS + 1] = t.color_b;
  texels[TEXELS_OF_COLORS + 2] = t.color_c;
#endif
#ifdef TRIANGLE_TANGENTS
  texels[TEXELS_OF_TANGENTS] = t.tangent;
  texels[TEXELS_OF_TANGENTS + 1] = vec4(t.tangent_b, 0.0);
  texels[TEXELS_OF_TANGENTS + 2] = vec4(t.tangent_c, 0.0);
#endif
#ifdef EFFECTS
  texels[TEXELS_OF_EDGES] = vec4(t.edge_b, 0.0);
  texels[TEXELS_OF_EDGES + 1] = vec4(t.edge_c, 0.0);
#endif
}

Triangle unpack_triangle(samplerBuffer records, int record) {
  int at = record * TRIANGLE_TEXELS;
  vec4 t0 = texelFetch(records, at), t1 = texelFetch(records, at + 1), t2 = texelFetch(records, at + 2);
  vec4 t3 = texelFetch(records, at + 3), t4 = texelFetch(records, at + 4), t5 = texelFetch(records, at + 5);
  vec4 t6 = texelFetch(records, at + 6);
  Triangle t;
  t.sum = t0.xyz;
  t.volume = t0.w;
  t.plane_b = t1.xyz;
  t.plane_c = t2.xyz;
  t.uv = vec2(t1.w, t2.w);
  t.uv_b = t3.xy;
  t.uv_c = t3.zw;
  t.normal = t4.xyz;
  t.normal_b = vec3(t4.w, t5.xy);
  t.normal_c = vec3(t5.zw, t6.x);
  t.material = t6.y;
  t.object = t6.z;
#ifdef TRIANGLE_COLORS
  t.color = texelFetch(records, at + TEXELS_OF_COLORS);
  t.color_b = texelFetch(records, at + TEXELS_OF_COLORS + 1);
  t.color_c = texelFetch(records, at + TEXELS_OF_COLORS + 2);
#endif
#ifdef TRIANGLE_TANGENTS
  t.tangent = texelFetch(records, at + TEXELS_OF_TANGENTS);
  t.tangent_b = texelFetch(records, at + TEXELS_OF_TANGENTS + 1).xyz;
  t.tangent_c = texelFetch(records, at + TEXELS_OF_TANGENTS + 2).xyz;
#endif
#ifdef EFFECTS
  t.edge_b = texelFetch(records, at + TEXELS_OF_EDGES).xyz;
  t.edge_c = texelFetch(records, at + TEXELS_OF_EDGES + 1).xyz;
#endif
  return t;
}
