#include "omma/viewpoint/standing_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "omma/viewpoint/core_bounds.h"
#include "omma/viewpoint/occupancy_grid.h"

namespace omma {
namespace {

constexpr double smallest_place = 2.0, largest_in_metres = 20e3;  // metres along the longest side
constexpr double eye_height = 1.7, least_eye_height = 0.25, eye_height_by_room = 0.6;
constexpr double enclosed = 0.6;  // the mean of two shares, of all directions and of level ones
constexpr double most_backs = 0.2;
constexpr int around = 16, tries_a_side = 32, sky_directions = 64;
constexpr double least_floor = 0.03;  // of the ground plan, that is such places

struct Spot {
  glm::ivec3 floor{0};  ///< the cell
  double height = 0.0;  ///< of the eyes above the floor, metres
  double score = 0.0;
};

class Search {
 public:
  Search(const Scene& scene, const Bounds& bounds) : scene_(scene), grid_(scene, bounds) {
    const glm::dvec3 extent = glm::dvec3(grid_.size()) * grid_.cell();
    size_ = std::max({extent.x, extent.y, extent.z});
    metres_ = size_ < largest_in_metres;
    tallest_ = metres_ ? eye_height : 0.25 * extent.y;
    least_ = metres_ ? least_eye_height : 0.0;
    for (int i = 0; i < sky_directions; ++i) {  // evenly over the sphere, by the golden angle
      const double y = 1.0 - (2.0 * i + 1.0) / sky_directions, turn = 2.399963229728653 * i;
      directions_[i] = {std::sqrt(1.0 - y * y) * std::cos(turn), y, std::sqrt(1.0 - y * y) * std::sin(turn)};
    }
  }

  std::optional<Viewpoint> run() const {
    const glm::ivec3 size = grid_.size();
    const int step = std::max({1, size.x / tries_a_side, size.z / tries_a_side});
    std::vector<Spot> spots;
    int columns = 0, with_spots = 0;
    for (int z = step / 2; z < size.z; z += step) {
      for (int x = step / 2; x < size.x; x += step) {
        const size_t before = spots.size();
        bool empty = true;
        for (int y = 0; y < size.y; ++y) {
          if (grid_.is_free({x, y, z})) continue;
          empty = false;
          if (const auto spot = spot_at({x, y, z})) spots.push_back(*spot);
        }
        columns += !empty;
        with_spots += spots.size() > before;
      }
    }
    if (spots.empty() || with_spots < least_floor * columns) return std::nullopt;
    return viewpoint_at(refined(best_of(spots), step));
  }

 private:
  static glm::dvec3 level(int i, int count) {
    const double turn = 2.0 * M_PI * i / count;
    return {-std::sin(turn), 0.0, -std::cos(turn)};
  }

  glm::dvec3 eye(const glm::ivec3& floor, double height) const {
    return grid_.center(floor) + glm::dvec3(0.0, height, 0.0);
  }

  /// A quarter of the level directions are free no farther than this.
  double room_around(const glm::dvec3& from) const {
    std::array<double, around> free;
    for (int i = 0; i < around; ++i) free[i] = grid_.look(from, level(i, around)).distance;
    std::nth_element(free.begin(), free.begin() + around / 4, free.end());
    return free[around / 4];
  }

