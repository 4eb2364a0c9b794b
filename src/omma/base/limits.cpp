#include "omma/base/limits.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {
namespace {

constexpr size_t most = size_t{1} << 40;

constexpr LimitInfo infos[] = {
    {"file_bytes", "bytes of a file", &Limits::file_bytes, most},
    {"document_bytes", "bytes of a calibration file", &Limits::document_bytes, most},
    {"document_values", "values and keys of a calibration file", &Limits::document_values, most},
    {"document_depth", "maps and lists of a calibration file or a .gltf within each other", &Limits::document_depth,
     256},
    {"picture_pixels", "pixels of a picture, of a ray map, of the image of a deformed camera", &Limits::picture_pixels,
     most},
    {"warp_nodes", "nodes of a warp mesh, pixels of a camera texture", &Limits::warp_nodes, size_t{1} << 31},
    {"poses", "poses of a list", &Limits::poses, most},
    {"scene_texels", "texels of all textures of a scene", &Limits::scene_texels, most},
    {"scene_vertices", "vertices of all meshes and morph targets of a scene", &Limits::scene_vertices, most},
    {"scene_triangles", "triangles over all instances of a scene", &Limits::scene_triangles, 2147483647},
    {"scene_instances", "meshes that the nodes of a scene place", &Limits::scene_instances, 2147483647},
};

}  // namespace

std::span<const LimitInfo> limit_infos() { return infos; }

std::string limit_text(const Limits& limits, size_t Limits::*limit) {
  const LimitInfo& info = *std::ranges::find(infos, limit, &LimitInfo::value);
  const size_t value = limits.*limit;
  if (value >= info.most) return fmt::format("the limit '{}' is {}, the most there can be", info.name, value);
  return fmt::format("the limit '{}' is {}; --limit {}=N, or omma::Limits, raises it", info.name, value, info.name);
}

void set_limit(Limits& limits, std::string_view text) {
  const std::string_view name = text.substr(0, text.find('='));
  std::vector<std::string> names;
  for (const LimitInfo& info : infos) names.emplace_back(info.name);
  const auto* const info = std::ranges::find(infos, name, &LimitInfo::name);
  if (info == std::end(infos)) throw CommandError("{}", unknown_name("limit", name, names));
  if (name.size() == text.size()) throw CommandError("limit {}: NAME=N is expected, {}", name, info->what);
  const long value = parse_integer(info->name, text.substr(name.size() + 1));
  if (value < 1 || static_cast<size_t>(value) > info->most) {
    throw CommandError("limit {}={}: 1 to {} is accepted, {}", name, value, info->most, info->what);
  }
  limits.*(info->value) = static_cast<size_t>(value);
}

}  // namespace omma
