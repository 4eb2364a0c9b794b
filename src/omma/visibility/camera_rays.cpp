#include "omma/visibility/camera_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "omma/visibility/make_blocks.h"
#include "omma/visibility/ray_tree.h"

namespace omma {
namespace {

/// A patch is tried for so many squares a side, then for each of them.
constexpr int squares_at_once = 2;

/// Around the centres of a square's pixels: samples lie half a pixel beside them, the border's rays a pixel more. A
/// patch sees a pixel further all around, so that an image's end that bends between its nodes is none of its own.
constexpr double beside = 2.0;

}  // namespace

SquarePatches::SquarePatches(const Camera& camera, const PixelRect& region)
    : camera_(camera), fitter_(camera_), region_(region) {
  const std::vector<glm::ivec2> places = squares_of({region.width(), region.height()});
  // Squares are in an order in which those of a group follow each other.
  constexpr int side = RayBlock::side, group_side = side * squares_at_once;
  const auto group_of = [&](const glm::ivec2& place) { return place / group_side; };
  std::vector<size_t> groups;
  for (size_t i = 0; i < places.size(); ++i) {
    if (i == 0 || group_of(places[i]) != group_of(places[i - 1])) groups.push_back(i);
  }
  groups.push_back(places.size());
  struct Made {
    std::vector<RayPatch> patches;
    std::vector<Square> squares;
  };
  std::vector<Made> made(groups.size() - 1);
  const glm::dvec2 corner(region.x0, region.y0);
  const auto around = [&](const glm::ivec2& first, int pixels) {
    const double half = 0.5 * pixels;
    return fitter_.around(corner + glm::dvec2(first) + half, half + beside);
  };
  tbb::parallel_for(size_t{0}, made.size(), [&](size_t g) {
    Made& to = made[g];
    const glm::ivec2 group = group_of(places[groups[g]]) * group_side;
    const auto is_blank = [&](const glm::ivec2& first, int pixels) {
      return fitter_.is_blank(corner + glm::dvec2(first) + 0.5 * pixels, 0.5 * pixels + 1.0);
    };
    if (is_blank(group, group_side)) return;
    const auto whole = around(group, group_side);
    if (whole) to.patches.push_back(*whole);
    for (size_t i = groups[g]; i < groups[g + 1]; ++i) {
      if (whole) {
        to.squares.push_back({places[i], 0});
        continue;
      }
      if (is_blank(places[i], side)) continue;
      const auto patch = around(places[i], side);
      if (patch) to.patches.push_back(*patch);
      to.squares.push_back({places[i], patch ? int(to.patches.size()) - 1 : Square::exact});
    }
  });
  for (const Made& part : made) {
    for (Square square : part.squares) {
      if (square.patch != Square::exact) square.patch += int(patches_.size());
      squares_.push_back(square);
    }
    patches_.insert(patches_.end(), part.patches.begin(), part.patches.end());
  }
}

RaySquares CameraRays::some(size_t first, size_t count, RayRoom& room) const {
  const size_t samples = shifts_.size();
  if (room.blocks.size() < count * samples) room.blocks.resize(count * samples);
  if (room.borders.size() < count) room.borders.resize(count);
  const PixelRect& region = patches_->region();
  for (size_t i = 0; i < count; ++i) {
    const SquarePatches::Square& square = patches_->squares()[first + i];
    const std::span<RayBlock> blocks(room.blocks.data() + i * samples, samples);
    for (RayBlock& block : blocks) {
      block.pixel_x = square.first.x;
      block.pixel_y = square.first.y;
    }
    if (square.patch == SquarePatches::Square::exact) {
      make_exactly(square.first, blocks, room.borders[i]);
    } else {
      const PatchSquare of_patch{
          .patch = &patches_->patches()[size_t(square.patch)],
          .first = glm::dvec2(region.x0 + square.first.x, region.y0 + square.first.y) + 0.5,
          .inside = glm::min(glm::ivec2(region.width(), region.height()) - square.first, RayBlock::side),
          .shifts = shifts_};
      make_blocks(of_patch, blocks, room.borders[i]);
    }
  }
  return {{room.blocks.data(), count * samples}, {room.borders.data(), count}};
}

void CameraRays::make_exactly(const glm::ivec2& first, std::span<RayBlock> blocks, SquareBorder& border) const {
  const Camera& camera = patches_->camera();
  if (const RayMap* map = camera.ray_map()) return make_of(*map, first, blocks, border);
  if (const PieceSet* pieces = camera.pieces()) return make_of(*pieces, first, blocks, border);
  make_of(*camera.lens(), first, blocks, border);
}

template <typename Form>
void CameraRays::make_of(const Form& form, const glm::ivec2& first, std::span<RayBlock> blocks,
                         SquareBorder& border) const {
  const PixelRect& region = patches_->region();
  const glm::dvec2 centre(region.x0 + first.x + 0.5, region.y0 + first.y + 0.5);
  const auto ray = [&](int column, int row, const glm::dvec2& shift) {
    const glm::dvec2 pixel = centre + glm::dvec2(column, row) + shift;
    if (patches_->is_blank(pixel)) return glm::vec3(0.0f);
    return glm::vec3(form.unproject(pixel).value_or(glm::dvec3(0.0)));
  };
  const glm::ivec2 inside = glm::ivec2(region.width(), region.height()) - first;
  bool any = false;
  for (size_t s = 0; s < blocks.size(); ++s) {
    const auto in_image = [&](int column, int row) {
      return column < inside.x && row < inside.y ? ray(column, row, shifts_[s]) : glm::vec3(0.0f);
    };
    put_rays(in_image, blocks[s]);
    any |= finish_block(blocks[s]);
  }
  if (any) put_border([&](int column, int row) { return ray(column, row, shifts_.front()); }, border);
}

}  // namespace omma
