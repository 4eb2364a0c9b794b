#include "view.h"

#include <algorithm>
#include <filesystem>

#include "omma/base/error.h"
#include "omma/camera/pose_file.h"
#include "omma/math/pose.h"

namespace omma::tool {
namespace {

constexpr double longest_time = 1e9;  // seconds, some thirty years
constexpr int most_frames = 10'000'000;

std::optional<glm::dvec3> optional_vector3(std::string_view option, const Text& text) {
  if (!text) return std::nullopt;
  return vector3_of(option, *text);
}

std::optional<double> optional_time(const Text& text) {
  if (!text) return std::nullopt;
  return number_of("--time", *text, -longest_time, longest_time);
}

/// Camera nodes of a glTF file as poses; everything else is a file of poses.
std::vector<NamedPose> poses_of(const std::string& file, const ReadOptions& reading) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension != ".gltf" && extension != ".glb") return load_poses(file, reading.limits);
  std::vector<NamedPose> poses;
  for (const SceneCamera& camera : load_scene_file(file, reading).cameras) {
    poses.push_back({camera.name, camera.worldFromCamera, std::nullopt});
  }
  if (poses.empty()) throw InputError("{}: has no camera node to take a pose from", file);
  return poses;
}

std::string text_of(const glm::dvec3& v) { return fmt::format("{:.6g},{:.6g},{:.6g}", v.x, v.y, v.z); }

}  // namespace

View::View(const ViewOptions& options, const ReadOptions& reading)
    : from_(optional_vector3("--from", options.from)),
      to_(optional_vector3("--to", options.to)),
      up_(optional_vector3("--up", options.up)),
      animation_(options.animation.value_or("")),
      names_time_(options.time || options.frames) {
  if (options.pose && !from_scene()) {
    throw CommandError("--pose and --from, --to, --up all say where the camera stands; give one or the other");
  }
  if (from_ && to_ && *from_ == *to_) throw CommandError("--from and --to are the same point; there is no direction");
  if (up_ && glm::length(*up_) == 0.0) throw CommandError("--up is zero; 0,1,0 is usual");
  if (options.fps && !options.frames) throw CommandError("--fps says nothing without --frames");
  if (options.pose && options.frames) {
    throw CommandError("--pose and --frames both say how many pictures there are; give one of them");
  }
  if (options.pose) {
    set_frames_from_poses(*options.pose, options.time, reading);
  } else {
    set_frames_from_time(options);
  }
}

void View::set_frames_from_poses(const std::string& file, const Text& time, const ReadOptions& reading) {
  const std::vector<NamedPose> poses = poses_of(file, reading);
  const std::optional<double> fixed_time = optional_time(time);
  const double begin = poses.front().time.value_or(0.0);
  for (const NamedPose& pose : poses) {
    Frame frame{static_cast<int>(frames_.size()), pose.worldFromCamera, fixed_time};
    // Recordings count seconds from some distant day; the animation begins with the first pose.
    if (!frame.time && pose.time) frame.time = *pose.time - begin;
    frames_.push_back(frame);
  }
  sequence_ = frames_.size() > 1;
}

void View::set_frames_from_time(const ViewOptions& options) {
  const std::optional<double> time = optional_time(options.time);
  if (!options.frames) {
    frames_.push_back({0, std::nullopt, time});
    return;
  }
  const int count = count_of("--frames", *options.frames, 1, most_frames);
  const double fps = options.fps ? number_of("--fps", *options.fps, 1e-3, 1e6) : 30.0;
  for (int i = 0; i < count; ++i) frames_.push_back({i, std::nullopt, time.value_or(0.0) + i / fps});
  sequence_ = true;
}

std::optional<double> View::time_of(const Scene& scene, const Frame& frame) const {
  if (animation_.empty() && (!frame.time || scene.animations.empty())) return std::nullopt;
  return frame.time.value_or(0.0);
}

bool View::needs_default(const Scene& scene) const {
  if (frames_.front().worldFromCamera || (from_ && to_)) return false;
  return !from_scene() || scene.cameras.empty();
}

void View::stand(Scene& scene, const Camera& camera) {
  // As the animation begins: a picture of one time shows what the same frame of a sequence does.
  Frame begin = frames_.front();
  if (begin.time) begin.time = 0.0;
  if (const auto time = time_of(scene, begin)) set_time(scene, *time, animation_);
  if (needs_default(scene)) default_ = default_viewpoint(scene, camera);
}

glm::dmat4 View::worldFromCamera(const Scene& scene, const Frame& frame) const {
  if (frame.worldFromCamera) return *frame.worldFromCamera;
  if (from_scene() && !scene.cameras.empty()) return scene.cameras.front().worldFromCamera;
  const glm::dvec3 from = from_.value_or(default_.from), to = to_.value_or(default_.to);
  if (from == to) {
    throw CommandError("the view goes from {} to the same point; give both --from and --to", text_of(from));
  }
  return look_at_worldFromCamera(from, to, up_.value_or(glm::dvec3(0.0, 1.0, 0.0)));
}

std::string View::unspoken_choice(const Scene& scene) const {
  if (frames_.front().worldFromCamera || (from_ && to_)) return {};
  if (!needs_default(scene)) return fmt::format("view: the scene's camera '{}'", scene.cameras.front().name);
  return fmt::format("view: --from {} --to {}{}", text_of(from_.value_or(default_.from)),
                     text_of(to_.value_or(default_.to)),
                     from_scene() ? " (the scene's default)" : " (what is not given is the scene's default)");
}

}  // namespace omma::tool
