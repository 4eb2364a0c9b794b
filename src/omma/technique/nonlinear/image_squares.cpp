#include "omma/technique/nonlinear/image_squares.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace omma {
namespace {

constexpr int leaf_side = 4;  ///< pixels, of the smallest squares where rays change evenly; elsewhere there are pixels
constexpr int children = 2;   ///< along a side of a square

/// What one pixel shows: up to a little within its sides, as seams of an image run between pixels. Nothing where its
/// centre, wherever a pass has it, sees nothing: its samples go with that.
std::optional<WideCone> cone_of_pixel(const Camera& camera, const glm::dvec2& corner, bool shifted) {
  if (!shifted && !camera.unproject(corner + 0.5)) return std::nullopt;
  constexpr double inset = 0.02;
  const double beyond = shifted ? 0.5 : 0.0;
  std::optional<WideCone> cone;
  for (const int cells : {2, 8, 32}) {
    RayGrid grid{.step = (1.0 + 2.0 * (beyond - inset)) / cells,
                 .first = corner + inset - beyond,
                 .columns = cells + 1,
                 .rows = cells + 1};
    grid.rays.resize(size_t(grid.columns) * size_t(grid.rows));
    for (int y = 0; y <= cells; ++y) grid.fill_row(camera, y);
    const GridPart all{0, 0, cells, cells};
    cone = cone_around(grid, all, 0.0);
    const bool is_lone = cone && cone->angle == glm::pi<double>();  // a ray that says nothing of those around it
    if (is_even(grid, all) || (cells == 8 && !is_lone)) break;
  }
  return cone;
}

class Builder {
 public:
  Builder(const Camera& camera, const PixelRect& tile, bool shifted)
      : camera_(camera),
        tile_(tile),
        shifted_(shifted),
        columns_((tile.width() + leaf_side - 1) / leaf_side),
        rows_((tile.height() + leaf_side - 1) / leaf_side),
        leaves_(size_t(columns_) * size_t(rows_)) {
    // A lens may be asked anywhere and is smooth; a ray map is what lies between its pixels' centres.
    const bool is_map = camera.ray_map() != nullptr, is_lens = camera.lens() != nullptr;
    points_per_leaf_ = is_lens ? 2 : leaf_side;
    overlap_ = is_map ? 2 : 1;
    reach_ = shifted && !is_map ? 0.5 * points_per_leaf_ / leaf_side : 0.0;
    grid_.step = double(leaf_side) / points_per_leaf_;
    grid_.first = glm::dvec2(tile.x0, tile.y0) - (is_map ? 0.5 : 0.0) - grid_.step;
    grid_.columns = columns_ * points_per_leaf_ + overlap_ + 2;
    grid_.rows = rows_ * points_per_leaf_ + overlap_ + 2;
    grid_.rays.resize(size_t(grid_.columns) * size_t(grid_.rows));
    tbb::parallel_for(0, grid_.rows, [&](int y) { grid_.fill_row(camera_, y); });
    fill_leaves();
  }

  std::vector<ImageSquare> build() {
    int side = leaf_side;
    while (side < std::max(tile_.width(), tile_.height())) side *= children;
    add(0, 0, side);
    return std::move(squares_);
  }

 private:
  struct Leaf {
    bool sees = false, whole = false;
    bool even = false;  ///< and so are the points around it, where it may be sampled
    int pixels = -1;    ///< place in pixels_, where it is cut into pixels
  };

