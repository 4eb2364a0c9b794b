#include "omma/camera/pieces/ray_field.h"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

constexpr double border_px = 1e-8;  // how far inside its border a part is asked
constexpr double inset_px = 0.125;  // how far inside an edge that is a single point of the world

Camera as_far_as_the_formula_goes(const Camera& camera) {
  if (!camera.lens()) return camera;
  Lens lens = *camera.lens();
  lens.parameters.max_angle = lens.model->info.max_angle(lens.parameters);
  return Camera(lens);
}

// The directions in which rays change most and least, and how fast.
struct Change {
  glm::dvec3 most, least;
  double fast, slow;

  explicit Change(const LocalRays& here) {
    const double xx = glm::dot(here.dx, here.dx), yy = glm::dot(here.dy, here.dy), xy = glm::dot(here.dx, here.dy);
    const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const glm::dvec3 along = std::cos(turn) * here.dx + std::sin(turn) * here.dy;
    fast = glm::length(along);
    most = fast > 0.0 ? along / fast : glm::dvec3(0.0);
    least = glm::cross(here.ray, most);
    slow = glm::length(std::cos(turn) * here.dy - std::sin(turn) * here.dx);
  }
};

}  // namespace

std::optional<double> LocalRays::distance_px(const glm::dvec3& shown) const {
  constexpr double far_px = 1e6;
  const Change change(*this);
  if (!(change.fast > 1e-12)) return {};
  const double ahead = glm::dot(shown, ray);
  if (!(ahead > 0.0)) return far_px;
  const glm::dvec2 aside(glm::dot(shown, change.most) / ahead, glm::dot(shown, change.least) / ahead);
  return std::hypot(aside.x / change.fast, aside.y / std::max(change.slow, change.fast / 16.0));
}

double LocalRays::distance_px(const glm::dvec3& a, const glm::dvec3& b) const {
  const Change change(*this);
  const glm::dvec3 apart = glm::normalize(a) - glm::normalize(b);
  return std::hypot(glm::dot(apart, change.most) / change.fast,
                    glm::dot(apart, change.least) / std::max(change.slow, change.fast / 16.0));
}

glm::dvec2 LocalRays::changes() const {
  const Change change(*this);
  return {change.fast, change.slow};
}

RayField::RayField(const Camera& camera, std::vector<glm::dvec2> part, const glm::dvec2& inside)
    : wide_(as_far_as_the_formula_goes(camera)),
      camera_(camera),
      part_(std::move(part)),
      inside_(inside),
      // A ray map is bilinear between pixel centres.
      step_(camera.ray_map() ? 0.5 : 0.01),
      jumps_(!camera.lens() || (part_.empty() && camera.lens()->model->info.parts)) {}

glm::dvec2 RayField::nearest_in_part(const glm::dvec2& pixel) const {
  glm::dvec2 nearest = pixel;
  double least = -1.0;
  bool outside = false;
  for (size_t i = 0; i < part_.size(); ++i) {
    const glm::dvec2 from = part_[i], along = part_[(i + 1) % part_.size()] - from;
    const double length = glm::length(along);
    const glm::dvec2 inwards = glm::dvec2(-along.y, along.x) / length;
    if (glm::dot(pixel - from, inwards) >= border_px) continue;
    outside = true;
    const double t = std::clamp(glm::dot(pixel - from, along) / (length * length), 0.0, 1.0);
    const glm::dvec2 point = from + t * along;
    const double distance = glm::distance(point, pixel);
    if (least >= 0.0 && distance >= least) continue;
    least = distance;
    // Towards the middle, which at a corner is inside of both edges.
    const double to_middle = glm::distance(point, inside_);
    nearest = to_middle > 0.0 ? point + (inside_ - point) * std::min(1.0, 4.0 * border_px / to_middle) : point;
  }
  return outside ? nearest : pixel;
}

