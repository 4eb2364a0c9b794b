#include "omma/technique/camera_program.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace omma {

gl::Defines camera_defines(const Camera& camera) {
  if (camera.ray_map() != nullptr) return {{"RAY_MAP", "1"}};
  if (camera.pieces() != nullptr) return {{"PIECE_CAMERA", "1"}};
  const std::string name = camera.lens()->model->info.name;
  return {{"LENS", name}, {"LENS_PROJECT", name + "_project"}, {"LENS_UNPROJECT", name + "_unproject"}};
}

void set_camera(const gl::Program& program, const View& view) {
  program.set("pixel_offset", view.pixel_offset());
  if (const PieceSet* pieces = view.camera.pieces()) {
    program.set("camera_bin_counts", pieces->bin_counts());
    program.set("camera_bin_side", PieceSet::bin_side);
  }
  const Lens* lens = view.camera.lens();
  if (lens == nullptr) return;
  std::array<float, LensParameters::max_count> k{};
  std::copy(lens->parameters.k.begin(), lens->parameters.k.end(), k.begin());
  program.set("lens_k", std::span<const float>(k));
  program.set("lens_max_angle", float(lens->parameters.max_angle));
  program.set("lens_focal", glm::vec2(lens->focal));
  program.set("lens_centre", glm::vec2(lens->centre));
  program.set("cameraFromLens", glm::mat3(lens->cameraFromLens));
}

void set_lens_bound(const gl::Program& program, const LensBound& bound) {
  program.set("lens_bound.lines", static_cast<int>(bound.lines));
  program.set("lens_bound.cosine", float(std::cos(bound.angle)));
  program.set("lens_bound.radius", float(bound.radius));
  program.set("lens_bound.margin", float(bound.margin));
  program.set("lens_bound.within_half", int(bound.within_half));
}

void CameraTextures::bind(const Camera& camera) {
  if (camera.lens() != nullptr) return;
  if (camera_ != camera) {
    if (camera.ray_map() != nullptr) {
      upload(*camera.ray_map());
    } else {
      upload(*camera.pieces());
    }
    camera_ = camera;
  }
  if (camera.ray_map() != nullptr) {
    rays_.bind(8);
    return;
  }
  piece_texels_.bind(8);
  bin_first_texels_.bind(12);
  bin_pieces_texels_.bind(13);
}

void CameraTextures::upload(const RayMap& map) {
  rays_ = gl::Texture::image(GL_RGBA32F, map.size);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(rays_.id(), 0, 0, 0, map.size.width, map.size.height, GL_RGB, GL_FLOAT, map.directions.data());
}

void CameraTextures::upload(const PieceSet& set) {
  std::vector<glm::vec4> texels;  // as in shaders/common/piece_camera.glsl
  for (uint32_t i = 0; i < set.pieces().size(); ++i) {
    const Piece& piece = set.pieces()[i];
    const auto corner = [&](int k) { return piece.corners[size_t(std::min(k, piece.corner_count - 1))]; };
    texels.emplace_back(corner(0), corner(1));
    texels.emplace_back(corner(2), corner(3));
    for (int column = 0; column < 3; ++column) texels.emplace_back(set.rayFromImage(i)[column], 0.0);
  }
  pieces_ = gl::Buffer(std::span<const glm::vec4>(texels));
  bin_first_ = gl::Buffer(set.bin_first());
  bin_pieces_ = gl::Buffer(set.bin_pieces());
  piece_texels_ = gl::Texture::of_buffer(GL_RGBA32F, pieces_);
  bin_first_texels_ = gl::Texture::of_buffer(GL_R32UI, bin_first_);
  bin_pieces_texels_ = gl::Texture::of_buffer(GL_R32UI, bin_pieces_);
}

const gl::Program& ProgramCache::get(const std::vector<gl::Stage>& stages, const gl::Defines& defines) {
  std::string key;
  for (const gl::Stage& stage : stages) key += stage.file + ' ';
  for (const auto& [name, value] : defines) key += name + '=' + value + ' ';
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second;
  return programs_.emplace(key, gl::Program(stages, defines)).first->second;
}

}  // namespace omma
