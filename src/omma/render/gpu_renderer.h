// A scene on the GPU and the techniques that draw it: pictures in tiles and passes, as large and as often sampled as
// asked for, whatever the driver's limits.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "omma/render/device_parts.h"
#include "omma/technique/reflection/reflection_maps.h"
#include "omma/technique/registry.h"
#include "omma/technique/shadow/shadow_maps.h"
#include "omma/technique/technique.h"

namespace omma {

class GpuRenderer {
 public:
  /// Uploads the scene of the index, which must outlive this object, as the device must. The device's context is
  /// current here, in every other call, and when this object goes.
  GpuRenderer(GlDevice& device, const LazySceneIndex& index);
  GpuRenderer(const GpuRenderer&) = delete;
  GpuRenderer& operator=(const GpuRenderer&) = delete;

  /// The scene has changed so, and the index with it.
  void update(const SceneChanges& changes);

  /// As PreparedScene::render; `options` have been checked.
  std::map<Channel, Image> render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                  std::span<const Channel> wanted, const RenderOptions& options,
                                  const ChosenTechnique& chosen, RenderStats& stats);

 private:
  struct Passes;

  Technique& technique_for(const ChosenTechnique& chosen);
  const Target& target_for(ImageSize size, std::span<const Channel> outputs);
  /// Milliseconds that all stages of `draw` took.
  double timed(const std::function<void()>& draw);
  Image draw_color(Technique& technique, View view, const Passes& passes, bool show_pieces,
                   const std::stop_token& stop);
  void draw_piece_borders(const Technique& technique, const View& view, const Target& picture);
  void draw_channels(Technique& technique, View view, std::map<Channel, Image>& pictures);

  GlDevice& device_;
  GpuScene gpu_scene_;
  DrawTools tools_;
  std::map<std::string, std::unique_ptr<Technique>> techniques_;
  std::unique_ptr<ShadowMaps> shadow_maps_;
  std::unique_ptr<ReflectionMaps> reflection_maps_;
  Target target_;
};

}  // namespace omma
