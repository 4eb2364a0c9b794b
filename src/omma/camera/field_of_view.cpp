#include "omma/camera/field_of_view.h"

#include <cmath>

namespace omma {
namespace {

// Degrees between the ray of `centre` and that of the seen point farthest out on the way to `end`.
double angle_towards(const Camera& camera, const glm::dvec2& centre, const glm::dvec2& end) {
  const glm::dvec3 axis = camera.unproject(centre)->direction;
  const auto point = [&](double t) { return centre + t * (end - centre); };
  const auto seen = [&](double t) { return camera.unproject(point(t)).has_value(); };

  constexpr int steps = 1024;
  int last = steps;
  while (last > 0 && !seen(static_cast<double>(last) / steps)) --last;
  double inside = static_cast<double>(last) / steps;
  double outside = last == steps ? inside : static_cast<double>(last + 1) / steps;
  for (int i = 0; i < 60 && outside > inside; ++i) {
    const double middle = 0.5 * (inside + outside);
    (seen(middle) ? inside : outside) = middle;
  }
  const glm::dvec3 ray = camera.unproject(point(inside))->direction;
  const double angle = std::atan2(glm::length(glm::cross(axis, ray)), glm::dot(axis, ray));
  return angle * 180.0 / 3.14159265358979323846;
}

}  // namespace

FieldOfView field_of_view(const Camera& camera) {
  const glm::dvec2 corner(camera.size().width, camera.size().height);
  const glm::dvec2 centre = 0.5 * corner;
  if (!camera.unproject(centre)) return {};
  const auto along = [&](const glm::dvec2& from, const glm::dvec2& to) {
    return angle_towards(camera, centre, from) + angle_towards(camera, centre, to);
  };
  return {.horizontal_deg = along({0.0, centre.y}, {corner.x, centre.y}),
          .vertical_deg = along({centre.x, 0.0}, {centre.x, corner.y}),
          .diagonal_deg = along({0.0, 0.0}, corner)};
}

}  // namespace omma
