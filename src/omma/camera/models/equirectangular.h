// Equirectangular panorama: longitude and latitude as they are, the whole sphere in an image of 2:1. A part of the
// sphere, given by its ranges, fills the image.
#ifdef __cplusplus
inline constexpr LensParameterInfo equirectangular_parameters[] = {
    {"longitude_min_deg", -180, -360, 360, "left edge, degrees to the right of the axis"},
    {"longitude_max_deg", 180, -360, 360, "right edge, up to 360 more than the left one"},
    {"latitude_min_deg", -90, -90, 90, "bottom edge, degrees above the horizon"},
    {"latitude_max_deg", 90, -90, 90, "top edge"},
};

inline constexpr LensPreset equirectangular_presets[] = {
    {"half_equirectangular", "longitude_min_deg=-90,longitude_max_deg=90"},
    {"hequirect", "longitude_min_deg=-90,longitude_max_deg=90"},
    {"he", "longitude_min_deg=-90,longitude_max_deg=90"},
    {"vr180", "longitude_min_deg=-90,longitude_max_deg=90"},
};

inline constexpr LensInfo equirectangular_info = {
    .name = "equirectangular",
    .group = "panoramic",
    .also = "equirect, e, latlong, plate_carree, spherical",
    .formula = "x = longitude, y = latitude",
    .source = "Snyder 1987, Map Projections, chapter 12; COLMAP EQUIRECTANGULAR; Hugin (2)",
    .example =
        "equirectangular:longitude_min_deg=-100,longitude_max_deg=100,latitude_min_deg=-60,latitude_max_deg=60,"
        "width=1600,height=800",
    .default_fov_deg = 360,
    .max_fov_deg = 360,
    .max_fov_inclusive = true,
    .default_fit = Fit::width,
    .radial = false,
    .parameters = equirectangular_parameters,
    .max_angle = [](const LensParameters&) { return pi; },
    .presets = equirectangular_presets,
    .frame = [](const LensParameters& parameters) -> std::optional<PlaneRectangle> {
      const auto& k = parameters.k;
      if (k[0] == -180 && k[1] == 180 && k[2] == -90 && k[3] == 90) return {};
      return PlaneRectangle{glm::radians(glm::dvec2(k[0], -k[3])), glm::radians(glm::dvec2(k[1], -k[2]))};
    },
    .widened =
        [](const LensParameters& parameters, double angle) {
          LensParameters wide = parameters;
          auto& k = wide.k;
          const double degrees = glm::degrees(angle), aside = std::min(degrees, (360 - (k[1] - k[0])) / 2);
          k[0] -= aside;
          k[1] += aside;
          k[2] = std::max(-90.0, k[2] - degrees);
          k[3] = std::min(90.0, k[3] + degrees);
          return wide;
        },
    .contradiction = [](const LensParameters& parameters) -> const char* {
      const auto& k = parameters.k;
      if (!(k[0] < k[1] && k[1] - k[0] <= 360)) {
        return "longitude_min_deg has to be less than longitude_max_deg, by 360 at most";
      }
      return k[2] < k[3] ? nullptr : "latitude_min_deg has to be less than latitude_max_deg";
    },
};
#endif

// Within the ranges, but for rounding.
LENS_FUNCTION bool equirectangular_shows(Params params, real longitude, real latitude) {
  real slack = real(4.0) * lens_epsilon;
  return longitude >= radians(params.k[0]) - slack && longitude <= radians(params.k[1]) + slack &&
         -latitude >= radians(params.k[2]) - slack && -latitude <= radians(params.k[3]) + slack;
}

LENS_FUNCTION bool equirectangular_project(Params params, vec3 direction, OUT(vec2) plane) {
  real longitude = longitude_of(direction);
  real latitude = latitude_of(direction);
  // The turn that the ranges are in: they may lie across the seam behind.
  real slack = real(4.0) * lens_epsilon;
  if (longitude > radians(params.k[1]) + slack) longitude -= real(2.0) * lens_pi;
  if (longitude < radians(params.k[0]) - slack) longitude += real(2.0) * lens_pi;
  plane = vec2(longitude, latitude);
  return equirectangular_shows(params, longitude, latitude) && within_angle(params, direction);
}

LENS_FUNCTION bool equirectangular_unproject(Params params, vec2 plane, OUT(vec3) direction) {
  direction = direction_at(plane.x, plane.y);
  return equirectangular_shows(params, plane.x, plane.y) && within_angle(params, direction);
}
