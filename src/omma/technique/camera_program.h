// A camera's side of a program: the symbols that choose its lens and the uniforms that set it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "omma/gl/objects.h"
#include "omma/gl/program.h"
#include "omma/technique/view.h"

namespace omma {

/// LENS, LENS_PROJECT, LENS_UNPROJECT, or RAY_MAP. Matches shaders/common/camera.glsl.
gl::Defines camera_defines(const Camera& camera);

/// Sets the camera and the view's tile. A ray map's texture is bound by RayMapTexture.
void set_camera(const gl::Program& program, const View& view);

/// Keeps the ray map of the last camera, for pieces the rays of their pixels' centres, on the GPU and binds it to unit
/// 8; does nothing for a lens.
class RayMapTexture {
 public:
  void bind(const Camera& camera);

 private:
  std::optional<Camera> camera_;  ///< kept alive: another map may not come to lie at its address
  gl::Texture texture_;
};

/// Programs by what they are made of. Compiling takes longer than a frame; nothing is compiled twice.
class ProgramCache {
 public:
  const gl::Program& get(const std::vector<gl::Stage>& stages, const gl::Defines& defines);

 private:
  std::map<std::string, gl::Program> programs_;
};

}  // namespace omma
