#include "omma/visibility/channel_renderer.h"

#include <chrono>
#include <vector>

#include "omma/base/error.h"
#include "omma/camera/ray_bundle.h"
#include "omma/math/tiles.h"
#include "omma/visibility/seen_triangle.h"

namespace omma {
namespace {

Image make_image(const ChannelInfo& info, ImageSize size) {
  if (info.integer) return IntImage(size, info.components, int32_t(info.nothing));
  return FloatImage(size, info.components, info.nothing);
}

/// The pictures that are wanted, each under its name; null are those that are not.
struct Pictures {
  explicit Pictures(std::map<Channel, Image>& images) {
    const auto find = [&]<typename T>(Channel channel, T*& picture) {
      const auto found = images.find(channel);
      if (found != images.end()) picture = &std::get<T>(found->second);
    };
    find(Channel::distance, distance);
    find(Channel::z, z);
    find(Channel::normal, normal);
    find(Channel::position, position);
    find(Channel::uv, uv);
    find(Channel::id, id);
    find(Channel::object, object);
    find(Channel::material, material);
  }
  bool needs_point() const { return distance || z || normal || position || uv; }

  FloatImage *distance = nullptr, *z = nullptr, *normal = nullptr, *position = nullptr, *uv = nullptr;
  IntImage *id = nullptr, *object = nullptr, *material = nullptr;
};

/// Rays and their tree take some 26 bytes a pixel.
constexpr int usual_tile = 4096;

void put(const glm::dvec3& value, float* to) {
  for (int i = 0; i < 3; ++i) to[i] = float(value[i]);
}

/// Writes what the rays of blocks meet.
class BlockWriter {
 public:
  BlockWriter(const Scene& scene, const glm::dmat4& worldFromCamera, const PixelRect& tile, const Pictures& pictures)
      : worldFromCamera_(worldFromCamera), tile_(tile), pictures_(pictures) {
    const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
    instances_.reserve(scene.instances.size());
    for (const Instance& instance : scene.instances) instances_.emplace_back(scene, instance, cameraFromWorld);
  }

  void write(const RayBlock& block, const BlockPicture& picture) const {
    // Neighbours mostly see the same triangle.
    uint32_t last = meets_nothing;
    std::optional<SeenTriangle> triangle;
    for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
      for (int ray = 0; ray < 16; ++ray) {
        const uint32_t id = picture.triangle[leaf][ray];
        if (id == meets_nothing) continue;
        const int x = tile_.x0 + block.pixel_x + RayBlock::x_of(leaf, ray);
        const int y = tile_.y0 + block.pixel_y + RayBlock::y_of(leaf, ray);
        const SeenInstance& instance = instances_[picture.instance[leaf][ray]];
        if (pictures_.id) *pictures_.id->at(x, y) = int32_t(id);
        if (pictures_.object) *pictures_.object->at(x, y) = instance.object;
        if (pictures_.material) *pictures_.material->at(x, y) = instance.material;
        if (!pictures_.needs_point()) continue;
        if (id != last) triangle.emplace(instance, id);
        last = id;
        const glm::dvec3 direction(block.x[leaf][ray], block.y[leaf][ray], block.z[leaf][ray]);
        write(*triangle, direction, triangle->at(direction, 1.0 / picture.inverse_distance[leaf][ray]), x, y);
      }
    }
  }

 private:
  void write(const SeenTriangle& triangle, const glm::dvec3& direction, const SeenPoint& point, int x, int y) const {
    if (pictures_.distance) *pictures_.distance->at(x, y) = float(point.distance);
    if (pictures_.z) *pictures_.z->at(x, y) = float(-point.distance * direction.z);
    if (pictures_.normal) put(triangle.normal(point), pictures_.normal->at(x, y));
    if (pictures_.position) {
      put(worldFromCamera_ * glm::dvec4(point.distance * direction, 1.0), pictures_.position->at(x, y));
    }
    if (pictures_.uv) {
      const glm::vec2 uv(triangle.uv(point));
      pictures_.uv->at(x, y)[0] = uv.x;
      pictures_.uv->at(x, y)[1] = uv.y;
    }
  }

  std::vector<SeenInstance> instances_;
  glm::dmat4 worldFromCamera_;
  PixelRect tile_;
  Pictures pictures_;
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

const RayTree& ChannelRenderer::rays_of_tile(const Camera& camera, const PixelRect& tile) {
  if (camera_ != camera || tile_ != tile) {
    rays_ = RayTree(rays_of(camera, tile));
    camera_ = camera;
    tile_ = tile;
  }
  return rays_;
}

std::map<Channel, Image> ChannelRenderer::render(const Camera& camera, const glm::dmat4& worldFromCamera,
                                                 std::span<const Channel> wanted, int tile, ChannelStats* stats) {
  if (wanted.empty()) throw CommandError("no channel is asked for");
  if (tile < 0) throw CommandError("a tile of {} pixels; 1 or more make one", tile);
  ChannelStats took;
  std::map<Channel, Image> images;
  for (const Channel channel : wanted) {
    if (is_shaded(channel)) throw CommandError("colour needs OpenGL; Renderer draws it, ChannelRenderer all else");
    images.emplace(channel, make_image(channel_info(channel), camera.size()));
  }
  const Pictures pictures(images);
  auto begin = std::chrono::steady_clock::now();
  finder_.set_view(worldFromCamera);
  took.find_ms += milliseconds_since(begin);
  for (const PixelRect& part : tiles_of(camera.size(), tile > 0 ? tile : usual_tile)) {
    begin = std::chrono::steady_clock::now();
    const RayTree& rays = rays_of_tile(camera, part);
    took.rays_ms += milliseconds_since(begin);
    begin = std::chrono::steady_clock::now();
    const BlockWriter writer(*scene_, worldFromCamera, part, pictures);
    finder_.each_block(rays, Solid::labels,
                       [&](const RayBlock& block, const BlockPicture& picture) { writer.write(block, picture); });
    took.find_ms += milliseconds_since(begin);
    ++took.tiles;
  }
  took.bytes = finder_.bytes() + rays_.bytes();
  if (stats != nullptr) *stats = took;
  return images;
}

}  // namespace omma
