#include "omma/technique/reflection/reflection_maps.h"

#include <algorithm>
#include <bit>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/scene/object.h"
#include "omma/technique/registry.h"

namespace omma {
namespace {

/// Each map sees 20 degrees of the other's half of the world, so that blurred texels need not know what is beyond it.
constexpr const char* lens = "stereographic:fov_deg=220";
constexpr double rim = 1.0 / 1.4281480067;  ///< tan 45° over tan 55°: where its own half ends, of the map's half side
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
  const Bounds bounds = object_bounds(scene_.scene(), key.object);
  if (bounds.empty()) throw CommandError("the scene has no object {} that could reflect", key.object);
  const gl::Limits& limits = tools_.context.limits();
  const int most = std::min(limits.texture_size, limits.viewport_size);
  if (key.size > most) {
    throw MachineError("a reflection map of {} texels is too large for this driver, which draws up to {}", key.size,
                       most);
  }
  const ImageSize size{key.size, key.size};
  const Camera camera = make_camera(lens, size);
  if (!technique_) {
    const ChosenTechnique chosen = choose_technique("nonlinear", camera);
    technique_ = chosen.entry->make(tools_, chosen.variant);
  }
  // A texel of the smallest level is at most half as wide as what a map sees beyond its half.
  const double beyond = 0.5 * key.size * (1.0 - rim);
  const int levels = std::max(1, int(std::bit_width(unsigned(beyond))) - 1);
  table_.maps = gl::Texture::array(gl_format(Channel::color), size, 2, levels);
  table_.maps.filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  table_.object = key.object;
  table_.focal = float(camera.lens()->focal.x);
  table_.size = float(key.size);
  table_.last_level = float(levels - 1);
  if (!target_.fits(size, color, 1)) target_ = Target(size, color);
  scene_.set_hidden(key.object);
  for (int side = 0; side < 2; ++side) {
    glm::dmat4 worldFromMap = look_at_worldFromCamera(glm::dvec3(0.0), {0.0, 0.0, side == 0 ? -1.0 : 1.0});
    worldFromMap[3] = glm::dvec4(bounds.center(), 1.0);
    scene_.set_view(worldFromMap, key.background);
    const View view{.camera = camera,
                    .worldFromCamera = worldFromMap,
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

void ReflectionMaps::scene_changed() {
  key_.reset();
  if (technique_) technique_->scene_changed();
}

size_t ReflectionMaps::bytes() const {
  if (!technique_) return 0;
  const auto side = size_t(table_.size);
  return target_.bytes() + 2 * side * side * 8 * 4 / 3 + technique_->buffer_bytes();
}

}  // namespace omma
