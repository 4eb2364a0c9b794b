// Where the camera stands in each picture, and at what time: from --from/--to/--up, --pose, --time, --frames, or the
// scene itself.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "arguments.h"
#include "omma/camera/camera.h"
#include "omma/scene/scene.h"
#include "omma/viewpoint/viewpoint.h"

namespace omma::tool {

/// As typed.
struct ViewOptions {
  Text from, to, up, pose, time, animation, frames, fps;
};

struct Frame {
  int number = 0;                             ///< in output names, from 0
  std::optional<glm::dmat4> worldFromCamera;  ///< nothing: the view's own
  std::optional<double> time;                 ///< seconds of the scene's animation; nothing: as the file has it
};

class View {
 public:
  /// Reads a pose file, if one is named. Throws CommandError for options that make no sense or contradict each other,
  /// InputError for the pose file.
  View(const ViewOptions& options, const ReadOptions& reading);

  /// At least one.
  const std::vector<Frame>& frames() const { return frames_; }
  /// Numbered pictures: --frames, or a list of more than one pose.
  bool is_sequence() const { return sequence_; }
  /// The command says at what time the scene is to be shown.
  bool names_time() const { return names_time_; }

  /// What the scene's clock shows in a frame, of which of its animations; nothing where none moves it.
  std::optional<double> time_of(const Scene& scene, const Frame& frame) const;
  const std::string& animation() const { return animation_; }
  /// Chooses where to stand when the command does not say: for all frames where one would as the animation
  /// begins, at which the scene is left.
  void stand(Scene& scene, const Camera& camera);
  /// The pose of a frame in a scene that is at the frame's time. Throws CommandError when there is none.
  glm::dmat4 worldFromCamera(const Scene& scene, const Frame& frame) const;
  /// Where the view of this scene comes from, when the command did not say; empty when it did.
  std::string unspoken_choice(const Scene& scene) const;

 private:
  void set_frames_from_poses(const std::string& file, const Text& time, const ReadOptions& reading);
  void set_frames_from_time(const ViewOptions& options);
  bool needs_default(const Scene& scene) const;
  bool from_scene() const { return !from_ && !to_ && !up_; }

  std::optional<glm::dvec3> from_, to_, up_;
  Viewpoint default_;
  std::string animation_;
  std::vector<Frame> frames_;
  bool sequence_ = false;
  bool names_time_ = false;
};

}  // namespace omma::tool
