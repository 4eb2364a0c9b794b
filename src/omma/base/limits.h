// How much one file may ask of the machine. What a file claims is not what it holds: readers compare it with these
// before they make room for it, and refuse with the limit's name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace omma {

/// Handed down to every reader; the defaults let through what cameras, scanners and artists make. docs/limits.md has
/// them for users.
struct Limits {
  /// Bytes of a file. A map of 8192 x 8192 rays in double precision has 1.5 GiB.
  size_t file_bytes = size_t{4} << 30;

  /// Bytes of a calibration file. Those with a pose for each of thousands of pictures have a few megabytes, a camera of
  /// a hundred thousand pieces thirty.
  size_t document_bytes = size_t{64} << 20;
  /// Values of a calibration file, keys among them, at 130 bytes each. A hundred thousand pieces have three million.
  size_t document_values = size_t{1} << 22;
  /// Maps and lists of a calibration file, and of a glTF file's JSON, within each other: parsers recurse.
  size_t document_depth = 32;

  /// Pixels of a picture, of a ray map, and of the image that a deformed camera is made for, at 1 to 29 bytes each:
  /// 32768 x 16384.
  size_t picture_pixels = size_t{1} << 29;
  /// Nodes of a warp mesh, pixels of a camera texture: 4096 x 4096.
  size_t warp_nodes = size_t{1} << 24;
  /// Poses of a list.
  size_t poses = size_t{1} << 20;

  /// Texels of all textures of a scene together, at 4 bytes each: sixteen of 8192 x 8192.
  size_t scene_texels = size_t{1} << 30;
  /// Vertices of all meshes of a scene, with those of morph targets, at 12 to 100 bytes each.
  size_t scene_vertices = size_t{1} << 28;
  /// Triangles over all instances of a scene; their numbers have 31 bits.
  size_t scene_triangles = 2147483647;
  /// Meshes that the nodes of a scene place.
  size_t scene_instances = size_t{1} << 22;
};

struct LimitInfo {
  const char* name;  ///< the member's
  const char* what;  ///< what is counted, in what unit
  size_t Limits::*value;
  size_t most;  ///< it cannot be raised beyond
};

/// Every member, in their order.
std::span<const LimitInfo> limit_infos();

/// "the limit 'poses' is 1048576; --limit poses=N, or omma::Limits, raises it": how messages end that refuse a file.
std::string limit_text(const Limits& limits, size_t Limits::*limit);

/// Sets the limit of a text such as `poses=5000000`. Throws CommandError for a name or number that is none.
void set_limit(Limits& limits, std::string_view text);

/// How a file that names other files is to be read.
struct ReadOptions {
  Limits limits;
  /// A file is read at the word of another only within the other's folder, and, where this is not empty, within this
  /// one too; links are followed first.
  std::filesystem::path root;
};

}  // namespace omma