  /// Eyes at this height have free cells below them down to the floor, here and a step away on all sides.
  bool can_stand(const glm::ivec3& floor, double height) const {
    const int step = std::max(1, int(std::lround(0.5 * height / grid_.cell().x)));
    const int head = int(std::ceil(height / grid_.cell().y)) + 1;
    const int slope = std::max(1, int(std::lround(0.3 * step * grid_.cell().x / grid_.cell().y)));
    for (const glm::ivec2 way : {glm::ivec2(0, 0), {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      glm::ivec3 at(floor.x + step * way.x, floor.y, floor.z + step * way.y);
      const int least = way == glm::ivec2(0) ? 0 : -slope, most = -least;
      int level = most;
      while (level >= least && !grid_.is_floor({at.x, floor.y + level, at.z})) --level;
      if (level < least) return false;
      for (int y = level + 1; y <= head; ++y) {
        if (!grid_.is_free({at.x, floor.y + y, at.z})) return false;
      }
    }
    return true;
  }

  std::optional<Spot> spot_at(const glm::ivec3& floor) const {
    const glm::ivec3 over = floor + glm::ivec3(0, 1, 0);
    if (!grid_.is_floor(floor) || !grid_.is_free(over)) return std::nullopt;
    // Eyes below the ceiling; under the sky, no higher than the room around allows.
    double height = tallest_;
    const OccupancyGrid::Sight ceiling = grid_.look(grid_.center(over), {0.0, 1.0, 0.0});
    if (ceiling.meets) {
      height = std::min(height, 0.7 * (ceiling.distance + grid_.cell().y));
    } else {
      for (int i = 0; i < 2; ++i) {
        height = std::min(height, eye_height_by_room * room_around(eye(floor, std::max(height, lowest()))));
      }
    }
    const double tested = std::max(height, lowest());
    if (height < std::max(least_, metres_ ? lowest() : 0.0) || !can_stand(floor, tested)) return std::nullopt;
    const double score = score_at(eye(floor, tested));
    if (score <= 0.0) return std::nullopt;
    return Spot{floor, height, score};
  }

  /// On the level on which most of the floor lies rather than on a table, a gallery or a roof. Its eyes are no higher
  /// than they may be in half of the spots: a person is as tall on a square as in an alley.
  static Spot best_of(std::vector<Spot>& spots) {
    const auto middle = spots.begin() + std::ptrdiff_t(spots.size() / 2);
    std::nth_element(spots.begin(), middle, spots.end(),
                     [](const Spot& a, const Spot& b) { return a.height < b.height; });
    const double usual_height = middle->height;
    std::nth_element(spots.begin(), middle, spots.end(),
                     [](const Spot& a, const Spot& b) { return a.floor.y < b.floor.y; });
    const int usual_floor = middle->floor.y;
    Spot best;
    for (Spot spot : spots) {
      if (std::abs(spot.floor.y - usual_floor) > 2) spot.score *= 0.5;
      if (spot.score > best.score) best = spot;
    }
    best.height = std::min(best.height, usual_height);
    return best;
  }

  /// The best of those around, in ever smaller steps.
  Spot refined(Spot best, int step) const {
    for (; step >= 1; step /= 2) {
      const glm::ivec3 middle = best.floor;
      for (int i = 0; i < 9; ++i) {
        for (int y = middle.y - 2; y <= middle.y + 2; ++y) {
          const auto spot = spot_at({middle.x + step * (i % 3 - 1), y, middle.z + step * (i / 3 - 1)});
          if (!spot || spot->score <= best.score) continue;
          best = {spot->floor, std::min(spot->height, best.height), spot->score};
        }
      }
    }
    return best;
  }

  /// Eyes lower than this would be within the cell that holds the floor.
  double lowest() const { return 1.5 * grid_.cell().y; }

  double score_at(const glm::dvec3& from) const {
    double logarithms = 0.0, nearest = size_;
    int walls = 0;
    for (int i = 0; i < around; ++i) {
      const OccupancyGrid::Sight sight = grid_.look(from, level(i, around));
      walls += sight.meets && sight.front;
      logarithms += std::log(sight.distance);
      nearest = std::min(nearest, sight.distance);
    }
    int fronts = 0, backs = 0;
    for (const glm::dvec3& direction : directions_) {
      const OccupancyGrid::Sight sight = grid_.look(from, direction);
      fronts += sight.meets && sight.front;
      backs += sight.meets && !sight.front;
    }
    const double enclosure = 0.5 * fronts / sky_directions + 0.5 * walls / around;
    if (enclosure < enclosed || backs > most_backs * sky_directions) return 0.0;
    const double room = std::exp(logarithms / around);
    return (enclosure - 0.5) * std::sqrt(std::sqrt(room * nearest));
  }

  /// Level, along the longest free way that is as wide as two neighbouring directions.
  Viewpoint viewpoint_at(const Spot& spot) const {
    constexpr int ways = 64;
    const glm::dvec3 above = eye(spot.floor, std::max(spot.height, lowest()));
    std::array<double, ways> free;
    for (int i = 0; i < ways; ++i) free[i] = grid_.look(above, level(i, ways)).distance;
    int best = 0;
    double longest = 0.0;
    for (int i = 0; i < ways; ++i) {
      const double beside = std::min(free[(i + 1) % ways], free[(i + ways - 1) % ways]);
      if (free[i] + beside > longest) {
        longest = free[i] + beside;
        best = i;
      }
    }
    glm::dvec3 from = above;
    from.y = floor_below(above) + spot.height;
    return {from, from + std::max(free[best], 0.1 * spot.height) * level(best, ways)};
  }

  /// The height of the highest surface straight below a point, exactly.
  double floor_below(const glm::dvec3& point) const {
    double floor = point.y - 2.0 * tallest_;
    bool found = false;
    for (const Instance& instance : scene_.instances) {
      const Mesh& mesh = scene_.meshes[instance.mesh];
      const glm::dmat4& m = instance.worldFromObject;
      for (const glm::uvec3& t : mesh.triangles) {
        const auto corner = [&](uint32_t i) { return glm::dvec3(m * glm::dvec4(mesh.positions[i], 1.0)) - point; };
        const glm::dvec3 a = corner(t.x), b = corner(t.y), c = corner(t.z);
        const double u = b.x * c.z - b.z * c.x, v = c.x * a.z - c.z * a.x, w = a.x * b.z - a.z * b.x;
        if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) continue;
        if (u + v + w == 0.0) continue;
        const double y = point.y + (u * a.y + v * b.y + w * c.y) / (u + v + w);
        if (y > point.y || (found && y <= floor)) continue;
        floor = y;
        found = true;
      }
    }
    return floor;
  }

  const Scene& scene_;
  OccupancyGrid grid_;
  bool metres_ = true;
  double size_ = 0.0, tallest_ = 0.0, least_ = 0.0;
  std::array<glm::dvec3, sky_directions> directions_;
};

}  // namespace

std::optional<Viewpoint> find_standing_place(const Scene& scene) {
  const Bounds bounds = core_bounds(scene);
  const glm::dvec3 extent = bounds.extent();
  if (std::max({extent.x, extent.y, extent.z}) < smallest_place) return std::nullopt;
  return Search(scene, bounds).run();
}

}  // namespace omma
