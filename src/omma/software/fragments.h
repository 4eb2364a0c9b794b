// What is to be shaded in a square of 16 x 16 pixels, and how its pixels are made of it. However many samples a pixel
// has, a triangle it sees is one fragment: shaded once, where the samples that see it are on the average.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "omma/software/color_rows.h"
#include "omma/software/triangle_record.h"
#include "omma/visibility/finder.h"

namespace omma {

/// In the place of a material: rays that meet nothing.
inline constexpr int background_material = -1;

/// Fragments of one material, all of which reflect what surrounds their object or none does, in the arrays of
/// Fragments.
struct FragmentGroup {
  int material;
  bool reflects;
  uint32_t first,
      count;  ///< `first` is a multiple of 16; the arrays go on to the next multiple with copies of the last
};

class Fragments {
 public:
  /// Pixels are numbered as the rays of a block are: by leaves.
  static constexpr int pixels = RayBlock::leaves * 16;

  explicit Fragments(std::span<const RecordInstance> instances);

  /// Collects what the samples of a square see, blended surfaces in the order in which they lie behind each other.
  void collect(std::span<const FoundBlock> samples);

  std::span<const FragmentGroup> groups() const { return groups_; }
  /// Those collected so far that are no background.
  uint64_t surfaces() const { return surfaces_; }

  /// By fragment. Directions are those of the samples' rays on the average: not quite of unit length.
  std::vector<float> x, y, z;
  std::vector<uint32_t> record;  ///< a place in records()
  std::vector<int32_t> pixel;
  std::vector<float> red, green, blue, coverage;  ///< what shading them gave

  std::span<const TriangleRecord> records() const { return records_; }
  /// False where all vertices are white.
  bool has_colors() const { return has_colors_; }

  /// Adds a share of the shaded fragments to the pixels of a square at `corner`; `is_first`: to nothing.
  void resolve(float share, bool is_first, const ColorRows& to, glm::ivec2 corner) const;

 private:
  static constexpr uint32_t no_fragment = 0xffffffffu;

  /// A triangle's fragments differ in their places alone.
  struct Kind {
    uint32_t group = no_fragment, record = 0;
  };
  /// A fragment of a pixel whose samples see different things.
  struct Seen {
    uint32_t triangle;
    Kind kind;
    int32_t pixel;
    float samples;
    glm::vec3 direction;  ///< sum over its samples
    int next;             ///< another fragment of the pixel, or -1
    uint32_t place;
  };
  /// A sample of a pixel in front of which there are blended surfaces.
  struct Layers {
    int32_t pixel;
    int opaque;             ///< what is behind them, in seen_
    uint32_t first, count;  ///< in layer_
  };

  void compare_samples(std::span<const FoundBlock> samples);
  void collect_mixed(const FoundBlock& sample);
  int seen_of(int pixel, uint32_t triangle, uint32_t instance, const glm::vec3& direction);
  Kind kind_of(uint32_t triangle, uint32_t instance);
  uint32_t record_of(uint32_t triangle, uint32_t instance);
  void place();
  uint32_t put(const Kind& kind, int pixel, const glm::vec3& direction);

  std::span<const RecordInstance> instances_;
  bool has_colors_ = false;
  uint64_t surfaces_ = 0;
  size_t samples_ = 1;

  /// Pixels whose samples see one triangle, or the background.
  alignas(64) float direction_[3][pixels];
  alignas(64) uint32_t mixed_[pixels];  ///< zero where they do
  Kind kind_[pixels];
  uint32_t place_[pixels];  ///< of a fragment, or no_fragment

  /// All others.
  bool is_layered_[pixels];
  int first_seen_[pixels];  ///< in seen_, or -1
  std::vector<Seen> seen_;
  std::vector<Layers> layered_;
  std::vector<int> layer_;  ///< in seen_, nearest first

  std::vector<FragmentGroup> groups_;
  std::vector<TriangleRecord> records_;
  /// Where triangles' records are: open addressing; what is of an older square counts as empty.
  struct Slot {
    uint32_t triangle, record;
    uint32_t square = 0;
  };
  std::vector<Slot> table_;
  uint32_t square_ = 0;
};

}  // namespace omma
