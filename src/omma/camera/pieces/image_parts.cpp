#include "omma/camera/pieces/image_parts.h"

#include <algorithm>
#include <cmath>

#include "omma/base/error.h"

namespace omma {
namespace {

// What lies on the inner side of value(point) >= 0 (Sutherland and Hodgman).
template <typename Value>
std::vector<glm::dvec2> clipped(const std::vector<glm::dvec2>& polygon, Value value) {
  std::vector<glm::dvec2> result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = value(a), at_b = value(b);
    if (at_a >= 0.0) result.push_back(a);
    if ((at_a >= 0.0) != (at_b >= 0.0)) result.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  return result;
}

std::vector<glm::dvec2> clipped_to_image(std::vector<glm::dvec2> polygon, const ImageSize& size) {
  polygon = clipped(polygon, [](const glm::dvec2& p) { return p.x; });
  polygon = clipped(polygon, [](const glm::dvec2& p) { return p.y; });
  polygon = clipped(polygon, [&](const glm::dvec2& p) { return size.width - p.x; });
  return clipped(polygon, [&](const glm::dvec2& p) { return size.height - p.y; });
}

// On the grid, without corners that coincide or lie on the line between their neighbours.
std::vector<glm::i64vec2> on_grid(const std::vector<glm::dvec2>& polygon) {
  std::vector<glm::i64vec2> places;
  for (const glm::dvec2& corner : polygon) places.push_back(on_piece_grid(corner));
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t i = 0; i < places.size() && places.size() >= 3; ++i) {
      const glm::i64vec2 before = places[(i + places.size() - 1) % places.size()],
                         after = places[(i + 1) % places.size()];
      const glm::i64vec2 in = places[i] - before, out = after - places[i];
      if (in.x * out.y - in.y * out.x > 0) continue;
      places.erase(places.begin() + static_cast<std::ptrdiff_t>(i));
      changed = true;
      break;
    }
  }
  return places;
}

glm::dvec2 middle_of(const std::vector<glm::dvec2>& polygon) {
  glm::dvec2 sum(0.0);
  for (const glm::dvec2& corner : polygon) sum += corner;
  return sum / static_cast<double>(polygon.size());
}

std::vector<glm::dvec2> rectangle(const glm::dvec2& low, const glm::dvec2& high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

// How far `from`, a seen pixel's centre, the camera sees along an axis, up to a pixel.
double sight_along(const Camera& camera, const glm::dvec2& from, const glm::dvec2& axis) {
  double last = 0.0, first = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (last + first);
    (camera.unproject(from + middle * axis) ? last : first) = middle;
  }
  return last;
}

// Where what is seen ends on one side of its bounds: exactly where it ends straight, else a pixel further out.
double end_of_sight(const Camera& camera, const SeenPixels& seen, const PixelRect& bounds, const glm::dvec2& axis) {
  const bool along_x = axis.x != 0.0, forward = axis.x + axis.y > 0.0;
  const double edge = along_x ? (forward ? bounds.x1 : bounds.x0) : (forward ? bounds.y1 : bounds.y0);
  const double image_end = forward ? (along_x ? camera.size().width : camera.size().height) : 0.0;
  if (edge == image_end) return edge;
  const double sign = forward ? 1.0 : -1.0, centre = edge - 0.5 * sign;
  glm::dvec2 low(bounds.x0, bounds.y0), high(bounds.x1, bounds.y1);
  (along_x ? low.x : low.y) = centre - 0.25;
  (along_x ? high.x : high.y) = centre + 0.25;
  double least = 1.0, most = 0.0;
  for (const glm::dvec2& pixel : seen.within(rectangle(low, high), 64)) {
    const double sight = sight_along(camera, pixel, axis);
    least = std::min(least, sight);
    most = std::max(most, sight);
  }
  const double further = edge + sign;
  if (most - least > 1.0 / piece_grid) return forward ? std::min(further, image_end) : std::max(further, image_end);
  const double places = (centre + sign * most) * piece_grid;
  return (forward ? std::ceil(places - 1e-3) : std::floor(places + 1e-3)) / piece_grid;
}

}  // namespace

bool ImagePart::is_rectangle() const {
  return corners.size() == 4 && corners[0].y == corners[1].y && corners[1].x == corners[2].x &&
         corners[2].y == corners[3].y && corners[3].x == corners[0].x && corners[0].x < corners[1].x;
}

std::vector<ImagePart> image_parts(const Camera& camera, const SeenPixels& seen) {
  std::vector<ImagePart> parts;
  const Lens* lens = camera.lens();
  if (lens && lens->model->info.parts) {
    for (std::vector<glm::dvec2> polygon : lens->model->info.parts(lens->parameters)) {
      for (glm::dvec2& corner : polygon) corner = lens->centre + lens->focal * corner;
      const std::vector<glm::dvec2> in_image = clipped_to_image(polygon, camera.size());
      std::vector<glm::i64vec2> corners = on_grid(in_image);
      if (corners.size() < 3 || !seen.any_in(in_image)) continue;
      parts.push_back({std::move(corners), RayField(camera, polygon, middle_of(in_image))});
    }
    return parts;
  }
  const PixelRect bounds = seen.bounds();
  if (bounds.empty()) return parts;
  const glm::dvec2 low(end_of_sight(camera, seen, bounds, {-1, 0}), end_of_sight(camera, seen, bounds, {0, -1}));
  const glm::dvec2 high(end_of_sight(camera, seen, bounds, {1, 0}), end_of_sight(camera, seen, bounds, {0, 1}));
  const std::vector<glm::dvec2> polygon = rectangle(low, high);
  // A point with a ray, the lens's own centre where there is one.
  glm::dvec2 inside = lens ? lens->centre : middle_of(polygon);
  const glm::dvec2 middle = middle_of(polygon);
  const bool central = inside.x > low.x && inside.y > low.y && inside.x < high.x && inside.y < high.y;
  if (!central || !camera.unproject(inside)) {
    inside = middle;
    double nearest = 1e300;
    if (!camera.unproject(middle)) {
      for (const glm::dvec2& pixel : seen.within(polygon, 4096)) {
        if (glm::distance(pixel, middle) < nearest) {
          nearest = glm::distance(pixel, middle);
          inside = pixel;
        }
      }
    }
  }
  parts.push_back({on_grid(polygon), RayField(camera, {}, inside)});
  return parts;
}

}  // namespace omma
