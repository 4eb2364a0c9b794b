#include "omma/technique/nonlinear/image_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace omma {
namespace {

constexpr int leaf_side = 4;  ///< pixels
constexpr int children = 4;   ///< along a side of a node

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * glm::distance(a, b)));
}

/// Rays over a lattice of points and what they say of the rays between the points.
struct RayGrid {
  double step;       ///< pixels
  glm::dvec2 first;  ///< image pixels
  int columns, rows;
  std::vector<glm::dvec3> rays{};  ///< zero where there is none

  glm::dvec2 place(int x, int y) const { return first + step * glm::dvec2(x, y); }
  const glm::dvec3& at(int x, int y) const { return rays[size_t(y) * size_t(columns) + size_t(x)]; }
  static bool is_ray(const glm::dvec3& ray) { return ray != glm::dvec3(0.0); }

  void fill_row(const Camera& camera, int y) {
    for (int x = 0; x < columns; ++x) {
      const auto ray = camera.unproject(place(x, y));
      rays[size_t(y) * size_t(columns) + size_t(x)] = ray ? ray->direction : glm::dvec3(0.0);
    }
  }
};

/// Part of a grid, the last column and row included.
struct GridPart {
  int x0, y0, x1, y1;
};

struct Spread {
  double least = glm::pi<double>(), most = 0.0;
  void add(double angle) {
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  bool smooth() const { return most <= 1.5 * least; }
};

/// A cone around the rays of a part and those between its points. `reach`: how far beyond its outer points, in steps.
/// Nothing when there are no rays. `complete` says whether every point has one.
std::optional<ImageSquare> cone_around(const RayGrid& grid, const GridPart& part, double reach, bool& complete) {
  glm::dvec3 sum(0.0);
  int count = 0;
  Spread across, down;
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const glm::dvec3& ray = grid.at(x, y);
      if (!RayGrid::is_ray(ray)) continue;
      sum += ray;
      ++count;
      if (x < part.x1 && RayGrid::is_ray(grid.at(x + 1, y))) across.add(angle_between(ray, grid.at(x + 1, y)));
      if (y < part.y1 && RayGrid::is_ray(grid.at(x, y + 1))) down.add(angle_between(ray, grid.at(x, y + 1)));
    }
  }
  complete = count == (part.x1 - part.x0 + 1) * (part.y1 - part.y0 + 1);
  if (count == 0) return std::nullopt;
  ImageSquare square;
  if (glm::length(sum) < 1e-6) {
    square.angle = glm::pi<double>();
    return square;
  }
  square.axis = glm::normalize(sum);
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const glm::dvec3& ray = grid.at(x, y);
      if (RayGrid::is_ray(ray)) square.angle = std::max(square.angle, angle_between(square.axis, ray));
    }
  }
  // Where rays change evenly those between points bulge little beyond them; else, from the nearest point they may be as
  // far as half a cell's diagonal.
  const double step = std::max(across.most, down.most);
  const double between = complete && across.smooth() && down.smooth() ? 0.1 : 0.75;
  square.angle = std::min(glm::pi<double>(), square.angle + (between + 1.5 * reach) * step + 1e-7);
  return square;
}

/// What a leaf at the edge of what the camera sees shows, asked of every half pixel.
std::optional<ImageSquare> cone_at_edge(const Camera& camera, const glm::dvec2& corner) {
  constexpr int points = 2 * leaf_side + 3;
  RayGrid grid{.step = 0.5, .first = corner - 0.5, .columns = points, .rows = points};
  grid.rays.resize(size_t(points) * points);
  for (int y = 0; y < points; ++y) grid.fill_row(camera, y);
  bool complete = false;
  return cone_around(grid, {0, 0, points - 1, points - 1}, 0.5, complete);
}

