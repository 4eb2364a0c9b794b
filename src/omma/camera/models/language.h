// The common subset of C++ and GLSL that lens files are written in.
//
// C++ includes each lens file twice, in namespaces where `real` is double and float; GLSL includes it once. A file may
// use real, vec2, vec3, the built-in functions of GLSL (GLM has them too), OUT(type) for results, and literals written
// real(0.5) wherever the other operand is a vector or the other argument a real. What is for C++ alone stands between
// #ifdef __cplusplus and #endif.
#ifndef __cplusplus
#define real float
#define OUT(type) out type
#define LENS_FUNCTION

struct Params {
  float k[16];      // in the order of the lens's parameters
  float max_angle;  // radians from the axis beyond which the camera sees nothing
};
#endif
