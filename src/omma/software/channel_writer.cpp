#include "omma/software/channel_writer.h"

#include <optional>

namespace omma {
namespace {

void put(const glm::dvec3& value, float* to) {
  for (int i = 0; i < 3; ++i) to[i] = float(value[i]);
}

}  // namespace

ChannelWriter::ChannelWriter(std::span<const SeenInstance> instances, const glm::dmat4& worldFromCamera,
                             std::span<const Output> outputs, ImageSize size)
    : instances_(instances), worldFromCamera_(worldFromCamera) {
  const auto find = [&]<typename T>(Channel channel, PixelRows<T>& rows) {
    for (const Output& output : outputs) {
      if (output.channel == channel) rows = {output.to, size, pixel_bytes(output.to.format, channel_info(channel))};
    }
  };
  find(Channel::distance, distance_);
  find(Channel::z, z_);
  find(Channel::normal, normal_);
  find(Channel::position, position_);
  find(Channel::uv, uv_);
  find(Channel::id, id_);
  find(Channel::object, object_);
  find(Channel::material, material_);
}

void ChannelWriter::write(const RayBlock& block, const BlockPicture& picture) const {
  // Neighbours mostly see the same triangle.
  uint32_t last = meets_nothing;
  std::optional<SeenTriangle> triangle;
  for (int leaf = 0; leaf < RayBlock::leaves; ++leaf) {
    for (int ray = 0; ray < 16; ++ray) {
      const uint32_t id = picture.triangle[leaf][ray];
      if (id == meets_nothing) continue;
      const int x = block.pixel_x + RayBlock::x_of(leaf, ray);
      const int y = block.pixel_y + RayBlock::y_of(leaf, ray);
      const SeenInstance& instance = instances_[picture.instance[leaf][ray]];
      if (id_) *id_.at(x, y) = int32_t(id);
      if (object_) *object_.at(x, y) = instance.object;
      if (material_) *material_.at(x, y) = instance.material;
      if (!needs_point()) continue;
      if (id != last) triangle.emplace(instance, id);
      last = id;
      const glm::dvec3 direction(block.x[leaf][ray], block.y[leaf][ray], block.z[leaf][ray]);
      write(*triangle, direction, triangle->at(direction, 1.0 / picture.inverse_distance[leaf][ray]), x, y);
    }
  }
}

void ChannelWriter::write(const SeenTriangle& triangle, const glm::dvec3& direction, const SeenPoint& point, int x,
                          int y) const {
  if (distance_) *distance_.at(x, y) = float(point.distance);
  if (z_) *z_.at(x, y) = float(-point.distance * direction.z);
  if (normal_) put(triangle.normal(point), normal_.at(x, y));
  if (position_) put(worldFromCamera_ * glm::dvec4(point.distance * direction, 1.0), position_.at(x, y));
  if (uv_) {
    const glm::vec2 uv(triangle.uv(point));
    uv_.at(x, y)[0] = uv.x;
    uv_.at(x, y)[1] = uv.y;
  }
}

}  // namespace omma
