// What all lenses that are symmetric about their axis share: r = f(θ) is the whole of them.

// The plane point at radius r in the direction's meridian. On the axis, which has every meridian, the rightmost point
// of the circle that it becomes.
LENS_FUNCTION bool radial_project(Params params, vec3 direction, real theta, real r, OUT(vec2) plane) {
  vec2 across = vec2(direction.x, direction.y);
  real rho = length(across);
  plane = rho > real(0.0) ? across * (r / rho) : vec2(r, real(0.0));
  return theta <= params.max_angle;
}

// The direction at angle θ from the axis in the plane point's meridian; for the centre, in the rightmost one.
LENS_FUNCTION bool radial_unproject(Params params, vec2 plane, real theta, OUT(vec3) direction) {
  real r = length(plane);
  vec2 meridian = r > real(0.0) ? plane / r : vec2(real(1.0), real(0.0));
  direction = vec3(meridian * sin(theta), cos(theta));
  return theta <= params.max_angle;
}
