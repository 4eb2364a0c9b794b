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
#include "${HOLES}"
#include "technique/visibility/list.glsl"

layout(local_size_x = 64) in;

layout(binding = 10) uniform samplerBuffer ray_texels;  // of each leaf sixteen; zero for none
layout(binding = 11) uniform usamplerBuffer seen_texels;

// Inverse distances as bits sort as numbers do.
#if defined(COLLECT)
layout(std430, binding = 2) writeonly buffer LayerBlock { uvec4 layers[]; };  // ray, triangle, inverse distance
#elif defined(ATOMIC_64)
layout(std430, binding = 2) buffer SeenBlock { uint64_t seen[]; };
#else
layout(std430, binding = 2) buffer SeenBlock { uint seen[]; };
layout(std430, binding = 3) buffer IdBlock { uint ids[]; };
uniform bool keeps_ids;
#endif

// What the ray saw when this program began, or a little later: enough to pass most of what is farther.
uint inverse_seen(uint ray) {
#ifdef ATOMIC_64
  return texelFetch(seen_texels, int(ray)).y;
#else
  return texelFetch(seen_texels, int(ray)).x;
#endif
}

bool is_hole(TurnedTriangle t, vec3 inside) {
#ifdef HOLES
  if (t.part.alpha == ALPHA_OPAQUE) return false;
  return !(coverage(t, inside / (inside.x + inside.y + inside.z)) >= t.part.cutoff);
#else
  return false;
#endif
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

bool is_wanted(uint inverse, uint seen) { return inverse > seen; }

void keep(TurnedTriangle t, uint ray, vec3 inside, float turn, uint inverse) {
  if (!owns(t, inside, turn)) return;
  uint at = atomicAdd(counts[list_counter], 1u);
  if (at < list_capacity) layers[at] = uvec4(ray, t.id, inverse, 0u);
}
#elif defined(ATOMIC_64)
bool is_wanted(uint inverse, uint seen) { return inverse >= seen; }

void keep(TurnedTriangle t, uint ray, vec3 inside, float turn, uint inverse) {
  if (!is_hole(t, inside)) atomicMax(seen[ray], packUint2x32(uvec2(~t.id, inverse)));
}
#else
bool is_wanted(uint inverse, uint seen) { return keeps_ids ? inverse == seen : inverse > seen; }

void keep(TurnedTriangle t, uint ray, vec3 inside, float turn, uint inverse) {
  if (is_hole(t, inside)) return;
  if (keeps_ids) {
    atomicMin(ids[ray], t.id);
  } else {
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
    bool wanted = inverse > 0.0 && is_wanted(floatBitsToUint(inverse), inverse_seen(ray));
    // As in append_if.
    for (; wanted; wanted = false) keep(t, ray, inside, turn, floatBitsToUint(inverse));
  }
}
