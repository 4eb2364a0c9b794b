#include "omma/camera/ray_patch.h"

#include <algorithm>
#include <cmath>

namespace omma {
namespace {

// Chebyshev's extrema: a square's corners are among the nodes, so that what cuts it parts one of them from the others.
constexpr std::array<double, RayPatch::terms> nodes = {-1.0, -0.5, 0.5, 1.0};

// Where the polynomials are compared with the formula: between the nodes, where they are farthest from it.
constexpr std::array<glm::dvec2, 4> proofs = {glm::dvec2(0.0, 0.0), glm::dvec2(-0.8, 0.3), glm::dvec2(0.3, -0.8),
                                              glm::dvec2(0.75, 0.75)};

// Directions nearer to each other than this are one in single precision; errors larger than the other make a direction
// noticeably longer or shorter than 1.
constexpr double finest = 3e-8, coarsest = 3e-7;

// A hole of this radius, pixels, cannot reach between two nodes by more than the pixel that a patch is wider than its
// rays: the nodes of 36 pixels are 18 apart.
constexpr double widest_hidden = 48.0;

// A patch's rays are within some 40 degrees of its middle: cones around them need no cases.
constexpr double least_along = 0.77;

// The polynomial through the values at the nodes.
std::array<glm::dvec3, 4> through(const std::array<glm::dvec3, 4>& value) {
  const glm::dvec3 even_far = 0.5 * (value[0] + value[3]), odd_far = 0.5 * (value[3] - value[0]);
  const glm::dvec3 even_near = 0.5 * (value[1] + value[2]), odd_near = 0.5 * (value[2] - value[1]);
  const glm::dvec3 square = (even_far - even_near) / 0.75, linear = (8.0 * odd_near - odd_far) / 3.0;
  return {even_far - square, linear, square, odd_far - linear};
}

// True when no edge of the convex polygon, clockwise as seen, has the point outside.
bool is_within(const std::vector<glm::dvec2>& polygon, const glm::dvec2& point) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2& from = polygon[i];
    const glm::dvec2 along = polygon[(i + 1) % polygon.size()] - from;
    if (along.x * (point.y - from.y) - along.y * (point.x - from.x) < 0.0) return false;
  }
  return true;
}

std::array<glm::dvec2, 4> corners_of(const glm::dvec2& low, const glm::dvec2& high) {
  return {low, glm::dvec2(high.x, low.y), high, glm::dvec2(low.x, high.y)};
}

// The radius of the plane beyond which a lens that is symmetric about its axis sees nothing; nothing where it is not
// known to be.
std::optional<double> last_radius_of(const Lens& lens) {
  const LensInfo& info = lens.model->info;
  if (!info.radial) return {};
  if (info.skewed) {
    const LensParameters plain = lens_parameters(info);
    // Which parameters skew a lens it does not say: all of them have to be at rest.
    for (size_t i = 0; i < info.parameters.size(); ++i) {
      if (lens.parameters.k[i] != plain.k[i]) return {};
    }
  }
  const auto is_seen = [&](double radius) {
    glm::dvec3 direction;
    return lens.model->unproject(lens.parameters, glm::dvec2(radius, 0.0), direction);
  };
  // As far as the image reaches, and around it.
  const glm::dvec2 far =
      (glm::max(lens.centre, glm::dvec2(lens.size.width, lens.size.height) - lens.centre) + 64.0) / lens.focal;
  double seen = 0.0, unseen = glm::length(far);
  if (!std::isfinite(unseen) || is_seen(unseen)) return {};
  // From outside inwards, so that a hole in the middle is none of the border.
  constexpr int steps = 1024;
  const double step = unseen / steps;
  int last = steps - 1;
  while (last > 0 && !is_seen(last * step)) --last;
  if (last == 0 && !is_seen(0.0)) return {};  // a ring narrower than a step
  seen = last * step;
  unseen = (last + 1) * step;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (seen + unseen);
    (is_seen(middle) ? seen : unseen) = middle;
  }
  return unseen;
}

}  // namespace

glm::dvec3 RayPatch::direction(const glm::dvec2& pixel) const {
  const glm::dvec2 at = (pixel - middle) / half_side;
  glm::dvec3 sum(0.0);
  for (int j = terms; j-- > 0;) {
    glm::dvec3 row(0.0);
    for (int i = terms; i-- > 0;) row = row * at.x + term[size_t(j)][size_t(i)];
    sum = sum * at.y + row;
  }
  return sum;
}

