// The one door to drawing: a scene, prepared once, looked at by any number of cameras; channels come out.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/render/device.h"
#include "omma/render/shot.h"
#include "omma/scene/edit.h"
#include "omma/scene/scene.h"
#include "omma/technique/picture.h"

namespace omma {

/// What follows from a scene alone: its triangles sorted, its textures and vertices where they are drawn from. Each is
/// made when the first picture needs it. No view changes it, so several threads may draw at once, each its own
/// pictures; those are what they would be one after another. Changes wait until the pictures that are being drawn are
/// done, and pictures that are asked for later wait for the changes.
class PreparedScene {
 public:
  /// Takes the scene over, finished as by finish_scene.
  PreparedScene(const Device& device, Scene scene);
  ~PreparedScene();
  PreparedScene(PreparedScene&&) noexcept;
  PreparedScene& operator=(PreparedScene&&) noexcept;

  /// Not to be read while another thread edits it.
  const Scene& scene() const;

  /// Changes the scene as `change` says, all of it at once: no picture has a part of it. What `change` throws comes
  /// out; what it did before that is done. It must not draw.
  void edit(const std::function<void(SceneEdit&)>& change);
  void set_time(double seconds, std::string_view animation = {}) {
    edit([&](SceneEdit& scene) { scene.set_time(seconds, animation); });
  }

  /// Draws into the memory of the outputs. `worldFromCamera` is rigid. `visibility:cpu` opens no OpenGL but to show
  /// pieces; for colour, `auto` opens it to see whether there is a GPU. Throws CommandError for outputs that
  /// omma::check refuses, before anything is written, and for options that make no sense or do not go together,
  /// MachineError for what this driver cannot do, and Cancelled when options.stop says so. After these what is in the
  /// memory is good for nothing.
  void render(const Shot& shot, const RenderOptions& options, RenderStats* stats = nullptr) const;
  /// All cameras of a rig, or both eyes, of the scene at one moment: what they have in common is made once, and where
  /// the processor draws they are drawn beside each other. `stats`, if there, becomes one for each shot.
  void render(std::span<const Shot> shots, const RenderOptions& options,
              std::vector<RenderStats>* stats = nullptr) const;
  /// The image of every channel asked for.
  std::map<Channel, Image> render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                  std::span<const Channel> wanted, const RenderOptions& options,
                                  RenderStats* stats = nullptr) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace omma
