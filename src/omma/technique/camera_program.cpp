#include "omma/technique/camera_program.h"

#include <algorithm>
#include <array>

#include "omma/camera/ray_bundle.h"

namespace omma {

gl::Defines camera_defines(const Camera& camera) {
  if (camera.lens() == nullptr) return {{"RAY_MAP", "1"}};
  const std::string name = camera.lens()->model->info.name;
  return {{"LENS", name}, {"LENS_PROJECT", name + "_project"}, {"LENS_UNPROJECT", name + "_unproject"}};
}

void set_camera(const gl::Program& program, const View& view) {
  program.set("pixel_offset", view.pixel_offset());
  const Lens* lens = view.camera.lens();
  if (lens == nullptr) return;
  std::array<float, LensParameters::max_count> k{};
  std::copy(lens->parameters.k.begin(), lens->parameters.k.end(), k.begin());
  program.set("lens_k", std::span<const float>(k));
  program.set("lens_max_angle", float(lens->parameters.max_angle));
  program.set("lens_focal", glm::vec2(lens->focal));
  program.set("lens_centre", glm::vec2(lens->centre));
}

void RayMapTexture::bind(const Camera& camera) {
  if (camera.lens() != nullptr) return;
  if (camera_ != camera) {
    const RayMap of_pieces = camera.pieces() ? rays_of(camera) : RayMap{};
    const RayMap* map = camera.pieces() ? &of_pieces : camera.ray_map();
    texture_ = gl::Texture::image(GL_RGBA32F, map->size);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture_.id(), 0, 0, 0, map->size.width, map->size.height, GL_RGB, GL_FLOAT,
                        map->directions.data());
    camera_ = camera;
  }
  texture_.bind(8);
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