PatchFitter::PatchFitter(const Camera& camera) : camera_(camera) {
  const Lens* lens = camera.lens();
  if (!lens) return;
  last_radius_ = last_radius_of(*lens);
  has_hole_in_middle_ = !lens->unproject(lens->centre);
  if (!lens->model->info.parts) return;
  parts_ = lens->model->info.parts(lens->parameters);
  for (std::vector<glm::dvec2>& polygon : parts_) {
    for (glm::dvec2& corner : polygon) corner = lens->centre + lens->focal * corner;
  }
}

bool PatchFitter::is_smooth(const glm::dvec2& low, const glm::dvec2& high) const {
  const std::array<glm::dvec2, 4> corners = corners_of(low, high);
  if (const PieceSet* pieces = camera_.pieces()) {
    const auto first = pieces->owner(corners[0]);
    return first && !pieces->contested(*first) &&
           std::ranges::all_of(corners, [&](const glm::dvec2& corner) { return pieces->owner(corner) == first; });
  }
  const Lens* lens = camera_.lens();
  if (!lens) return false;
  // The axis of a lens that is symmetric about it may be seen as a circle.
  const glm::dvec2& centre = lens->centre;
  const double around = has_hole_in_middle_ ? widest_hidden : 0.0;
  const bool is_beside = centre.x < low.x - around || centre.y < low.y - around || centre.x > high.x + around ||
                         centre.y > high.y + around;
  if (!is_beside) return false;
  return parts_.empty() || std::ranges::any_of(parts_, [&](const std::vector<glm::dvec2>& part) {
           return std::ranges::all_of(corners, [&](const glm::dvec2& corner) { return is_within(part, corner); });
         });
}

bool PatchFitter::is_blank(const glm::dvec2& middle, double half_side) const {
  if (!last_radius_) return false;
  const Lens& lens = *camera_.lens();
  const glm::dvec2 beside = glm::max(glm::abs(middle - lens.centre) - half_side, glm::dvec2(0.0)) / lens.focal;
  return glm::length(beside) > *last_radius_;
}

std::optional<RayPatch> PatchFitter::around(const glm::dvec2& middle, double half_side) const {
  if (!is_smooth(middle - half_side, middle + half_side)) return {};
  std::array<std::array<glm::dvec3, 4>, 4> along_x;
  std::array<std::array<glm::dvec3, 4>, 4> value;
  for (size_t j = 0; j < nodes.size(); ++j) {
    for (size_t i = 0; i < nodes.size(); ++i) {
      const auto ray = camera_.unproject(middle + half_side * glm::dvec2(nodes[i], nodes[j]));
      if (!ray) return {};
      value[j][i] = ray->direction;
    }
    along_x[j] = through(value[j]);
  }
  RayPatch patch{middle, half_side, {}};
  for (size_t i = 0; i < nodes.size(); ++i) {
    const auto column = through({along_x[0][i], along_x[1][i], along_x[2][i], along_x[3][i]});
    for (size_t j = 0; j < nodes.size(); ++j) patch.term[j][i] = column[j];
  }
  // A pixel's change is half_side-th of that of u or v.
  const double spacing = std::min(glm::length(patch.term[0][1]), glm::length(patch.term[1][0])) / half_side;
  const double accepted = std::clamp(tolerance * spacing, finest, coarsest);
  for (const glm::dvec2& at : proofs) {
    const glm::dvec2 pixel = middle + half_side * at;
    const auto ray = camera_.unproject(pixel);
    if (!ray || !(glm::distance(patch.direction(pixel), ray->direction) <= accepted)) return {};
  }
  const glm::dvec3 ahead = patch.term[0][0];
  double along = 1.0;
  for (const size_t j : {0, 3}) {
    for (const size_t i : {0, 3}) along = std::min(along, glm::dot(ahead, value[j][i]));
  }
  if (along < least_along || may_hide_a_hole(ahead, std::acos(std::min(1.0, along)))) return {};
  return patch;
}

bool PatchFitter::may_hide_a_hole(const glm::dvec3& ahead, double reach) const {
  const Lens* lens = camera_.lens();
  if (!lens) return false;
  // What lies beyond max_angle is a cone around the way back. Layouts have it in the midst of their parts; where it is
  // as wide as several patches, it cannot reach into one of them unseen.
  constexpr double pi = 3.14159265358979323846;
  const double hole = pi - lens->parameters.max_angle;
  if (!(hole > 0.0) || hole > 4.0 * reach) return false;
  const double from_back = std::acos(std::clamp(glm::dot(ahead, lens->cameraFromLens[2]), -1.0, 1.0));
  return from_back <= 1.1 * reach + hole;
}

}  // namespace omma
