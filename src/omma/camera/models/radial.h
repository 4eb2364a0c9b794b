// What all lenses that are symmetric about their axis share: r = f(θ) is the whole of them.

// The plane point at radius r in the direction's meridian. At the axis it is the centre; at the antipode, which is a
// whole circle of the image, the circle's rightmost point.
LENS_FUNCTION bool radial_project(Params params, vec3 direction, real theta, real r, OUT(vec2) plane) {
  vec2 across = vec2(direction.x, direction.y);
  real rho = length(across);
  plane = rho > real(0.0) ? across * (r / rho) : vec2(direction.z < real(0.0) ? r : real(0.0), real(0.0));
  return theta <= params.max_angle;
}

// The direction at angle θ from the axis in the plane point's meridian.
LENS_FUNCTION bool radial_unproject(Params params, vec2 plane, real theta, OUT(vec3) direction) {
  real r = length(plane);
  real across = r > real(0.0) ? sin(theta) / r : real(0.0);
  direction = vec3(plane.x * across, plane.y * across, cos(theta));
  return theta <= params.max_angle;
}
