// A corner of a record, its attributes mixed from those of the scene's triangle.
#include "technique/vertex_output.glsl"
#include "technique/corners.glsl"
#include "technique/subdivision/record.glsl"
#include "technique/subdivision/screen.glsl"

layout(binding = 6) uniform usamplerBuffer attributes;
layout(binding = 7) uniform samplerBuffer colors;
layout(binding = 20) uniform usamplerBuffer records;

Record record_of(int number) {
  uvec4 texel[RECORD_TEXELS];
  for (int i = 0; i < RECORD_TEXELS; ++i) texel[i] = texelFetch(records, RECORD_TEXELS * number + i);
  return unpack_record(texel);
}

void write_corner(Record r, int corner) {
  InstanceRecord instance = instance_of(r.whose.x);
  uvec3 corners = corners_of(instance, r.whose.y);
  vec3 weight = vec3(1.0 - r.weight[corner].x - r.weight[corner].y, r.weight[corner]);
  uvec4 a = texelFetch(attributes, int(corners.x));
  uvec4 b = texelFetch(attributes, int(corners.y));
  uvec4 c = texelFetch(attributes, int(corners.z));
  vertex.position = r.position[corner];
  vertex.normal = normal_to_camera(instance, mat3(vertex_normal(a), vertex_normal(b), vertex_normal(c)) * weight);
#ifdef TANGENTS
  vec4 tangent = vertex_tangent(a) * weight.x + vertex_tangent(b) * weight.y + vertex_tangent(c) * weight.z;
  vertex.tangent = vec4(direction_to_camera(instance, tangent.xyz), tangent.w);
#else
  vertex.tangent = vec4(0.0);
#endif
  vertex.uv = mat3x2(vertex_uv(a), vertex_uv(b), vertex_uv(c)) * weight;
  vertex.color = texelFetch(colors, int(corners.x)) * weight.x + texelFetch(colors, int(corners.y)) * weight.y +
                 texelFetch(colors, int(corners.z)) * weight.z;
  vertex.part = r.whose;
}
