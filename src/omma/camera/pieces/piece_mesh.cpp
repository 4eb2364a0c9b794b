#include "omma/camera/pieces/piece_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "omma/camera/pieces/flat_pieces.h"
#include "omma/camera/pieces/places.h"

namespace omma {
namespace {

constexpr double shortest_px = 2.0;  // edges that are shorter are not split

constexpr double thinnest_px = 0.5;  // a triangle's least height
constexpr double thinnest_ever_px = 0.03;

int64_t cross(const glm::i64vec2& a, const glm::i64vec2& b) { return a.x * b.y - a.y * b.x; }
int64_t dot(const glm::i64vec2& a) { return a.x * a.x + a.y * a.y; }

double length_on(CornerSurface surface, const glm::dvec3& ray) {
  switch (surface) {
    case CornerSurface::sphere:
      return 1.0;
    case CornerSurface::cylinder:
      return 1.0 / std::max(std::hypot(ray.x, ray.z), 0.1);
    case CornerSurface::plane:
      return 1.0 / std::max(-ray.z, 0.1);
  }
  return 1.0;
}

}  // namespace

PieceMesh::PieceMesh(std::span<const ImagePart> parts, const SeenPixels& seen, CornerSurface surface)
    : parts_(parts), seen_(seen), surface_(surface) {
  std::map<std::pair<int64_t, int64_t>, uint32_t> known;
  const auto number_of = [&](const glm::i64vec2& place) {
    const auto [found, is_new] = known.try_emplace({place.x, place.y}, static_cast<uint32_t>(places_.size()));
    if (is_new) places_.push_back(place);
    return found->second;
  };
  for (const ImagePart& part : parts_) {
    for (const glm::i64vec2& corner : part.corners) number_of(corner);
  }
  const std::vector<glm::i64vec2> corners = places_;
  for (uint32_t p = 0; p < parts_.size(); ++p) {
    // Around the part, with the corners of others that lie on its edges.
    std::vector<uint32_t> around;
    const std::vector<glm::i64vec2>& own = parts_[p].corners;
    for (size_t i = 0; i < own.size(); ++i) {
      const glm::i64vec2 from = own[i], along = own[(i + 1) % own.size()] - from;
      const double edge_length = glm::length(glm::dvec2(along));
      std::vector<std::pair<double, uint32_t>> on_edge;
      for (const glm::i64vec2& place : corners) {
        const double t = glm::dot(glm::dvec2(place - from), glm::dvec2(along)) / (edge_length * edge_length);
        const double aside = std::abs(static_cast<double>(cross(along, place - from))) / edge_length;
        if (aside <= 2.0 && t * edge_length > 2.0 && (1.0 - t) * edge_length > 2.0)
          on_edge.emplace_back(t, number_of(place));
      }
      std::ranges::sort(on_edge);
      around.push_back(number_of(from));
      for (const auto& [t, number] : on_edge) around.push_back(number);
    }
    if (around.size() == 3) {
      add_triangle({around[0], around[1], around[2]}, p);
      continue;
    }
    const uint32_t middle = number_of(on_piece_grid(parts_[p].field.inside()));
    for (size_t i = 0; i < around.size(); ++i) add_triangle({middle, around[i], around[(i + 1) % around.size()]}, p);
  }
}

std::array<glm::dvec2, 3> PieceMesh::pixels(const Triangle& triangle) const {
  return {pixel_of(places_[triangle.corners[0]]), pixel_of(places_[triangle.corners[1]]),
          pixel_of(places_[triangle.corners[2]])};
}

glm::dvec3 PieceMesh::corner_ray(const Triangle& triangle, size_t i) const {
  const glm::dvec3 ray = parts_[triangle.part].field.at(pixel_of(places_[triangle.corners[i]]));
  return length_on(surface_, ray) * ray;
}

double PieceMesh::length(uint32_t a, uint32_t b) const {
  return glm::distance(pixel_of(places_[a]), pixel_of(places_[b]));
}

void PieceMesh::add_triangle(const std::array<uint32_t, 3>& corners, uint32_t part) {
  const auto index = static_cast<uint32_t>(triangles_.size());
  triangles_.push_back({.corners = corners, .part = part});
  unmeasured_.push_back(index);
  ++alive_;
  for (size_t i = 0; i < 3; ++i) {
    Edge& edge = edges_[key(corners[i], corners[(i + 1) % 3])];
    edge.triangles[static_cast<size_t>(edge.count++)] = index;
  }
}

void PieceMesh::remove_triangle(uint32_t index) {
  Triangle& triangle = triangles_[index];
  triangle.alive = false;
  --alive_;
  for (size_t i = 0; i < 3; ++i) {
    const auto found = edges_.find(key(triangle.corners[i], triangle.corners[(i + 1) % 3]));
    Edge& edge = found->second;
    if (edge.triangles[0] == index) edge.triangles[0] = edge.triangles[1];
    if (--edge.count == 0) edges_.erase(found);
  }
}

void PieceMesh::measure(Triangle& triangle, double tolerance_px) const {
  const std::array<glm::dvec2, 3> corners = pixels(triangle);
  const RayField& field = parts_[triangle.part].field;
  const std::array<glm::dvec3, 3> rays = {corner_ray(triangle, 0), corner_ray(triangle, 1), corner_ray(triangle, 2)};
  const glm::dmat3 shown = ray_from_image(corners, rays);
  triangle.error = 0.0;
  triangle.edge_error = {};
  triangle.measured = true;
  size_t points = 0, blind = 0;
  const auto error_at = [&](const glm::dvec2& pixel) {
    const auto here = field.local(pixel);
    const auto error = here ? here->distance_px(shown * glm::dvec3(pixel, 1.0)) : std::nullopt;
    (error ? points : blind) += 1;
    triangle.error = std::max(triangle.error, error.value_or(0.0));
    return error.value_or(0.0);
  };
  // At the points of a lattice; of the finer one those that are not of the coarser.
  for (const int steps : {4, 8}) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const int k = steps - i - j;
        if (i == steps || j == steps || k == steps || (steps == 8 && i % 2 == 0 && j % 2 == 0)) continue;
        const double error = error_at((static_cast<double>(i) * corners[0] + static_cast<double>(j) * corners[1] +
                                       static_cast<double>(k) * corners[2]) /
                                      static_cast<double>(steps));
        if (k == 0) triangle.edge_error[0] = std::max(triangle.edge_error[0], error);
        if (i == 0) triangle.edge_error[1] = std::max(triangle.edge_error[1], error);
        if (j == 0) triangle.edge_error[2] = std::max(triangle.edge_error[2], error);
      }
    }
    if (triangle.error > tolerance_px) return;  // it is split anyway
  }
  // What is seen of it may lie between the points.
  if (blind > 0) {
    for (const glm::dvec2& pixel : seen_.within(corners, 64)) error_at(pixel);
  }
}