std::optional<glm::dvec3> RayField::seen(const glm::dvec2& pixel) const {
  const glm::dvec2 within = nearest_in_part(pixel);
  if (within != pixel && glm::distance(within, pixel) > 8.0 * border_px) return {};
  const auto found = camera_.unproject(within);
  if (!found) return {};
  return found->direction;
}

std::optional<glm::dvec3> RayField::ray(const glm::dvec2& pixel) const {
  const glm::dvec2 within = nearest_in_part(pixel);
  if (within != pixel && glm::distance(within, pixel) > 8.0 * border_px) return {};
  const auto found = wide_.unproject(within);
  if (!found) return {};
  return found->direction;
}

std::optional<LocalRays> RayField::local(const glm::dvec2& pixel) const {
  const auto here = seen(pixel);
  if (!here) return {};
  LocalRays rays{*here, glm::dvec3(0.0), glm::dvec3(0.0)};
  for (const int axis : {0, 1}) {
    glm::dvec2 offset(0.0);
    offset[axis] = step_;
    const auto after = ray(pixel + offset);
    const auto before = after && !jumps_ ? std::nullopt : ray(pixel - offset);
    glm::dvec3& change = axis == 0 ? rays.dx : rays.dy;
    const glm::dvec3 forward = after ? (*after - *here) / step_ : glm::dvec3(0.0);
    const glm::dvec3 backward = before ? (*here - *before) / step_ : glm::dvec3(0.0);
    change = after && before ? 0.5 * (forward + backward) : after ? forward : backward;
    // One side jumps to another part of the world.
    const double a = glm::length(forward), b = glm::length(backward);
    if (after && before && std::max(a, b) > 4.0 * std::min(a, b)) change = a < b ? forward : backward;
    change -= glm::dot(change, *here) * *here;
  }
  return rays;
}

double RayField::least_change(const glm::dvec2& pixel) const {
  const auto here = local(pixel);
  return here ? here->changes().y : 0.0;
}

std::optional<glm::dvec3> RayField::beside_point(const glm::dvec2& pixel) const {
  const glm::dvec2 to_inside = inside_ - pixel;
  const double distance = glm::length(to_inside);
  if (!(distance > 1.0)) return {};
  const auto here = local(pixel);
  if (here && here->changes().y > 0.05 * here->changes().x) return {};
  glm::dvec2 best(0.0);
  double most = 0.0;
  for (const glm::dvec2& way :
       {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1), to_inside / distance}) {
    const double change = least_change(pixel + way);
    // Along an axis where it is not much worse, so that rows of an image stay rows.
    if (change > 1.001 * most) {
      most = change;
      best = way;
    }
  }
  // Rays that come together in a point change in proportion to the distance from it.
  const double near = std::max(least_change(pixel), least_change(pixel + inset_px * best));
  if (!(near < 0.5 * most)) return {};
  return ray(pixel + inset_px * best);
}

glm::dvec3 RayField::at(const glm::dvec2& pixel) const {
  if (const auto here = ray(pixel)) return beside_point(pixel).value_or(*here);
  const glm::dvec2 within = nearest_in_part(pixel);
  if (ray(within)) return continued(pixel, within);
  glm::dvec2 last = inside_, first = within;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec2 middle = 0.5 * (last + first);
    (ray(middle) ? last : first) = middle;
  }
  return continued(pixel, last);
}

glm::dvec3 RayField::continued(const glm::dvec2& pixel, const glm::dvec2& within) const {
  const glm::dvec3 here = ray(within).value_or(glm::dvec3(0.0, 0.0, -1.0));
  const double room = glm::distance(within, inside_), beyond = glm::distance(within, pixel);
  if (!(beyond > 0.0) || !(room > 1.0)) return here;
  if (const auto beside = beside_point(within)) return *beside;
  const auto before = ray(within - (pixel - within) * std::min(1.0, room / beyond));
  if (!before) return here;
  return glm::normalize(2.0 * glm::dot(here, *before) * here - *before);
}

}  // namespace omma
