// Materials on the GPU: their textures, their numbers, and the symbols that make a program theirs. The look itself is
// shaders/shading/material.glsl.
#pragma once

#include <vector>

#include "omma/gl/context.h"
#include "omma/gl/objects.h"
#include "omma/gl/program.h"
#include "omma/scene/scene.h"

namespace omma {

class Materials {
 public:
  Materials(const Scene& scene, const gl::Context& context);
  /// Takes over the numbers of materials, of new ones, too; their textures are those that the scene had before.
  void update();

  /// Symbols that shaders/shading expects for a material. `labels` is for channels that are not colour: there a blended
  /// material counts as solid where it covers at least half.
  gl::Defines defines(int material, bool anisotropic, bool labels) const;

  /// Binds textures 0-3 and uniform block 1.
  void bind(int material, bool anisotropic) const;

  size_t bytes() const { return bytes_; }

 private:
  const Scene* scene_;
  bool software_;
  std::vector<gl::Texture> textures_;
  std::vector<gl::Sampler> trilinear_, anisotropic_;  ///< one per texture, for its wrapping
  gl::Texture white_;
  gl::Buffer blocks_;
  size_t block_stride_ = 0;
  size_t bytes_ = 0;
};

}  // namespace omma
