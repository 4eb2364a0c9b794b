#include "omma/technique/nonlinear/image_tiles.h"

#include "omma/technique/camera_program.h"
#include "omma/technique/nonlinear/lens_curvature.h"

namespace omma {
namespace {

/// As in shaders/technique/nonlinear/image_tile.glsl.
constexpr LinearRays not_linear{.middle = {}, .across = {}, .down = {}, .off = -1.0};

/// As in shaders/technique/nonlinear/image_tile.glsl.
uint32_t packed(const ImageSquare& square) {
  uint32_t level = 0;
  while (1 << level < square.side) ++level;
  return uint32_t(square.x) | uint32_t(square.y) << 14 | level << 28;
}

}  // namespace

ImageTiles::Squares ImageTiles::upload(const Key& key) {
  std::vector<ConeNode> nodes;
  std::vector<glm::vec4> linear;
  for (const ImageSquare& square : image_squares(key.camera, key.tile, key.shifted)) {
    const auto number = uint32_t(nodes.size());
    nodes.emplace_back(square.cone.axis, square.cone.angle, square.descendants == 0 ? number : ConeNode::no_piece,
                       packed(square));
    nodes.back().link.x = number + 1 + uint32_t(square.descendants);
    // A few pixels that see nothing cost less than a polygon for each that does.
    const bool is_whole = square.whole || square.side <= 4;
    const LinearRays rays = square.linear.value_or(not_linear);
    linear.insert(linear.end(),
                  {glm::vec4(rays.middle, rays.off), glm::vec4(rays.across, is_whole), glm::vec4(rays.down, 0)});
  }
  Squares squares;
  squares.count = int(nodes.size());
  squares.nodes.write(std::span<const ConeNode>(nodes));
  squares.linear_rays.write(std::span<const glm::vec4>(linear));
  return squares;
}

gl::Texels ImageTiles::upload_curvature(const Lens& lens) {
  gl::Texels texels(GL_RGB32F);
  texels.write(std::span<const Curvature>(LensCurvature(lens).cells()));
  return texels;
}

void ImageTiles::set(const View& view) {
  view_ = &view;
  squares_ = &cache_.get({view.camera, view.tile, view.shift != glm::dvec2(0.0)}, upload);
  const Lens* lens = view.camera.lens();
  curvature_ = lens != nullptr ? &curvatures_.get(*lens, upload_curvature) : nullptr;
}

size_t ImageTiles::bytes() const {
  size_t sum = 0;
  cache_.each([&](const Squares& squares) { sum += squares.nodes.bytes() + squares.linear_rays.bytes(); });
  curvatures_.each([&](const gl::Texels& texels) { sum += texels.bytes(); });
  return sum;
}

void ImageTiles::bind() const {
  squares_->nodes.bind(18);
  squares_->linear_rays.bind(23);
  if (curvature_ != nullptr) curvature_->bind(22);
}

void ImageTiles::set_uniforms(const gl::Program& program) const {
  program.set("node_count", squares_->count);
  program.set("square_shift", glm::vec2(view_->shift));
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