void PieceMesh::measure_new(std::optional<double> tolerance_px) {
  if (tolerance_px) {
    tbb::parallel_for(size_t{0}, unmeasured_.size(), [&](size_t i) {
      Triangle& triangle = triangles_[unmeasured_[i]];
      if (triangle.alive) measure(triangle, *tolerance_px);
    });
  }
  for (const uint32_t index : unmeasured_) {
    Triangle& triangle = triangles_[index];
    triangle.measured = true;
    if (!triangle.alive) continue;
    const double most = std::max({triangle.edge_error[0], triangle.edge_error[1], triangle.edge_error[2]});
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = triangle.corners[i], b = triangle.corners[(i + 1) % 3];
      // Where the edges show nothing of a triangle's error their length decides.
      const double share = most < 0.1 * triangle.error ? 1.0 : 1e-4;
      Edge& edge = edges_[key(a, b)];
      edge.weight = std::max(edge.weight, tolerance_px ? triangle.edge_error[i] + share * length(a, b) : length(a, b));
    }
  }
  unmeasured_.clear();
}

std::optional<uint64_t> PieceMesh::edge_to_split(const Triangle& triangle, By by) const {
  std::optional<uint64_t> best;
  double most = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t a = triangle.corners[i], b = triangle.corners[(i + 1) % 3];
    const uint64_t edge = key(a, b);
    const double edge_length = length(a, b), weight = by == By::weight ? edges_.at(edge).weight : edge_length;
    if (edge_length < shortest_px) continue;
    if (best && (weight < most || (weight == most && edge < *best))) continue;
    best = edge;
    most = weight;
  }
  return best;
}

std::optional<uint32_t> PieceMesh::neighbour_at(uint32_t index, uint64_t edge) const {
  const Edge& shared = edges_.at(edge);
  if (shared.count < 2) return {};
  return shared.triangles[0] == index ? shared.triangles[1] : shared.triangles[0];
}

bool PieceMesh::split_edge(uint32_t index, uint64_t edge, double least_height_px) {
  const auto a = static_cast<uint32_t>(edge >> 32), b = static_cast<uint32_t>(edge);
  const glm::i64vec2 sum = places_[a] + places_[b], place(sum.x >> 1, sum.y >> 1);
  const std::optional<uint32_t> neighbour = neighbour_at(index, edge);
  for (const std::optional<uint32_t>& side : {std::optional(index), neighbour}) {
    if (!side) continue;
    const auto& corners = triangles_[*side].corners;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = corners[i], to = corners[(i + 1) % 3];
      if (key(from, to) == edge) continue;
      // Rays at three places in a line say nothing of what is beside it.
      const glm::i64vec2 along = places_[to] - places_[from], half = place - places_[from], rest = place - places_[to];
      const double longest = std::sqrt(static_cast<double>(std::max({dot(along), dot(half), dot(rest)})));
      if (static_cast<double>(cross(along, half)) < least_height_px * piece_grid * longest) return false;
    }
  }
  const auto middle = static_cast<uint32_t>(places_.size());
  places_.push_back(place);
  bisect(index, edge, middle);
  if (neighbour) bisect(*neighbour, edge, middle);
  return true;
}

