// Cameras that are measured: a direction for each pixel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "omma/base/error.h"
#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/image/npy.h"

namespace omma {

std::optional<glm::dvec3> RayMap::unproject(const glm::dvec2& pixel) const {
  const bool inside = pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x <= size.width && pixel.y <= size.height;
  if (!inside) return {};
  // The cell of four pixel centres that holds the point, or the nearest one to it.
  const int x = std::clamp(static_cast<int>(std::floor(pixel.x - 0.5)), 0, std::max(0, size.width - 2));
  const int y = std::clamp(static_cast<int>(std::floor(pixel.y - 0.5)), 0, std::max(0, size.height - 2));
  const double right = size.width > 1 ? pixel.x - 0.5 - x : 0.0;
  const double down = size.height > 1 ? pixel.y - 0.5 - y : 0.0;

  glm::dvec3 sum(0.0);
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner & 1, dy = corner >> 1;
    const double weight = (dx ? right : 1.0 - right) * (dy ? down : 1.0 - down);
    if (weight == 0.0) continue;
    const glm::dvec3 direction(directions[static_cast<size_t>(y + dy) * size.width + x + dx]);
    if (direction == glm::dvec3(0.0)) return {};
    sum += weight * direction;
  }
  const double length = glm::length(sum);
  if (!(length > 1e-6)) return {};  // opposite directions: none between them
  return sum / length;
}

RayMap load_ray_map(const std::filesystem::path& path, const Limits& limits) {
  const std::string name = path.string();
  const NpyArray<double> array = read_npy<double>(path, limits);
  if (array.shape.size() != 3 || array.shape[2] != 3) {
    throw InputError("{}: the array is ({}), a ray map is height x width x 3", name, fmt::join(array.shape, ", "));
  }
  for (const int axis : {0, 1}) {
    if (array.shape[axis] == 0 || array.shape[axis] > size_t{max_image_side}) {
      throw InputError("{}: {} of {} pixels, 1 to {} are accepted", name, axis == 0 ? "a height" : "a width",
                       array.shape[axis], max_image_side);
    }
  }
  const ImageSize size{static_cast<int>(array.shape[1]), static_cast<int>(array.shape[0])};
  if (const std::string why = size_refusal(size, limits); !why.empty()) throw InputError("{}: {}", name, why);

  RayMap map{
      .size = size, .directions = std::vector<glm::vec3>(array.values.size() / 3, glm::vec3(0.0F)), .source = name};
  bool any = false;
  for (size_t i = 0; i < map.directions.size(); ++i) {
    const glm::dvec3 direction(array.values[3 * i], array.values[3 * i + 1], array.values[3 * i + 2]);
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    const bool finite = std::isfinite(direction.x) && std::isfinite(direction.y) && std::isfinite(direction.z);
    if (!finite || largest == 0.0) continue;
    // Scaled so that squares neither overflow nor vanish.
    map.directions[i] = glm::vec3(glm::normalize(direction / largest));
    any = true;
  }
  if (!any) throw InputError("{}: no pixel has a ray: every direction is zero or not finite", name);
  return map;
}

}  // namespace omma