  void fill_leaves() {
    tbb::parallel_for(0, rows_, [&](int y) {
      for (int x = 0; x < columns_; ++x) {
        leaf(x, y).sees = cone_around(grid_, part_of(x, y, 1, 0), reach_).has_value();
        leaf(x, y).whole = is_whole(grid_, part_of(x, y, 1, 0));
        leaf(x, y).even = is_even(grid_, part_of(x, y, 1, shifted_ ? 1 : 0));
      }
    });
    std::vector<glm::ivec2> uneven;
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        if (!leaf(x, y).even && sees_nearby(x, y)) uneven.emplace_back(x, y);
      }
    }
    pixels_.resize(uneven.size());
    tbb::parallel_for(size_t(0), uneven.size(), [&](size_t i) {
      const glm::ivec2 corner = leaf_side * uneven[i] + glm::ivec2(tile_.x0, tile_.y0);
      for (int p = 0; p < leaf_side * leaf_side; ++p) {
        const glm::ivec2 pixel = corner + glm::ivec2(p % leaf_side, p / leaf_side);
        pixels_[i][size_t(p)] = cone_of_pixel(camera_, glm::dvec2(pixel), shifted_);
      }
    });
    for (size_t i = 0; i < uneven.size(); ++i) leaf(uneven[i].x, uneven[i].y).pixels = int(i);
  }

  Leaf& leaf(int x, int y) { return leaves_[size_t(y) * size_t(columns_) + size_t(x)]; }

  /// The grid's points in a square of leaves, and `around` more.
  GridPart part_of(int x, int y, int leaves, int around) const {
    return {x * points_per_leaf_ + 1 - around, y * points_per_leaf_ + 1 - around,
            std::min(x + leaves, columns_) * points_per_leaf_ + overlap_ + around,
            std::min(y + leaves, rows_) * points_per_leaf_ + overlap_ + around};
  }

  bool all_leaves(int x, int y, int leaves, bool Leaf::*are) {
    for (int v = y; v < std::min(y + leaves, rows_); ++v) {
      for (int u = x; u < std::min(x + leaves, columns_); ++u) {
        if (!(leaf(u, v).*are)) return false;
      }
    }
    return true;
  }

  std::optional<LinearRays> linear_in(int x, int y, int leaves) {
    if (leaves == 0 || !all_leaves(x, y, leaves, &Leaf::even)) return std::nullopt;
    const GridPart part = part_of(x, y, leaves, shifted_ ? 1 : 0);
    if (leaves > 1 && is_plainly_bent(grid_, part, linear_within_px)) return std::nullopt;
    const int side = leaves * leaf_side;
    const glm::dvec2 centre =
        glm::dvec2(tile_.x0, tile_.y0) + double(leaf_side) * glm::dvec2(x, y) + glm::dvec2(0.5 * side);
    return linear_rays(grid_, part, centre, side);
  }

  bool sees_nearby(int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows_ - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns_ - 1); ++u) {
        if (leaf(u, v).sees) return true;
      }
    }
    return false;
  }

  /// Returns the new square's number; nothing is added where nothing is seen.
  std::optional<size_t> add(int x, int y, int side) {
    if (x >= tile_.width() || y >= tile_.height()) return std::nullopt;
    const size_t number = squares_.size();
    squares_.emplace_back();
    if (side == 1) {
      const int p = y % leaf_side * leaf_side + x % leaf_side;
      const auto& cone = pixels_[size_t(leaf(x / leaf_side, y / leaf_side).pixels)][size_t(p)];
      if (!cone) return nothing();
      squares_[number].cone = *cone;
    } else {
      const glm::ivec2 first = glm::ivec2(x, y) / leaf_side;
      const int leaves = side / leaf_side;  // none between a leaf and its pixels
      squares_[number].whole = leaves > 0 && all_leaves(first.x, first.y, leaves, &Leaf::whole);
      const auto linear = linear_in(first.x, first.y, leaves);
      const bool is_leaf = leaves == 1 && leaf(first.x, first.y).pixels < 0;
      if (is_leaf || (linear && linear->off_px(side) < linear_within_px)) {
        const auto cone = cone_around(grid_, part_of(first.x, first.y, leaves, 0), reach_);
        if (!cone) return nothing();
        squares_[number].cone = *cone;
        squares_[number].linear = linear;
      } else {
        std::vector<size_t> parts;
        const int step = side / children;
        for (int i = 0; i < children * children; ++i) {
          if (const auto part = add(x + i % children * step, y + i / children * step, step)) parts.push_back(*part);
        }
        if (parts.empty()) return nothing();
        enclose(squares_[number].cone, parts);
        squares_[number].descendants = int(squares_.size() - number - 1);
      }
    }
    squares_[number].x = x;
    squares_[number].y = y;
    squares_[number].side = side;
    return number;
  }

  std::optional<size_t> nothing() {
    squares_.pop_back();
    return std::nullopt;
  }

  void enclose(WideCone& cone, const std::vector<size_t>& parts) const {
    glm::dvec3 sum(0.0);
    for (size_t part : parts) sum += squares_[part].cone.axis;
    cone.axis = glm::length(sum) > 1e-6 ? glm::normalize(sum) : squares_[parts.front()].cone.axis;
    for (size_t part : parts) {
      const WideCone& of_part = squares_[part].cone;
      cone.angle = std::max(cone.angle, angle_between(cone.axis, of_part.axis) + of_part.angle);
    }
    cone.angle = std::min(cone.angle, glm::pi<double>());
  }

  const Camera& camera_;
  const PixelRect tile_;
  const bool shifted_;
  int columns_, rows_;  ///< of leaves
  int points_per_leaf_ = 0, overlap_ = 0;
  double reach_ = 0.0;
  RayGrid grid_{};
  std::vector<Leaf> leaves_;
  std::vector<std::array<std::optional<WideCone>, size_t(leaf_side* leaf_side)>> pixels_;  ///< of uneven leaves
  std::vector<ImageSquare> squares_;
};

}  // namespace

std::vector<ImageSquare> image_squares(const Camera& camera, const PixelRect& tile, bool shifted) {
  return Builder(camera, tile, shifted).build();
}

}  // namespace omma
