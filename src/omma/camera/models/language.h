// The common subset of C++ and GLSL that lens files are written in, and the angles that lenses are made of.
//
// C++ includes each lens file twice, in namespaces where `real` is double and float; GLSL includes it once. A file may
// use real, vec2, vec3, the built-in functions of GLSL (GLM has them too), OUT(type) for results, and literals written
// real(0.5) wherever the other operand is a vector or the other argument a real. What is for C++ alone stands between
// #ifdef __cplusplus and #endif.
//
// Directions are in the optical frame (x right, y down, z forward). Those that come in have any length but zero; those
// that go out are of unit length. The plane is the model's own: unit focal length, x right, y down. A function returns
// whether its result is valid; where it is not, the result has no meaning. asin and acos stay out: they lose half
// their digits at their ends, and drivers approximate them coarsely.
#ifndef __cplusplus
#define real float
#define OUT(type) out type
#define LENS_FUNCTION

struct Params {
  float k[16];      // in the order of the lens's parameters
  float max_angle;  // radians from the axis beyond which the camera sees nothing
};

const float lens_epsilon = 1.1920929e-7;
#endif

const real lens_pi = real(3.14159265358979323846);

// Radians between the optical axis (+z) and a direction.
LENS_FUNCTION real angle_from_axis(vec3 direction) { return atan(length(vec2(direction.x, direction.y)), direction.z); }

// Radians to the right of the axis, -pi to pi; 0 straight up and down, where there is none.
LENS_FUNCTION real longitude_of(vec3 direction) {
  bool pole = direction.x == real(0.0) && direction.z == real(0.0);
  return pole ? real(0.0) : atan(direction.x, direction.z);
}

// Radians below the horizon, -pi/2 to pi/2.
LENS_FUNCTION real latitude_of(vec3 direction) { return atan(direction.y, length(vec2(direction.x, direction.z))); }

LENS_FUNCTION vec3 direction_at(real longitude, real latitude) {
  return vec3(sin(longitude) * cos(latitude), sin(latitude), cos(longitude) * cos(latitude));
}

LENS_FUNCTION bool within_angle(Params params, vec3 direction) {
  return angle_from_axis(direction) <= params.max_angle;
}
