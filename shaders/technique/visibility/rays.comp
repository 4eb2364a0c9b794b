// A triangle against the sixteen rays of a leaf.
//
// What is nearest is kept in 64 bits where the driver has such atomics (ATOMIC_64): the inverse distance above the
// complement of the id, so that of two triangles at one distance the lower id is larger. Elsewhere a first pass keeps
// inverse distances and a second one the lowest id that has them. Both are the same program, so that they compute the
// same distance. With COLLECT: all blended surfaces before what is nearest.
#ifdef ATOMIC_64
#extension GL_ARB_gpu_shader_int64 : require
#extension GL_NV_shader_atomic_int64 : require
#endif
#include "technique/visibility/turned_triangle.glsl"
#include "technique/visibility/coverage.glsl"
#include "technique/visibility/list.glsl"

layout(local_size_x = 64) in;

layout(binding = 10) uniform samplerBuffer ray_texels;  // of each leaf sixteen; zero for none
layout(binding = 11) uniform usamplerBuffer seen_texels;

#if defined(COLLECT)
layout(std430, binding = 2) writeonly buffer LayerBlock { uvec4 layers[]; };  // ray, triangle, inverse distance
uint seen_at(uint ray) {
#ifdef ATOMIC_64
  return texelFetch(seen_texels, int(ray)).y;
#else
  return texelFetch(seen_texels, int(ray)).x;
#endif
}
#elif defined(ATOMIC_64)
layout(std430, binding = 2) buffer SeenBlock { uint64_t seen[]; };
#else
layout(std430, binding = 2) buffer SeenBlock { uint seen[]; };  // inverse distances, as bits: they sort as numbers do
layout(std430, binding = 3) buffer IdBlock { uint ids[]; };
uniform bool keeps_ids;
#endif

const float LABEL_ALPHA_CUTOFF = 0.5;

bool is_hole(TurnedTriangle t, vec3 inside) {
  if (t.part.alpha == ALPHA_OPAQUE) return false;
  float cutoff = t.part.alpha == ALPHA_BLEND ? LABEL_ALPHA_CUTOFF : t.part.cutoff;
  return !(coverage(t, inside / (inside.x + inside.y + inside.z)) >= cutoff);
}

#ifdef COLLECT
// A ray through an edge belongs to the side whose plane's first number that is not zero is positive.
bool owns(TurnedTriangle t, vec3 inside, float turn) {
  for (int i = 0; i < 3; ++i) {
    if (inside[i] != 0.0) continue;
    vec3 plane = turn * t.edge[i];
    float first = plane.x != 0.0 ? plane.x : plane.y != 0.0 ? plane.y : plane.z;
    if (first < 0.0) return false;
  }
  return true;
}

void keep(TurnedTriangle t, uint ray, vec3 inside, float turn, uint inverse) {
  if (inverse <= seen_at(ray) || !owns(t, inside, turn)) return;
  uint at = atomicAdd(counts[list_counter], 1u);
  if (at < list_capacity) layers[at] = uvec4(ray, t.id, inverse, 0u);
}
#elif defined(ATOMIC_64)
void keep(TurnedTriangle t, uint ray, vec3 inside, uint inverse) {
  uint64_t key = packUint2x32(uvec2(~t.id, inverse));
  if (key > seen[ray] && !is_hole(t, inside)) atomicMax(seen[ray], key);
}
#else
void keep(TurnedTriangle t, uint ray, vec3 inside, uint inverse) {
  if (keeps_ids) {
    if (inverse == texelFetch(seen_texels, int(ray)).x && !is_hole(t, inside)) atomicMin(ids[ray], t.id);
  } else if (inverse > seen[ray] && !is_hole(t, inside)) {
    atomicMax(seen[ray], inverse);
  }
}
#endif

void main() {
  uint number = invocation();
  if (number >= task_count()) return;
  uvec2 task = task_at(number);
  TurnedTriangle t;
  if (!turned_triangle(task.x, t)) return;
  for (uint ray = 16u * task.y; ray < 16u * task.y + 16u; ++ray) {
    vec3 direction = texelFetch(ray_texels, int(ray)).xyz;
    vec3 inside;
    float turn;
    float inverse = meet(t, direction, inside, turn);
    if (!(inverse > 0.0)) continue;
#ifdef COLLECT
    keep(t, ray, inside, turn, floatBitsToUint(inverse));
#else
    keep(t, ray, inside, floatBitsToUint(inverse));
#endif
  }
}