bool PieceMesh::split(uint32_t index, By by) {
  // Each step goes on to a heavier edge, so there is an end.
  for (;;) {
    if (!triangles_[index].measured) return true;  // made a moment ago; all have their turn when it is measured
    const auto heaviest = edge_to_split(triangles_[index], by);
    if (!heaviest) return false;
    const auto neighbour = neighbour_at(index, *heaviest);
    if (neighbour && !triangles_[*neighbour].measured) return true;
    if (!neighbour || edge_to_split(triangles_[*neighbour], by) == heaviest) {
      return split_edge(index, *heaviest, by == By::weight ? thinnest_px : thinnest_ever_px);
    }
    index = *neighbour;
  }
}

void PieceMesh::bisect(uint32_t index, uint64_t edge, uint32_t middle) {
  const auto corners = triangles_[index].corners;
  const uint32_t part = triangles_[index].part;
  remove_triangle(index);
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t a = corners[i], b = corners[(i + 1) % 3], c = corners[(i + 2) % 3];
    if (key(a, b) != edge) continue;
    add_triangle({a, middle, c}, part);
    add_triangle({middle, b, c}, part);
  }
}

bool PieceMesh::refine(double tolerance_px, size_t most) {
  for (;;) {
    measure_new(tolerance_px);
    std::vector<uint32_t> wrong;
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
      const Triangle& triangle = triangles_[i];
      if (triangle.alive && !triangle.finished && triangle.error > tolerance_px) wrong.push_back(i);
    }
    if (wrong.empty()) return true;
    if (alive_ > most) return false;
    for (const uint32_t index : wrong) {
      // What is too thin to be split by error is split at its longest edge, which makes nothing thinner.
      if (triangles_[index].alive && !split(index, By::weight) && !split(index, By::length))
        triangles_[index].finished = true;
    }
  }
}

void PieceMesh::split_to(size_t count) {
  while (alive_ < count) {
    measure_new(std::nullopt);
    double longest = 0.0;
    for (const auto& [edge, value] : edges_) longest = std::max(longest, value.weight);
    std::vector<uint32_t> candidates;
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
      const auto start = triangles_[i].alive ? edge_to_split(triangles_[i], By::weight) : std::nullopt;
      if (!start) continue;
      if (edges_.at(*start).weight > 0.75 * longest) candidates.push_back(i);
    }
    const size_t before = alive_;
    for (const uint32_t index : candidates) {
      if (alive_ >= count) break;
      if (triangles_[index].alive) split(index, By::weight);
    }
    if (alive_ == before) return;
  }
}

std::vector<Piece> PieceMesh::pieces() const {
  std::vector<std::optional<Piece>> found(triangles_.size());
  tbb::parallel_for(size_t{0}, triangles_.size(), [&](size_t i) {
    const Triangle& triangle = triangles_[i];
    if (!triangle.alive) return;
    const std::array<glm::dvec2, 3> corners = pixels(triangle);
    if (!seen_.any_in(corners)) return;
    const std::array places = {places_[triangle.corners[0]], places_[triangle.corners[1]],
                               places_[triangle.corners[2]]};
    std::array<glm::dvec3, 3> rays = {corner_ray(triangle, 0), corner_ray(triangle, 1), corner_ray(triangle, 2)};
    found[i] = flat_piece(places, ray_from_image(corners, rays));
    // Three rays in a plane show nothing; those a little within do.
    for (double inwards = 0.0625; !found[i] && inwards < 1.0; inwards *= 2.0) {
      const RayField& field = parts_[triangle.part].field;
      std::array<glm::dvec2, 3> within = corners;
      for (size_t c = 0; c < 3; ++c) {
        within[c] += inwards * ((corners[0] + corners[1] + corners[2]) / 3.0 - corners[c]);
        const glm::dvec3 ray = field.at(within[c]);
        rays[c] = length_on(surface_, ray) * ray;
      }
      found[i] = flat_piece(places, ray_from_image(within, rays));
    }
  });
  std::vector<Piece> result;
  for (const auto& piece : found) {
    if (piece) result.push_back(*piece);
  }
  return result;
}

}  // namespace omma
