#include "omma/camera/deformation/deformed_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "omma/base/error.h"
#include "omma/camera/deformation/deformation.h"
#include "omma/image/image.h"

namespace omma {

void DeformationText::accept_only(std::span<const char* const> keys) const {
  const std::vector<std::string> names(keys.begin(), keys.end());
  for (const auto& [key, value] : spec_.values) {
    if (std::ranges::find(names, key) == names.end()) {
      throw CommandError("{}", unknown_name(spec_.name + " parameter", key, names));
    }
  }
}

const std::string& DeformationText::value(const std::string& key) const {
  if (!has(key) || spec_.values.at(key).empty()) {
    throw CommandError("{} is missing; for example {}", label(key), find_deformation(spec_.name)->example);
  }
  return spec_.values.at(key);
}

std::optional<double> DeformationText::number_within(const std::string& key, double low, double high) const {
  if (!has(key)) return {};
  const double number = parse_number(label(key), spec_.values.at(key));
  if (!(number >= low && number <= high)) {
    throw CommandError("{}={} is out of range; {} to {} is accepted", label(key), number, low, high);
  }
  return number;
}

std::optional<ImageSize> DeformationText::own_size(const std::string& prefix) const {
  const std::string width = prefix + "width", height = prefix + "height";
  if (has(width) != has(height)) {
    throw CommandError("{} is missing: {} and {} go together", label(has(width) ? height : width), width, height);
  }
  if (!has(width)) return {};
  const auto side = [&](const std::string& key) {
    return static_cast<int>(std::clamp(parse_integer(label(key), value(key)), -1L, max_image_side + 1L));
  };
  const ImageSize size{side(width), side(height)};
  check_image_size(spec_.name, size);
  return size;
}

std::string source_text(const Spec& spec, const ImageSize& size, const glm::dvec2& scale) {
  Spec scaled = spec;
  const auto multiply = [&](const char* key, double factor) {
    const auto found = scaled.values.find(key);
    if (found != scaled.values.end() && factor != 1.0) {
      found->second = fmt::format("{}", parse_number(key, found->second) * factor);
    }
  };
  // One focal length for both axes no longer says it when rounding to whole pixels has changed the shape.
  if (const auto f = scaled.values.extract("f"); !f.empty()) {
    scaled.values.emplace("fx", f.mapped());
    scaled.values.emplace("fy", f.mapped());
  }
  multiply("fx", scale.x);
  multiply("fy", scale.y);
  multiply("cx", scale.x);
  multiply("cy", scale.y);
  scaled.values["width"] = std::to_string(size.width);
  scaled.values["height"] = std::to_string(size.height);
  return spec_text(scaled);
}

void check_deformed_size(const ImageSize& size, const std::string& source, const Limits& limits) {
  if (const std::string why = size_refusal(size, limits); !why.empty()) {
    throw CommandError("{}: a ray is kept for each of {}", source, why);
  }
}

Camera deformed_camera(const ImageSize& size, const std::string& source, const Limits& limits,
                       const std::function<std::optional<glm::dvec3>(const glm::dvec2& pixel)>& direction) {
  check_deformed_size(size, source, limits);
  RayMap map{.size = size,
             .directions = std::vector<glm::vec3>(static_cast<size_t>(size.width) * size.height, glm::vec3(0.0F)),
             .source = source};
  tbb::parallel_for(0, size.height, [&](int y) {
    glm::vec3* row = map.directions.data() + static_cast<size_t>(y) * size.width;
    for (int x = 0; x < size.width; ++x) {
      const auto found = direction({x + 0.5, y + 0.5});
      if (!found) continue;
      const double largest = std::max({std::abs(found->x), std::abs(found->y), std::abs(found->z)});
      if (!(largest > 0.0) || !std::isfinite(found->x + found->y + found->z)) continue;
      // Scaled so that squares neither overflow nor vanish.
      row[x] = glm::vec3(glm::normalize(*found / largest));
    }
  });
  if (std::ranges::all_of(map.directions, [](const glm::vec3& ray) { return ray == glm::vec3(0.0F); })) {
    throw CommandError("{}: the camera sees nothing: no pixel has a ray", source);
  }
  return Camera(std::move(map));
}

}  // namespace omma
