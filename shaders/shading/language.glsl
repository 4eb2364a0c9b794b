// The common subset of C++ and GLSL that surfaces are shaded in, so that a material is written once for GPUs and for
// processors without one. C++ includes the files once for every SIMD instruction set, inside a struct, and each value
// stands for sixteen fragments (software/glsl-inl.h).
//
// What differs from fragment to fragment is real, truth, vec2, vec3, vec4, mat3 or mat4. One cannot branch by it:
// choose(truth, yes, no) takes both sides, but if (some(truth)) passes by what no fragment at hand needs. What is the
// same all over a material (`has`, kinds of light) is bool or int and may be branched by. Components are .x to .w; of swizzles there is xyz_of(v) alone. Declarations of inputs stand
// between #ifndef __cplusplus and #endif, and so do #includes: C++ has both elsewhere.
#define real float
#define truth bool
#define OUT(type) out type
#define SHADING
#define some(condition) (condition)
#define choose(condition, yes, no) ((condition) ? (yes) : (no))

vec3 xyz_of(vec4 v) {
  return v.xyz;
}
