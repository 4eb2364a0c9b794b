#include "omma/technique/fragment_sheet.h"

namespace omma {
namespace {

constexpr int side = VisibleSquares::side;
constexpr uint32_t in_square = uint32_t(side * side);
constexpr uint32_t run_bits = 4;  ///< as in shaders/technique/add_fragments.frag
static_assert(SampleFragments::most_samples <= 1u << run_bits);

}  // namespace

void FragmentSheet::lay_out(ImageSize picture, const std::vector<SampleFragments::Fragment>& fragments,
                            const VisibleSquares& squares) {
  std::map<int, uint32_t> counts;
  const auto material_of = [&](const SampleFragments::Fragment& fragment) {
    return squares.material_of(fragment.hit.y);
  };
  for (const auto& fragment : fragments) ++counts[material_of(fragment)];

  squares_.clear();
  std::map<int, uint32_t> next;  // by material, as if squares lay one after another
  uint32_t square_count = 0;
  const uint32_t across = width / side;
  for (const auto& [material, count] : counts) {
    next[material] = square_count * in_square;
    for (const uint32_t end = square_count + (count + in_square - 1) / in_square; square_count < end; ++square_count) {
      squares_[material].emplace_back(square_count % across, square_count / across);
    }
  }
  const auto rows = int((square_count + across - 1) / across) * side;
  if (rows > height_) {
    height_ = rows;
    colors_ = gl::Texture::image(GL_RGBA16F, size());
    framebuffer_ = gl::create_framebuffer();
    glNamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, colors_.id(), 0);
  }

  const size_t area = size_t(width) * size_t(rows);
  std::vector<uint32_t> places(area, VisibleTriangles::nothing);
  std::vector<SampleCoverage> coverage(area);
  std::vector<glm::u16vec2> pixels(area);
  std::vector<uint32_t> runs(size_t(picture.width) * size_t(picture.height), 0);
  std::vector<glm::u16vec2> positions;
  positions.reserve(fragments.size());
  const auto squares_across = size_t(picture.width + side - 1) / side;
  std::vector<bool> touched(squares_across * (size_t(picture.height + side - 1) / side), false);
  for (const auto& fragment : fragments) {
    uint32_t& at = next[material_of(fragment)];
    const uint32_t square = at / in_square, within = at % in_square;
    const uint32_t x = square % across * side + within % side, y = square / across * side + within / side;
    const uint32_t position = y * width + x;
    ++at;
    const bool is_triangle = fragment.hit.x != VisibleTriangles::nothing;
    places[position] = is_triangle ? squares.place_of(fragment.hit.x) : VisibleTriangles::nothing;
    coverage[position] = fragment.coverage;
    pixels[position] = fragment.pixel;
    uint32_t& run = runs[size_t(fragment.pixel.y) * size_t(picture.width) + fragment.pixel.x];
    if (run == 0) run = uint32_t(positions.size()) << run_bits;
    ++run;
    positions.emplace_back(x, y);
    touched[fragment.pixel.y / side * squares_across + fragment.pixel.x / side] = true;
  }
  picture_squares_.clear();
  for (size_t i = 0; i < touched.size(); ++i) {
    if (touched[i]) picture_squares_.emplace_back(i % squares_across, i / squares_across);
  }
  places_.write(std::span<const uint32_t>(places));
  coverage_.write(std::span<const SampleCoverage>(coverage));
  pixels_.write(std::span<const glm::u16vec2>(pixels));
  positions_.write(std::span<const glm::u16vec2>(positions));
  runs_.write(std::span<const uint32_t>(runs));
}

void FragmentSheet::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width, height_);
  places_.bind(4);
  coverage_.bind(17);
  pixels_.bind(18);
}

void FragmentSheet::bind() const {
  glBindSampler(0, 0);
  colors_.bind(0);
  positions_.bind(17);
  runs_.bind(18);
}

size_t FragmentSheet::bytes() const {
  return size_t(width) * size_t(height_) * 8 + places_.bytes() + coverage_.bytes() + pixels_.bytes() +
         positions_.bytes() + runs_.bytes();
}

}  // namespace omma
