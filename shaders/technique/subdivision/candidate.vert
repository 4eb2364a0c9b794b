// A triangle to be looked at: of the scene, or part of one from the pass before. One program for all passes: the same
// edge may come up in several, and what becomes of it must not hang on how a compiler rounds.
#include "technique/corners.glsl"
#include "technique/subdivision/candidate.glsl"

uniform bool is_part;

layout(location = 0) in uvec4 in_texel[RECORD_TEXELS];
// Instance, id (of a part's first triangle where parts are drawn), what is added to a vertex's number for its pixel, and
// 1: left out when it turns away, -1: in a mirrored instance, 0: never.
layout(location = 6) in uvec4 in_triangle;

layout(binding = 18) uniform samplerBuffer pixels;  // of every vertex of every instance

out CANDIDATE candidate;

void read_triangle() {
  InstanceRecord instance = instance_of(in_triangle.x);
  Record record;
  record.whose = in_triangle.xy;
#ifndef SORTED
  record.whose.y += uint(gl_VertexID);
#endif
  uvec3 corners = corners_of(instance, record.whose.y);
  for (int i = 0; i < 3; ++i) {
    record.position[i] = corner_position(instance, corners[i]);
    record.pixel[i] = texelFetch(pixels, int(corners[i] + in_triangle.z)).xy;
  }
  record.weight = vec2[3](vec2(0.0), vec2(1.0, 0.0), vec2(0.0, 1.0));
  record.broken = 0u;
  record.decided = uvec3(0u);
  precise vec3 ab = record.position[1] - record.position[0], ac = record.position[2] - record.position[0];
  precise float volume = dot(record.position[0], cross(ab, ac));
  candidate.faces = volume != 0.0 && uintBitsToFloat(in_triangle.w) * volume <= 0.0 ? 1u : 0u;
  candidate.texel = pack_record(record);
  candidate.corners = corners;
}

void main() {
  candidate.texel = in_texel;
  candidate.faces = 1u;
  candidate.corners = uvec3(0u);
  for (bool read = !is_part; read; read = false) read_triangle();
}
