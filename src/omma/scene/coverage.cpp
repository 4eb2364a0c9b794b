#include "omma/scene/coverage.h"

#include <algorithm>

namespace omma {
namespace {

/// Bilinear, from the texture's finest level, wrapped as the texture says.
float sample_alpha(const Texture& texture, glm::vec2 uv) {
  const auto wrap = [](int i, int size, Texture::Wrap mode) {
    if (mode == Texture::Wrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = mode == Texture::Wrap::mirror ? 2 * size : size;
    const int inside = (i % period + period) % period;
    return inside < size ? inside : period - 1 - inside;
  };
  const glm::vec2 texel =
      glm::fract(glm::clamp(uv, -1e6f, 1e6f) * 0.5f) * 2.0f * glm::vec2(texture.width, texture.height) -
      0.5f;  // two periods: mirroring has two
  const glm::vec2 corner = glm::floor(texel), part = texel - corner;
  float alpha = 0.0f;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const int x = wrap(int(corner.x) + dx, texture.width, texture.wrap_u);
      const int y = wrap(int(corner.y) + dy, texture.height, texture.wrap_v);
      alpha += (dx ? part.x : 1.0f - part.x) * (dy ? part.y : 1.0f - part.y) *
               float(texture.texels[size_t(y) * size_t(texture.width) + size_t(x)].a);
    }
  }
  return alpha / 255.0f;
}

}  // namespace

float coverage(const Scene& scene, const Mesh& mesh, uint32_t triangle, float u, float v) {
  const Material& material = scene.materials[size_t(mesh.material)];
  const glm::uvec3 corner = mesh.triangles[triangle];
  const glm::vec3 weight(1.0f - u - v, u, v);
  float alpha = material.base_color.a;
  if (!mesh.colors.empty()) {
    alpha *=
        glm::dot(weight, glm::vec3(mesh.colors[corner.x].a, mesh.colors[corner.y].a, mesh.colors[corner.z].a)) / 255.0f;
  }
  if (material.base_color_texture < 0 || mesh.uvs.empty()) return alpha;
  const glm::vec2 uv = weight.x * mesh.uvs[corner.x] + weight.y * mesh.uvs[corner.y] + weight.z * mesh.uvs[corner.z];
  return alpha * sample_alpha(scene.textures[size_t(material.base_color_texture)], uv);
}

}  // namespace omma
