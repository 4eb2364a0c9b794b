// A placed scene on the GPU: bodies as groups of sixteen clusters of sixteen triangles. Vertices are those of GpuScene.
#pragma once

#include <cstdint>
#include <span>

#include "omma/gl/objects.h"
#include "omma/technique/gpu_scene.h"
#include "omma/visibility/placed_scene.h"

namespace omma {

class GpuBodies {
 public:
  /// Both must outlive this object. Throws MachineError when the driver's buffers are too small.
  GpuBodies(const GpuScene& gpu_scene, const SceneIndex& index, const gl::Limits& limits);

  /// Takes over bodies whose vertices have moved. Call place afterwards.
  void update();
  /// Takes over where the scene's bodies lie, seen from one view.
  void place(const PlacedScene& seen);

  /// Texture units 5 to 7, 9, 20 to 23, 25 and 26; triangles' numbers on 24.
  void bind() const;

  /// Groups, each as often as its body is placed.
  uint32_t placed_group_count() const { return placed_group_count_; }
  /// Some surfaces do not cover all of their triangles.
  bool has_holes() const { return has_holes_; }
  size_t bytes() const {
    return placements_.bytes() + placed_groups_.bytes() + groups_.bytes() + clusters_.bytes() + triangles_.bytes() +
           parts_.bytes() + alphas_.bytes();
  }

 private:
  /// Two texels, as in shaders/technique/visibility/bodies.glsl.
  struct BoxRecord {
    glm::vec3 centre;
    uint32_t first;
    glm::vec3 half;
    uint32_t count;
  };
  void upload_alphas();
  void check(size_t texels, const char* of_what) const;

  const GpuScene& gpu_scene_;
  const SceneIndex& index_;
  size_t most_texels_;
  std::vector<uint32_t> first_group_;  ///< of each of the scene's shapes, and the number of all
  std::vector<uint32_t> first_alpha_;  ///< of each texture
  uint32_t placed_group_count_ = 0;
  bool has_holes_ = false;
  gl::Texels placements_{GL_RGBA32UI}, placed_groups_{GL_RG32UI}, groups_{GL_RGBA32UI}, clusters_{GL_RGBA32UI};
  gl::Texels triangles_{GL_R32UI}, parts_{GL_RGBA32UI}, alphas_{GL_R8};
};

}  // namespace omma
