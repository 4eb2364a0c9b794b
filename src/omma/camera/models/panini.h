// Panini's projection: a cylinder seen from a point d radii behind its axis, on a plane. Verticals and lines through
// the centre stay straight; d = 0 is perspective, d = 1 the usual one, large d the orthographic view of the cylinder.
// The squeezes of Hugin's general form make horizontal lines above or below straighter (positive) or only flatter them
// (negative). Hugin's general and "equi" Panini are this projection; its oldest, plain one takes the tangent of the
// latitude twice and is not.
#ifdef __cplusplus
inline constexpr LensParameterInfo panini_parameters[] = {
    {"d", 1, 0, 100, "distance of the view point behind the cylinder's axis, in radii"},
    {"top", 0, -1, 1, "squeeze above the horizon: above 0 towards straight lines, which ends at 90° to the side"},
    {"bottom", 0, -1, 1, "squeeze below the horizon"},
};
inline constexpr LensPreset panini_presets[] = {
    {"equi_panini", "d=1"},  // what Hugin calls so (16) is the projection at d = 1
};

inline constexpr LensInfo panini_info = {
    .name = "panini",
    .group = "panoramic",
    .also = "pannini, vedutismo",
    .formula = "x = S sin(longitude), y = S tan(latitude) · squeeze, S = (d + 1) / (d + cos(longitude))",
    .source = "Sharpless, Postle, German 2010, Pannini: a new projection for rendering wide angle perspective images",
    .example = "panini:fov_deg=160,d=0.8,top=-0.3,bottom=-0.1",
    .default_fov_deg = 150,
    .max_fov_deg = 360,
    .max_fov_inclusive = false,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = panini_parameters,
    .max_angle =
        [](const LensParameters& parameters) {
          const double d = parameters.k[0];
          return std::acos(-std::min(d, d > 0.0 ? 1.0 / d : 0.0)) - open_end;
        },
    .presets = panini_presets,
};
#endif

// How much a squeeze stretches the height at a longitude; 0 where it cannot.
LENS_FUNCTION real panini_squeeze(real d, real squeeze, real sine, real cosine) {
  if (squeeze < real(0.0)) {
    real flattened = real(1.0) - cos(real(0.92) * atan(sine, cosine));
    return real(1.0) - real(2.0) * d / (d + real(1.0)) * squeeze * flattened;
  }
  if (squeeze == real(0.0)) return real(1.0);
  return cosine > real(0.01) ? real(1.0) + squeeze * (real(1.0) / cosine - real(1.0)) : real(0.0);
}

// d + cos(longitude), without the cancellation that would cost all digits near 180 degrees.
LENS_FUNCTION real panini_depth(real d, real sine, real cosine) {
  real above_back = cosine < real(0.0) ? sine * sine / (real(1.0) - cosine) : real(1.0) + cosine;
  return (d - real(1.0)) + above_back;
}

// Up to where the image of the cylinder is at infinity or, for d > 1, turns back.
LENS_FUNCTION bool panini_reaches(real d, real depth) {
  return depth > max(real(2e-13), d - real(1.0) / max(d, real(1.0)));
}

// `squeeze` holds those above and below the horizon.
LENS_FUNCTION bool panini_to_plane(real d, vec2 squeeze, vec3 direction, OUT(vec2) plane) {
  real rho = length(vec2(direction.x, direction.z));
  bool on_cylinder = abs(direction.y) < real(1e6) * rho;
  real sine = on_cylinder ? direction.x / rho : real(0.0);
  real cosine = on_cylinder ? direction.z / rho : real(1.0);
  real depth = panini_depth(d, sine, cosine);
  bool reached = panini_reaches(d, depth);
  real stretch = panini_squeeze(d, direction.y < real(0.0) ? squeeze.x : squeeze.y, sine, cosine);
  real scale = reached ? (d + real(1.0)) / depth : real(0.0);
  plane = vec2(scale * sine, on_cylinder ? scale * stretch * (direction.y / rho) : real(0.0));
  return on_cylinder && reached && stretch > real(0.0);
}

LENS_FUNCTION bool panini_from_plane(real d, vec2 squeeze, vec2 plane, OUT(vec3) direction) {
  // sin² = x² ((d + cos) / (d + 1))² is a quadratic equation for the cosine.
  real x = plane.x / (d + real(1.0));
  real k = x * x;
  real discriminant = real(1.0) + k * (real(1.0) - d * d);
  real root = sqrt(max(discriminant, real(0.0)));
  real cosine = (root - k * d) / (k + real(1.0));
  real depth = (root + d) / (k + real(1.0));
  real sine = x * depth;
  real stretch = panini_squeeze(d, plane.y < real(0.0) ? squeeze.x : squeeze.y, sine, cosine);
  real height = stretch > real(0.0) ? plane.y * depth / ((d + real(1.0)) * stretch) : real(0.0);
  direction = normalize(vec3(sine, height, cosine));
  return discriminant >= real(0.0) && panini_reaches(d, depth) && stretch > real(0.0) && abs(height) < real(1e6);
}

LENS_FUNCTION bool panini_project(Params params, vec3 direction, OUT(vec2) plane) {
  bool valid = panini_to_plane(params.k[0], vec2(params.k[1], params.k[2]), direction, plane);
  return valid && within_angle(params, direction);
}

LENS_FUNCTION bool panini_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  bool valid = panini_from_plane(params.k[0], vec2(params.k[1], params.k[2]), plane, direction);
  return valid && within_angle(params, direction);
}
