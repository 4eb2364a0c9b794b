// Triangles that cover an image without a gap, split until each shows what the camera shows.
//
// A triangle is split at an edge together with its neighbour there, and only where that edge is the one with the
// largest error of both (Rivara's longest edge bisection, with error for length). So triangles become long where the
// camera bends one way only, and neighbours always share whole edges: they see the same rays along them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "omma/camera/pieces/image_parts.h"

namespace omma {

/// The surface around the camera on which corners lie. Triangles between them show straight lines of the world
/// straight; which surface bends least as seen through the camera depends on the camera.
enum class CornerSurface { sphere, cylinder, plane };

class PieceMesh {
 public:
  /// Both outlive the mesh.
  PieceMesh(std::span<const ImagePart> parts, const SeenPixels& seen, CornerSurface surface);

  /// Splits triangles until the measured error of each is within the tolerance, or its edges are about a pixel long, or
  /// there are more than `most`. Returns whether there are not.
  bool refine(double tolerance_px, size_t most);
  /// Splits the longest edges until there are `count` triangles or a few more.
  void split_to(size_t count);

  size_t size() const { return alive_; }
  /// Without those that see nothing.
  std::vector<Piece> pieces() const;

 private:
  struct Triangle {
    std::array<uint32_t, 3> corners{};  ///< clockwise as seen
    uint32_t part = 0;
    bool alive = true, measured = false, finished = false;
    double error = 0.0;                  ///< pixels
    std::array<double, 3> edge_error{};  ///< of the edge that begins at each corner
  };
  struct Edge {
    std::array<uint32_t, 2> triangles{};
    int count = 0;
    double weight = 0.0;
  };

  enum class By { weight, length };

  static uint64_t key(uint32_t a, uint32_t b) { return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a; }
  glm::dvec3 corner_ray(const Triangle& triangle, size_t i) const;
  std::array<glm::dvec2, 3> pixels(const Triangle& triangle) const;
  double length(uint32_t a, uint32_t b) const;

  void add_triangle(const std::array<uint32_t, 3>& corners, uint32_t part);
  void remove_triangle(uint32_t index);
  void measure(Triangle& triangle, double tolerance_px) const;
  /// Those that are new, by error up to about the tolerance; without one their edges count by length.
  void measure_new(std::optional<double> tolerance_px);
  /// The heaviest edge; nothing when all are too short.
  std::optional<uint64_t> edge_to_split(const Triangle& triangle, By by) const;
  std::optional<uint32_t> neighbour_at(uint32_t index, uint64_t edge) const;
  /// Splits the triangle's heaviest edge or, where it is not its neighbour's too, one further on. False when it cannot.
  bool split(uint32_t index, By by);
  /// False where that would make a triangle less high.
  bool split_edge(uint32_t index, uint64_t edge, double least_height_px);
  void bisect(uint32_t index, uint64_t edge, uint32_t middle);

  std::span<const ImagePart> parts_;
  const SeenPixels& seen_;
  CornerSurface surface_;
  std::vector<glm::i64vec2> places_;
  std::vector<Triangle> triangles_;
  std::unordered_map<uint64_t, Edge> edges_;
  std::vector<uint32_t> unmeasured_;
  size_t alive_ = 0;
};

}  // namespace omma
