// A way of drawing. Each has a folder of its own and one line in registry.cpp; none knows another.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "omma/gl/context.h"
#include "omma/gl/counters.h"
#include "omma/gl/timer.h"
#include "omma/technique/camera_program.h"
#include "omma/technique/gpu_scene.h"
#include "omma/technique/target.h"
#include "omma/technique/view.h"
#include "omma/visibility/scene_index.h"

namespace omma {

/// What every technique draws with.
struct DrawTools {
  const gl::Context& context;
  const GpuScene& scene;
  const LazySceneIndex& index;  ///< of the same scene
  ProgramCache& programs;
  CameraTextures camera_textures{};
  gl::StageTimer timer{context.software()};
  gl::Counters counters{};  ///< of what surfaces cost, full-screen passes apart
  gl::VertexArray no_vertices = gl::create_vertex_array();

  /// One triangle over the bound target with `program`.
  void draw_fullscreen(const gl::Program& program);

  /// Calls `draw` with `target`, or, where the view wants several samples, with a multisample image of the same kind
  /// that is then averaged into `target`.
  void multisampled(const View& view, const Target& target, const std::function<void(const Target&)>& draw);

  /// What makes a program draw surfaces of a material for a view: its channels, textures, effects and shadows.
  gl::Defines surface_defines(const View& view, int material) const;

  /// What the camera sees where the scene is not, and depth that keeps triangles off pixels without a ray.
  void draw_background(const View& view);

  /// The borders of the pieces of `camera`, over the bound target of the view's size.
  void draw_piece_borders(const View& view, const Camera& camera);

  Target multisample_target{};

 private:
  /// Pieces know their rays: cheaper than to look for each pixel's piece.
  void draw_background_in_pieces(const View& view);
};

class Technique {
 public:
  virtual ~Technique() = default;

  /// True when a colour pass may have as many samples per pixel as the driver has; false when it has one.
  virtual bool multisamples() const = 0;

  /// How many samples of a pixel, anywhere in it, a colour pass over so large a tile takes by itself (View::shifts).
  virtual size_t shifts_at_once(ImageSize) const { return 1; }

  /// True when it draws a view without outputs: the target's depth alone, near_depth over distance, or, for flat
  /// cameras, over distance ahead. Where the camera has no ray such a depth says nothing.
  virtual bool draws_depth() const { return false; }

  /// Draws into a target that holds view.outputs, is of the view's size and has one sample. Marks its stages in
  /// tools.timer.
  virtual void draw(const View& view, const Target& target) = 0;

  /// Instances have moved or vertices have: what was derived from them must be derived again. When parts of the scene
  /// come or go the technique is made anew.
  virtual void scene_changed(const SceneChanges&) {}

  /// What the last picture was made of, as a camera in the pieces form; null where there are no pieces.
  virtual const Camera* pieces() const { return nullptr; }

  /// Adds what only this technique knows of its last picture.
  virtual void report(RenderStats&) const {}

  /// On the GPU or beside it, beyond the scene and the target.
  virtual size_t buffer_bytes() const { return 0; }
};

struct TechniqueEntry {
  TechniqueInfo info;
  /// Throws CommandError or MachineError when this camera or this driver will not do.
  std::unique_ptr<Technique> (*make)(DrawTools& tools, const std::string& variant);
  /// Why this camera cannot be drawn, to go on after the technique's name; nothing where it can. Null: any can.
  std::optional<std::string> (*refusal)(const Camera& camera) = nullptr;
};

}  // namespace omma
