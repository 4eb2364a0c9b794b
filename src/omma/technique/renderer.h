// The one door to drawing: a scene, a camera and a pose go in, channels come out.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/scene/scene.h"
#include "omma/technique/picture.h"

namespace omma {

/// Every technique, in the order of the registry.
const std::vector<TechniqueInfo>& techniques();

/// Throws CommandError with the nearest name for an unknown technique or variant.
void check_technique(std::string_view technique);

class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// The scene must outlive the renderer or the next call of load.
  void load(const Scene& scene);
  /// Opens a GL context of its own and uploads the scene, if there is one; otherwise the first picture that is drawn
  /// with OpenGL does. Throws MachineError when there is no context to be had.
  void open_gl();
  /// Takes over what set_time changed: transforms, lights, deformed vertices.
  void update();

  /// The image of every channel asked for. `worldFromCamera` is rigid. `visibility:cpu` opens no OpenGL but to
  /// show pieces; for colour, `auto` opens it to see whether there is a GPU. Throws CommandError for options that make
  /// no sense or do not go together, MachineError for what this driver cannot do.
  std::map<Channel, Image> render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                  std::span<const Channel> wanted, const RenderOptions& options,
                                  RenderStats* stats = nullptr);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace omma
