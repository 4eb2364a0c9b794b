#include "omma/technique/reflection/reflection_maps.h"

#include <algorithm>

#include "omma/base/error.h"
#include "omma/shading/reflection_layers.h"
#include "omma/technique/registry.h"

namespace omma {
namespace {

constexpr Channel color[] = {Channel::color};

}  // namespace

void ReflectionMaps::use(const RenderOptions& options) {
  scene_.set_reflection(nullptr);
  if (!options.reflect) return;
  const Key key{*options.reflect, options.reflection_size, options.background, options.shadows, options.shadow_size};
  if (key_ != key) {
    key_.reset();
    draw(key);
    key_ = key;
  }
  scene_.set_reflection(&table_);
}

void ReflectionMaps::draw(const Key& key) {
  const gl::Limits& limits = tools_.context.limits();
  const int most = std::min(limits.texture_size, limits.viewport_size);
  if (key.size > most) {
    throw MachineError("a reflection map of {} texels is too large for this driver, which draws up to {}", key.size,
                       most);
  }
  const ImageSize size{key.size, key.size};
  const ReflectionLayers layers = plan_reflection_layers(scene_.scene(), key.object, key.size);
  if (!technique_) {
    const ChosenTechnique chosen = choose_technique("nonlinear", layers.camera);
    technique_ = chosen.entry->make(tools_, chosen.variant);
  }
  table_.maps = gl::Texture::array(gl_format(Channel::color), size, 2, layers.levels);
  table_.maps.filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  table_.object = key.object;
  table_.focal = float(layers.camera.lens()->focal.x);
  table_.size = float(key.size);
  table_.last_level = float(layers.levels - 1);
  if (!target_.fits(size, color, 1)) target_ = Target(size, color);
  scene_.set_hidden(key.object);
  for (int side = 0; side < 2; ++side) {
    scene_.set_view(layers.worldFromMap[side], key.background);
    const View view{.camera = layers.camera,
                    .worldFromCamera = layers.worldFromMap[side],
                    .tile = {0, 0, key.size, key.size},
                    .outputs = color,
                    .filter = Filter::trilinear};
    technique_->draw(view, target_);
    glCopyImageSubData(target_.image(Channel::color).id(), GL_TEXTURE_2D, 0, 0, 0, 0, table_.maps.id(),
                       GL_TEXTURE_2D_ARRAY, 0, 0, 0, side, key.size, key.size, 1);
  }
  scene_.set_hidden(std::nullopt);
  glGenerateTextureMipmap(table_.maps.id());
}

void ReflectionMaps::scene_changed(const SceneChanges& changes) {
  key_.reset();
  if (technique_ && changes.of_shape()) technique_->scene_changed(changes);
}

size_t ReflectionMaps::bytes() const {
  if (!technique_) return 0;
  const auto side = size_t(table_.size);
  return target_.bytes() + 2 * side * side * 8 * 4 / 3 + technique_->buffer_bytes();
}

}  // namespace omma
