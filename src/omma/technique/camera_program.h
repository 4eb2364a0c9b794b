// A camera's side of a program: the symbols that choose its lens and the uniforms that set it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "omma/camera/bounds/lens_bound.h"
#include "omma/gl/objects.h"
#include "omma/gl/program.h"
#include "omma/technique/view.h"

namespace omma {

/// LENS, LENS_PROJECT and LENS_UNPROJECT, or RAY_MAP, or PIECE_CAMERA. Matches shaders/common/camera.glsl.
gl::Defines camera_defines(const Camera& camera);

/// Sets the camera and the view's tile. What is too large for uniforms is bound by CameraTextures.
void set_camera(const gl::Program& program, const View& view);

/// Sets `lens_bound`, which camera/bounds/bounding_shape.h takes.
void set_lens_bound(const gl::Program& program, const LensBound& bound);

/// Keeps the last camera's rays or pieces on the GPU and binds them, rays to unit 8, pieces to units 8, 12 and 13; does
/// nothing for a lens.
class CameraTextures {
 public:
  void bind(const Camera& camera);

 private:
  void upload(const RayMap& map);
  void upload(const PieceSet& pieces);

  std::optional<Camera> camera_;  ///< kept alive: another one may not come to lie at its address
  gl::Texture rays_;
  gl::Buffer pieces_, bin_first_, bin_pieces_;
  gl::Texture piece_texels_, bin_first_texels_, bin_pieces_texels_;
};

/// Programs by what they are made of. Compiling takes longer than a frame; nothing is compiled twice.
class ProgramCache {
 public:
  const gl::Program& get(const std::vector<gl::Stage>& stages, const gl::Defines& defines);

 private:
  std::map<std::string, gl::Program> programs_;
};

}  // namespace omma
