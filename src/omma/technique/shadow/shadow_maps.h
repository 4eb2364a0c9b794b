// Maps of what each light sees, drawn before the picture and kept while the scene stays as it is.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "omma/technique/technique.h"

namespace omma {

class ShadowMaps {
 public:
  /// `scene` is that of `tools`.
  ShadowMaps(DrawTools& tools, GpuScene& scene) : tools_(tools), scene_(scene) {}

  /// Hands the scene the maps of all its lights, which the next set_view takes over; draws those that are not there.
  /// Leaves the scene with a light's view. Throws MachineError where the driver has no such maps.
  void use(Shadows kind, int size);
  /// Lights or what they shine on have moved.
  void scene_changed(const SceneChanges& changes);
  size_t bytes() const;

 private:
  void draw(const ShadowLayer& layer, int number);
  Technique& technique_for(const Camera& camera);

  DrawTools& tools_;
  GpuScene& scene_;
  std::map<std::string, std::unique_ptr<Technique>>
      techniques_;  ///< apart from the picture's, whose caches they'd thrash
  Target target_;
  ShadowTable table_;
  Shadows kind_ = Shadows::off;
  int size_ = 0;
};

}  // namespace omma
