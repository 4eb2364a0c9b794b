// The rays, cones and grids of a square of pixels, of a patch's polynomials. Included once for every SIMD target, by
// Highway's rules.
#if defined(OMMA_VISIBILITY_MAKE_BLOCKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_MAKE_BLOCKS_INL_H_
#undef OMMA_VISIBILITY_MAKE_BLOCKS_INL_H_
#else
#define OMMA_VISIBILITY_MAKE_BLOCKS_INL_H_
#endif

#include <cmath>
#include <limits>

#include "omma/visibility/make_blocks.h"
#include "omma/visibility/simd16-inl.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// A leaf's rays, and a block's leaves: four in a row.
alignas(64) constexpr float in_row[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float in_column[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr float counted[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

HWY_INLINE float largest(const Floats& a) { return -least(all(0.0f) - a); }

/// The polynomials of a patch in single precision. Their constant, which is as long as 1 while all else is small, comes
/// in two parts, of which the larger is added last: the sum is rounded once.
class PatchRays {
 public:
  explicit PatchRays(const RayPatch& patch) : patch_(patch), step_(float(1.0 / patch.half_side)) {
    for (int axis = 0; axis < 3; ++axis) {
      for (size_t j = 0; j < RayPatch::terms; ++j) {
        for (size_t i = 0; i < RayPatch::terms; ++i) term_[axis][j][i] = float(patch.term[j][i][axis]);
      }
      large_[axis] = term_[axis][0][0];
      term_[axis][0][0] = float(patch.term[0][0][axis] - double(large_[axis]));
    }
  }

  /// Rows and columns are counted from this place in the image.
  void count_from(const glm::dvec2& first) { first_ = (first - patch_.middle) / patch_.half_side; }

  struct Rows {
    Vectors term[RayPatch::terms];
  };
  HWY_INLINE Rows rows(const Floats& number) const {
    const Floats v = mul_add(number, all(step_), all(first_.y));
    Rows rows;
    for (int i = 0; i < RayPatch::terms; ++i) {
      rows.term[i] = {column(0, i, v), column(1, i, v), column(2, i, v)};
    }
    return rows;
  }
  HWY_INLINE Vectors directions(const Rows& rows, const Floats& number) const {
    const Floats u = mul_add(number, all(step_), all(first_.x));
    Vectors sum = rows.term[3];
    for (int i = 2; i >= 0; --i) {
      sum = {mul_add(sum.x, u, rows.term[i].x), mul_add(sum.y, u, rows.term[i].y), mul_add(sum.z, u, rows.term[i].z)};
    }
    return {sum.x + all(large_[0]), sum.y + all(large_[1]), sum.z + all(large_[2])};
  }

 private:
  HWY_INLINE Floats column(int axis, int i, const Floats& v) const {
    Floats sum = all(term_[axis][3][i]);
    for (int j = 2; j >= 0; --j) sum = mul_add(sum, v, all(term_[axis][j][i]));
    return sum;
  }

  const RayPatch& patch_;
  float step_;
  glm::vec2 first_{0.0f};
  float term_[3][RayPatch::terms][RayPatch::terms], large_[3];
};

/// The square of the sine between an axis of unit length and directions.
HWY_INLINE Floats sine_square(const Vectors& axis, const Floats& along, const Vectors& directions) {
  const Vectors across = directions - axis * along;
  return dot(across, across);
}

/// Cones are this much wider, radians: what single precision takes off the sine, and later off a dot product.
constexpr float cone_slack = 3e-6f;

/// Of the squares of the sines. A patch's rays are never far apart.
struct ConeSize {
  Floats sin, cos;
  explicit HWY_INLINE ConeSize(const Floats& square) {
    sin = sqrt(square) + all(cone_slack);
    cos = sqrt(all(1.0f) - sin * sin);
  }
};

constexpr double middle_of_side = 0.5 * (RayBlock::side - 1);

/// The grid of a square's rays at the pixels' centres, without its errors, which are 0, or infinite where there is
/// none. `direction(column, row)` need not be of unit length; it is asked around the square's middle and `reach` pixels
/// from it.
template <typename Direction>
PixelGrid grid_of(const glm::vec3& ahead, double reach, const Direction& direction) {
  constexpr double middle = middle_of_side;
  PixelGrid grid;
  grid.axis = ahead;
  const glm::dvec3 axis(ahead);
  const glm::dvec3 aside = std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, aside)), up = glm::cross(right, axis);
  const auto on_plane = [&](double column, double row) {
    const glm::dvec3 d = direction(column, row);
    return glm::dvec2(glm::dot(right, d), glm::dot(up, d)) / glm::dot(axis, d);
  };
  const glm::dvec2 centre = on_plane(middle, middle);
  const glm::dvec2 by_column = (on_plane(middle + reach, middle) - on_plane(middle - reach, middle)) / (2.0 * reach);
  const glm::dvec2 by_row = (on_plane(middle, middle + reach) - on_plane(middle, middle - reach)) / (2.0 * reach);
  const double area = by_column.x * by_row.y - by_column.y * by_row.x;
  // Where columns or rows all but meet, as at a panorama's pole, no plane will do.
  if (!(std::abs(area) > 1e-4 * glm::length(by_column) * glm::length(by_row))) return grid;
  const auto coordinate = [&](const glm::dvec2& along) {
    return glm::vec3(along.x * right + along.y * up + (middle - glm::dot(along, centre)) * axis);
  };
  grid.column = coordinate(glm::dvec2(by_row.y, -by_row.x) / area);
  grid.row = coordinate(glm::dvec2(-by_column.y, by_column.x) / area);
  grid.column_error = grid.row_error = 0.0f;
  return grid;
}

/// How far the rays are from where a grid's coordinate has them: from the least to the most.
struct GridError {
  Floats low, high;

  HWY_INLINE GridError()
      : low(all(std::numeric_limits<float>::infinity())), high(all(-std::numeric_limits<float>::infinity())) {}
  HWY_INLINE void add(const Floats& error) {
    low = min(low, error);
    high = max(high, error);
  }
  /// Moves the coordinate into the middle and says what remains.
  void settle(const glm::vec3& axis, glm::vec3& coordinate, float& error) const {
    const float from = least(low), to = largest(high);
    coordinate -= 0.5f * (from + to) * axis;
    // Single precision takes off the products what their factors are large.
    error = 0.5f * (to - from) + 1e-3f + 2e-6f * glm::length(coordinate);
    if (!(error < 1e3f)) error = std::numeric_limits<float>::infinity();
  }
};

/// `rays` are counted from the square's first pixel, `shift` from its centre.
HWY_INLINE void make_block(const PatchSquare& square, const PatchRays& rays, const glm::dvec2& shift,
                           const PixelGrid& at_centres, RayBlock& block) {
  block.grid = at_centres;
  const bool has_grid = at_centres.column_error == 0.0f;
  if (has_grid) {
    block.grid.column -= float(shift.x) * at_centres.axis;
    block.grid.row -= float(shift.y) * at_centres.axis;
  }
  const PixelGrid& grid = block.grid;
  const Vectors axis = all(grid.axis.x, grid.axis.y, grid.axis.z);
  const Vectors column = all(grid.column.x, grid.column.y, grid.column.z);
  const Vectors row = all(grid.row.x, grid.row.y, grid.row.z);
  const bool is_whole = square.inside.x >= RayBlock::side && square.inside.y >= RayBlock::side;

  const Floats across = load(in_row), down = load(in_column), side = all(float(RayBlock::leaf_side));
  const Floats middle = all(0.5f * (RayBlock::leaf_side - 1));
  Vectors leaf_axis = rays.directions(rays.rows(mul_add(down, side, middle)), mul_add(across, side, middle));
  leaf_axis = leaf_axis * (all(1.0f) / sqrt(dot(leaf_axis, leaf_axis)));
  store(leaf_axis.x, block.axis_x);
  store(leaf_axis.y, block.axis_y);
  store(leaf_axis.z, block.axis_z);

  block.leaf_mask = 0;
  alignas(64) float leaf_square[RayBlock::leaves];
  Floats square_of_all = all(0.0f);
  GridError column_error, row_error;
  for (int leaf = 0; leaf < RayBlock::leaves;) {
    const Floats row_number = down + all(float(RayBlock::y_of(leaf, 0)));
    const PatchRays::Rows rows = rays.rows(row_number);
    for (int i = 0; i < 4; ++i, ++leaf) {
      const Floats column_number = across + all(float(RayBlock::x_of(leaf, 0)));
      Vectors d = rays.directions(rows, column_number);
      const Floats along = dot(axis, d);
      square_of_all = max(square_of_all, sine_square(axis, along, d));
      if (has_grid) {
        const Floats inverse = all(1.0f) / along;
        column_error.add(dot(column, d) * inverse - column_number);
        row_error.add(dot(row, d) * inverse - row_number);
      }
      const Vectors around = all(block.axis_x[leaf], block.axis_y[leaf], block.axis_z[leaf]);
      leaf_square[leaf] = largest(sine_square(around, dot(around, d), d));
      uint32_t seen = 0xffff;
      if (!is_whole) {
        const Mask inside = (column_number < all(float(square.inside.x))) & (row_number < all(float(square.inside.y)));
        const Floats none = all(0.0f);
        d = choose(inside, d, {none, none, none});
        seen = bits(inside);
      }
      block.rays[leaf] = uint16_t(seen);
      if (seen != 0) block.leaf_mask |= 1u << leaf;
      store(d.x, block.x[leaf]);
      store(d.y, block.y[leaf]);
      store(d.z, block.z[leaf]);
    }
  }
  const ConeSize of_leaves(load(leaf_square)), of_all(square_of_all);
  store(of_leaves.sin, block.sin);
  store(of_leaves.cos, block.cos);
  block.cone = {grid.axis, largest(of_all.sin), least(of_all.cos)};
  if (has_grid) {
    column_error.settle(grid.axis, block.grid.column, block.grid.column_error);
    row_error.settle(grid.axis, block.grid.row, block.grid.row_error);
  }
}

void make_blocks(const PatchSquare& square, std::span<RayBlock> blocks, SquareBorder& border) {
  const auto at_centre = [&](double column, double row) {
    return square.patch->direction(square.first + glm::dvec2(column, row));
  };
  const glm::vec3 ahead(glm::normalize(at_centre(middle_of_side, middle_of_side)));
  const PixelGrid grid = grid_of(ahead, 6.0, at_centre);
  PatchRays rays(*square.patch);
  for (size_t s = 0; s < blocks.size(); ++s) {
    rays.count_from(square.first + square.shifts[s]);
    make_block(square, rays, square.shifts[s], grid, blocks[s]);
  }
  rays.count_from(square.first + square.shifts.front());
  const Floats number = load(counted), before = all(-1.0f), after = all(float(RayBlock::side));
  const auto put = [&](SquareBorder::Side side, const Floats& column, const Floats& row) HWY_ATTR {
    const Vectors d = rays.directions(rays.rows(row), column);
    store(d.x, border.x[side]);
    store(d.y, border.y[side]);
    store(d.z, border.z[side]);
  };
  put(SquareBorder::left, before, number);
  put(SquareBorder::right, after, number);
  put(SquareBorder::above, number, before);
  put(SquareBorder::below, number, after);
}

HWY_INLINE float sum_of(const Floats& a) {
  auto sum = a.v[0];
  for (size_t k = 1; k < registers; ++k) sum = hn::Add(sum, a.v[k]);
  return hn::GetLane(hn::SumOfLanes(FloatTag(), sum));
}

/// Where none of the rays is farther from the axis than 80 degrees a cone says where they are.
constexpr float least_in_cone = 0.17f;

/// The grid of a block that has all of its rays, without its errors.
inline PixelGrid grid_of_full(const RayBlock& block) {
  const auto ray = [&](int column, int row) {
    const int leaf = row / 4 * 4 + column / 4, i = row % 4 * 4 + column % 4;
    return glm::dvec3(block.x[leaf][i], block.y[leaf][i], block.z[leaf][i]);
  };
  // Half a pixel between two rays, on the line between them.
  return grid_of(block.cone.axis, 5.5, [&](double column, double row) {
    const int left = int(std::floor(column)), above = int(std::floor(row));
    const int right = int(std::ceil(column)), below = int(std::ceil(row));
    return ray(left, above) + ray(right, above) + ray(left, below) + ray(right, below);
  });
}

bool finish_block(RayBlock& block) {
  const Floats zero = all(0.0f), one = all(1.0f);
  const auto rays_of = [&](int leaf) HWY_ATTR -> Vectors {
    return {load(block.x[leaf]), load(block.y[leaf]), load(block.z[leaf])};
  };
  alignas(64) float sum[3][RayBlock::leaves];
  uint32_t common = 0xffff;
  block.leaf_mask = 0;
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    const Vectors d = rays_of(leaf), size = abs(d);
    const uint32_t seen = bits(size.x + size.y + size.z > zero);
    block.rays[leaf] = uint16_t(seen);
    common &= seen;
    if (seen != 0) block.leaf_mask |= 1u << leaf;
    sum[0][leaf] = sum_of(d.x);
    sum[1][leaf] = sum_of(d.y);
    sum[2][leaf] = sum_of(d.z);
  }
  block.cone = {};
  block.grid = {};
  const Vectors sums{load(sum[0]), load(sum[1]), load(sum[2])};
  const Floats length = sqrt(dot(sums, sums));
  const Mask has_axis = length > all(1e-3f);
  const Vectors leaf_axis = choose(has_axis, sums * (one / length), {zero, zero, zero});
  const glm::vec3 whole(sum_of(sums.x), sum_of(sums.y), sum_of(sums.z));
  if (glm::length(whole) > 1e-3f) block.cone.axis = glm::vec3(glm::normalize(glm::dvec3(whole)));
  const glm::vec3 ahead = block.cone.axis;

  PixelGrid grid;
  if (common == 0xffff && ahead != glm::vec3(0.0f)) grid = grid_of_full(block);
  const bool has_grid = grid.column_error == 0.0f;
  store(leaf_axis.x, block.axis_x);
  store(leaf_axis.y, block.axis_y);
  store(leaf_axis.z, block.axis_z);
  const Vectors axis = all(ahead.x, ahead.y, ahead.z);
  const Vectors column = all(grid.column.x, grid.column.y, grid.column.z);
  const Vectors row = all(grid.row.x, grid.row.y, grid.row.z);
  alignas(64) float leaf_square[RayBlock::leaves], leaf_along[RayBlock::leaves];
  Floats square_of_all = zero, least_along = one;
  GridError column_error, row_error;
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    const Vectors d = rays_of(leaf);
    const Mask seen = from_bits(block.rays[leaf]);
    const Floats along = dot(axis, d);
    square_of_all = max(square_of_all, sine_square(axis, along, d));
    least_along = min(least_along, choose(seen, along, one));
    if (has_grid) {
      const Floats inverse = one / along;
      column_error.add(dot(column, d) * inverse - load(in_row) - all(float(RayBlock::x_of(leaf, 0))));
      row_error.add(dot(row, d) * inverse - load(in_column) - all(float(RayBlock::y_of(leaf, 0))));
    }
    const Vectors around = all(block.axis_x[leaf], block.axis_y[leaf], block.axis_z[leaf]);
    const Floats along_leaf = dot(around, d);
    leaf_square[leaf] = largest(sine_square(around, along_leaf, d));
    leaf_along[leaf] = least(choose(seen, along_leaf, one));
  }
  const Mask is_cone = load(leaf_along) >= all(least_in_cone);
  const ConeSize of_leaves(load(leaf_square));
  const Vectors kept = choose(is_cone & has_axis, leaf_axis, {zero, zero, zero});
  store(kept.x, block.axis_x);
  store(kept.y, block.axis_y);
  store(kept.z, block.axis_z);
  store(choose(is_cone & has_axis, of_leaves.sin, one), block.sin);
  store(choose(is_cone & has_axis, of_leaves.cos, zero), block.cos);
  if (block.leaf_mask == 0) return false;
  if (ahead == glm::vec3(0.0f) || least(least_along) < least_in_cone) {
    block.cone = {};
    return true;
  }
  const ConeSize of_all(square_of_all);
  block.cone = {ahead, largest(of_all.sin), least(of_all.cos)};
  if (has_grid) {
    column_error.settle(ahead, grid.column, grid.column_error);
    row_error.settle(ahead, grid.row, grid.row_error);
    block.grid = grid;
  } else {
    block.grid = fit_pixel_grid(block);
  }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
