#include "omma/technique/nonlinear/image_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "omma/technique/camera_program.h"
#include "omma/technique/nonlinear/lens_curvature.h"

namespace omma {
namespace {

constexpr int leaf_side = 4;  ///< pixels, where rays change evenly; elsewhere leaves are pixels
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

/// How rays change from point to point of a part.
struct Changes {
  Spread across{}, down{};
  int missing = 0;  ///< points without a ray

  bool even() const { return missing == 0 && across.smooth() && down.smooth(); }
};

Changes changes_in(const RayGrid& grid, const GridPart& part) {
  Changes changes;
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      const glm::dvec3& ray = grid.at(x, y);
      changes.missing += !RayGrid::is_ray(ray);
      if (!RayGrid::is_ray(ray)) continue;
      if (x < part.x1 && RayGrid::is_ray(grid.at(x + 1, y))) {
        changes.across.add(angle_between(ray, grid.at(x + 1, y)));
      }
      if (y < part.y1 && RayGrid::is_ray(grid.at(x, y + 1))) {
        changes.down.add(angle_between(ray, grid.at(x, y + 1)));
      }
    }
  }
  return changes;
}

/// A cone around the rays of a part and those between its points, up to `reach` steps beyond its outer points. Nothing
/// when there are no rays.
std::optional<ImageSquare> cone_around(const RayGrid& grid, const GridPart& part, double reach) {
  const Changes changes = changes_in(grid, part);
  glm::dvec3 sum(0.0);
  int count = 0;
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      sum += grid.at(x, y);
      count += RayGrid::is_ray(grid.at(x, y));
    }
  }
  if (count == 0) return std::nullopt;
  ImageSquare square;
  const double step = std::max(changes.across.most, changes.down.most);
  // A single ray says nothing of those around it.
  if (glm::length(sum) < 1e-6 || step == 0.0) {
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
  // Where rays change evenly those between points bulge little beyond them; else they may change faster than was seen.
  const double between = changes.even() ? 0.1 : 4.0;
  square.angle = std::min(glm::pi<double>(), square.angle + (between + 1.5 * reach) * step + 1e-7);
  return square;
}

/// What one pixel shows: up to a little within its sides, as seams of an image run between pixels.
std::optional<ImageSquare> cone_of_pixel(const Camera& camera, const glm::dvec2& corner, bool shifted) {
  constexpr double inset = 0.02;
  const double beyond = shifted ? 0.5 : 0.0;
  std::optional<ImageSquare> cone;
  for (const int cells : {2, 8}) {
    RayGrid grid{.step = (1.0 + 2.0 * (beyond - inset)) / cells,
                 .first = corner + inset - beyond,
                 .columns = cells + 1,
                 .rows = cells + 1};
    grid.rays.resize(size_t(grid.columns) * size_t(grid.rows));
    for (int y = 0; y <= cells; ++y) grid.fill_row(camera, y);
    const GridPart all{0, 0, cells, cells};
    cone = cone_around(grid, all, 0.0);
    if (changes_in(grid, all).even()) break;
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
    std::optional<ImageSquare> cone;
    int pixels = -1;  ///< place in pixels_, where it is cut into pixels
  };

  void fill_leaves() {
    std::vector<char> even(leaves_.size());
    tbb::parallel_for(0, rows_, [&](int y) {
      for (int x = 0; x < columns_; ++x) {
        const GridPart part{x * points_per_leaf_ + 1, y * points_per_leaf_ + 1, (x + 1) * points_per_leaf_ + overlap_,
                            (y + 1) * points_per_leaf_ + overlap_};
        leaf(x, y).cone = cone_around(grid_, part, reach_);
        // What lies beyond the leaf's own points must continue them, where it may be sampled.
        const int around = shifted_ ? 1 : 0;
        even[number_of(x, y)] =
            changes_in(grid_, {part.x0 - around, part.y0 - around, part.x1 + around, part.y1 + around}).even();
      }
    });
    std::vector<glm::ivec2> uneven;
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        if (!even[number_of(x, y)] && sees_nearby(x, y)) uneven.emplace_back(x, y);
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

  size_t number_of(int x, int y) const { return size_t(y) * size_t(columns_) + size_t(x); }
  Leaf& leaf(int x, int y) { return leaves_[number_of(x, y)]; }

  bool sees_nearby(int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows_ - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns_ - 1); ++u) {
        if (leaf(u, v).cone) return true;
      }
    }
    return false;
  }

  /// Returns the new square's number; nothing is added where nothing is seen.
  std::optional<size_t> add(int x, int y, int side) {
    if (x >= tile_.width() || y >= tile_.height()) return std::nullopt;
    const size_t number = squares_.size();
    const Leaf* in_leaf = side <= leaf_side ? &leaf(x / leaf_side, y / leaf_side) : nullptr;
    if (side == 1 || (in_leaf != nullptr && in_leaf->pixels < 0)) {
      const int p = y % leaf_side * leaf_side + x % leaf_side;
      const auto& cone = side == 1 ? pixels_[size_t(in_leaf->pixels)][size_t(p)] : in_leaf->cone;
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
  const bool shifted_;
  int columns_, rows_;  ///< of leaves
  int points_per_leaf_ = 0, overlap_ = 0;
  double reach_ = 0.0;
  RayGrid grid_{};
  std::vector<Leaf> leaves_;
  std::vector<std::array<std::optional<ImageSquare>, size_t(leaf_side* leaf_side)>> pixels_;  ///< of uneven leaves
  std::vector<ImageSquare> squares_;
};

/// As in shaders/technique/nonlinear/image_tile.glsl.
uint32_t packed(const ImageSquare& square) {
  uint32_t level = 0;
  while (1 << 2 * level < square.side) ++level;
  return uint32_t(square.x) | uint32_t(square.y) << 14 | level << 28;
}

}  // namespace

std::vector<ImageSquare> image_squares(const Camera& camera, const PixelRect& tile, bool shifted) {
  return Builder(camera, tile, shifted).build();
}

void ImageTiles::set(const View& view) {
  view_ = &view;
  const bool shifted = view.shift != glm::dvec2(0.0);
  if (view.camera.lens() != nullptr && camera_ != view.camera) {
    curvature_.write(std::span<const Curvature>(LensCurvature(*view.camera.lens()).cells()));
  }
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

void ImageTiles::bind() const {
  nodes_.bind(18);
  if (view_->camera.lens() != nullptr) curvature_.bind(22);
}

void ImageTiles::set_uniforms(const gl::Program& program) const {
  program.set("node_count", node_count_);
  set_camera(program, *view_);
  if (const Lens* lens = view_->camera.lens()) {
    program.set("formula_max_angle", float(LensCurvature::without_limit(*lens).parameters.max_angle));
  }
}

gl::Defines ImageTiles::coverage_defines() const {
  gl::Defines defines = outline_defines();
  defines["COVERAGE"] = "technique/nonlinear/coverage.glsl";
  defines["TRIANGLE_FORMS"] = "1";
  // Bits of shaders/technique/nonlinear/forms.glsl.
  defines["FORMS"] = forms_ == Forms::straight ? "4" : "3";
  if (forms_ == Forms::all_exact) defines["ALL_EXACT"] = "1";
  return defines;
}

gl::Defines ImageTiles::outline_defines() const {
  if (view_->camera.lens() == nullptr) return {};
  gl::Defines defines = camera_defines(view_->camera);
  defines["PROJECTS"] = "1";
  return defines;
}

}  // namespace omma
