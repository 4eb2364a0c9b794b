#include "omma/technique/shadow/shadow_maps.h"

#include "omma/base/error.h"
#include "omma/scene/lights.h"
#include "omma/technique/registry.h"

namespace omma {

void ShadowMaps::use(Shadows kind, int size) {
  if (kind == Shadows::off) return scene_.set_shadows(nullptr);
  if (kind != kind_ || size != size_) {
    const gl::Limits& limits = tools_.context.limits();
    const int most = std::min(limits.texture_size, limits.viewport_size);
    if (size > most) {
      throw MachineError("a shadow map of {} texels is too large for this driver, which draws up to {}", size, most);
    }
    std::vector<ShadowLayer> layers =
        plan_shadow_layers(lights_of(scene_.scene()), boxes_of_triangles(scene_.scene()), kind, size);
    GLint most_layers = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_layers);
    if (layers.size() > size_t(most_layers)) {
      throw MachineError("{} shadow maps are too many for this driver, which has up to {}", layers.size(), most_layers);
    }
    table_.layers = std::move(layers);
    table_.maps = gl::Texture::array(depth_format, {size, size}, int(table_.layers.size()));
    target_ = Target({size, size}, {});
    kind_ = Shadows::off;  // until they are there
    size_ = size;
    // The scene's lights are lit, not shadowed, while their maps are drawn.
    scene_.set_shadows(nullptr);
    for (size_t i = 0; i < table_.layers.size(); ++i) draw(table_.layers[i], int(i));
    kind_ = kind;
  }
  scene_.set_shadows(&table_);
}

void ShadowMaps::draw(const ShadowLayer& layer, int number) {
  scene_.set_view(layer.worldFromMap, std::nullopt);
  const View view{.camera = layer.camera,
                  .worldFromCamera = layer.worldFromMap,
                  .tile = {0, 0, size_, size_},
                  .filter = Filter::trilinear};
  technique_for(layer.camera).draw(view, target_);
  glCopyImageSubData(target_.depth().id(), GL_TEXTURE_2D, 0, 0, 0, 0, table_.maps.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0,
                     number, size_, size_, 1);
}

Technique& ShadowMaps::technique_for(const Camera& camera) {
  const ChosenTechnique chosen = choose_depth_technique(camera);
  std::unique_ptr<Technique>& technique = techniques_[chosen.name()];
  if (!technique) technique = chosen.entry->make(tools_, chosen.variant);
  return *technique;
}

void ShadowMaps::scene_changed(const SceneChanges& changes) {
  kind_ = Shadows::off;
  if (!changes.of_shape()) return;
  for (auto& [name, technique] : techniques_) technique->scene_changed(changes);
}

size_t ShadowMaps::bytes() const {
  size_t bytes = target_.bytes() + table_.layers.size() * size_t(size_) * size_t(size_) * 4;
  for (const auto& [name, technique] : techniques_) bytes += technique->buffer_bytes();
  return bytes;
}

}  // namespace omma
