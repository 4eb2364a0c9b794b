// Drawing without a prepared scene, for what pictures have no name for: depth alone, several cameras as one frame, a
// pipeline that stops half way.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "omma/technique/shadow/shadow_maps.h"
#include "omma/technique/technique.h"

namespace omma::bench {

/// What one camera adds to a frame.
struct Pass {
  Camera camera;
  glm::dmat4 worldFromCamera;
  std::string technique;  ///< `name:variant`
};

enum class Output { color, depth, coverage };  ///< coverage: one label a pixel, nothing shaded

struct Work {
  Output output = Output::color;
  bool rasterizes = true;  ///< false: what comes before the rasterizer alone
};

class DirectDrawing {
 public:
  /// Opens a GL context of its own. The scene must outlive this.
  explicit DirectDrawing(const Scene& scene);

  /// Draws the passes one after another, one sample a pixel, textures trilinear. Returns the milliseconds from the
  /// first command until the GPU is done. What techniques find once for a camera is found before the clock starts.
  /// `shadowed`: lights shine past paraboloid maps, which are drawn before the
  /// clock starts.
  double draw(std::span<const Pass> passes, const Work& work, bool shadowed = false);

  /// What bounding shapes of the passes cover, hidden or not; zeros of techniques that have none.
  BoundFragments bound_fragments(std::span<const Pass> passes);

 private:
  void draw_passes(std::span<const Pass> passes, const Work& work);
  Technique& technique(const Pass& pass);
  const Target& target(ImageSize size, Output output);

  gl::Context context_;
  GpuScene scene_;
  LazySceneIndex index_;
  ProgramCache programs_;
  DrawTools tools_;
  ShadowMaps shadows_;
  std::map<std::string, std::unique_ptr<Technique>> techniques_;
  std::vector<Pass> last_passes_;
  std::map<std::tuple<int, int, Output>, Target> targets_;
};

}  // namespace omma::bench