class Builder {
 public:
  Builder(const Camera& camera, const PixelRect& tile, bool shifted)
      : camera_(camera),
        tile_(tile),
        columns_((tile.width() + leaf_side - 1) / leaf_side),
        rows_((tile.height() + leaf_side - 1) / leaf_side),
        leaves_(size_t(columns_) * size_t(rows_)) {
    // A lens may be asked anywhere and is smooth; a ray map is what lies between its pixels' centres.
    const bool is_map = camera.ray_map() != nullptr, is_lens = camera.lens() != nullptr;
    points_per_leaf_ = is_lens ? 2 : leaf_side;
    overlap_ = is_map ? 2 : 1;
    reach_ = shifted && !is_map ? 0.5 * points_per_leaf_ / leaf_side : 0.0;
    grid_.step = double(leaf_side) / points_per_leaf_;
    grid_.first = glm::dvec2(tile.x0, tile.y0) - (is_map ? 0.5 : 0.0);
    grid_.columns = columns_ * points_per_leaf_ + overlap_;
    grid_.rows = rows_ * points_per_leaf_ + overlap_;
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
  void fill_leaves() {
    std::vector<char> complete(leaves_.size());
    tbb::parallel_for(0, rows_, [&](int y) {
      for (int x = 0; x < columns_; ++x) {
        const GridPart part{x * points_per_leaf_, y * points_per_leaf_, (x + 1) * points_per_leaf_ + overlap_ - 1,
                            (y + 1) * points_per_leaf_ + overlap_ - 1};
        bool all = false;
        leaf(x, y) = cone_around(grid_, part, reach_, all);
        complete[size_t(y) * size_t(columns_) + size_t(x)] = all;
      }
    });
    std::vector<glm::ivec2> edges;
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        if (!complete[size_t(y) * size_t(columns_) + size_t(x)] && sees_nearby(x, y)) edges.emplace_back(x, y);
      }
    }
    std::vector<std::optional<ImageSquare>> found(edges.size());
    tbb::parallel_for(size_t(0), edges.size(), [&](size_t i) {
      found[i] = cone_at_edge(camera_, glm::dvec2(tile_.x0, tile_.y0) + double(leaf_side) * glm::dvec2(edges[i]));
    });
    for (size_t i = 0; i < edges.size(); ++i) leaf(edges[i].x, edges[i].y) = found[i];
  }

  std::optional<ImageSquare>& leaf(int x, int y) { return leaves_[size_t(y) * size_t(columns_) + size_t(x)]; }

  bool sees_nearby(int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows_ - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns_ - 1); ++u) {
        if (leaf(u, v)) return true;
      }
    }
    return false;
  }

  /// Returns the new square's number; nothing is added where nothing is seen.
  std::optional<size_t> add(int x, int y, int side) {
    if (x >= tile_.width() || y >= tile_.height()) return std::nullopt;
    const size_t number = squares_.size();
    if (side == leaf_side) {
      const std::optional<ImageSquare>& cone = leaf(x / leaf_side, y / leaf_side);
      if (!cone) return std::nullopt;
      squares_.push_back(*cone);
    } else {
      squares_.emplace_back();
      std::vector<size_t> parts;
      const int step = side / children;
      for (int i = 0; i < children * children; ++i) {
        if (const auto part = add(x + i % children * step, y + i / children * step, step)) parts.push_back(*part);
      }
      if (parts.empty()) {
        squares_.pop_back();
        return std::nullopt;
      }
      enclose(squares_[number], parts);
      squares_[number].descendants = int(squares_.size() - number - 1);
    }
    squares_[number].x = x;
    squares_[number].y = y;
    squares_[number].side = side;
    return number;
  }

  void enclose(ImageSquare& square, const std::vector<size_t>& parts) const {
    glm::dvec3 sum(0.0);
    for (size_t part : parts) sum += squares_[part].axis;
    square.axis = glm::length(sum) > 1e-6 ? glm::normalize(sum) : squares_[parts.front()].axis;
    for (size_t part : parts) {
      square.angle = std::max(square.angle, angle_between(square.axis, squares_[part].axis) + squares_[part].angle);
    }
    square.angle = std::min(square.angle, glm::pi<double>());
  }

  const Camera& camera_;
  const PixelRect tile_;
  int columns_, rows_;  ///< of leaves
  int points_per_leaf_ = 0, overlap_ = 0;
  double reach_ = 0.0;
  RayGrid grid_{};
  std::vector<std::optional<ImageSquare>> leaves_;
  std::vector<ImageSquare> squares_;
};

/// As in shaders/technique/nonlinear/image_tile.glsl.
uint32_t packed(const ImageSquare& square) {
  uint32_t level = 0;
  while (leaf_side << 2 * level < square.side) ++level;
  return uint32_t(square.x) | uint32_t(square.y) << 14 | level << 28;
}

}  // namespace

std::vector<ImageSquare> image_squares(const Camera& camera, const PixelRect& tile, bool shifted) {
  return Builder(camera, tile, shifted).build();
}

void ImageTiles::set(const View& view) {
  const bool shifted = view.shift != glm::dvec2(0.0);
  if (camera_ == view.camera && tile_ == view.tile && (shifted_ || !shifted)) return;
  camera_ = view.camera;
  tile_ = view.tile;
  shifted_ = shifted;
  std::vector<ConeNode> nodes;
  for (const ImageSquare& square : image_squares(view.camera, view.tile, shifted)) {
    const auto number = uint32_t(nodes.size());
    nodes.emplace_back(square.axis, square.angle, square.descendants == 0 ? number : ConeNode::no_piece,
                       packed(square));
    nodes.back().link.x = number + 1 + uint32_t(square.descendants);
  }
  node_count_ = int(nodes.size());
  nodes_.write(std::span<const ConeNode>(nodes));
}

void ImageTiles::bind() const { nodes_.bind(18); }

void ImageTiles::set_uniforms(const gl::Program& program) const { program.set("node_count", node_count_); }

}  // namespace omma
