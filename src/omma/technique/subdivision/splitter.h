// The passes of adaptive subdivision (Lorenz, Döllner 2008; general pinhole camera, section 4.2.2): transform feedback
// takes triangles from one buffer to the other, in parts, until no edge is to be split. What is done leaves the round.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "omma/technique/subdivision/lens_field.h"
#include "omma/technique/subdivision/record_list.h"
#include "omma/technique/subdivision/scene_pixels.h"
#include "omma/technique/subdivision/scene_triangle.h"

namespace omma {

/// Triangles that are drawn with one program and one set of textures.
struct SplitGroup {
  int material = 0;
  bool mirrored = false, blended = false;
  GLsizei first_part = 0, part_count = 0;  ///< in the order of the commands
  friend bool operator==(const SplitGroup&, const SplitGroup&) = default;
};

class Splitter {
 public:
  /// Halving ends where edges are straight, or too short for any sample, after 20 or so; no picture takes longer.
  static constexpr int most_passes = 40;

  Splitter(DrawTools& tools, const ScenePixels& pixels, SplitForm form);

  /// The scene's opaque triangles, and the blended ones where `blended`.
  void split(const View& view, const LensField& field, double tolerance_px, bool blended);
  /// Takes over transforms that are mirrored now.
  void scene_changed();

  const std::vector<SplitGroup>& groups() const { return groups_; }
  /// Three for each triangle, those of a group's parts one after another; equal where it is not drawn as it is.
  const gl::Buffer& plain_indices() const { return plain_; }
  /// Draws what is drawn as it is, by `plain_indices`; the scene's vertices are bound.
  void draw_plain(size_t group) const;
  /// Edges are straight, or have to be halved as often as each record says.
  const RecordList& straight() const { return straight_; }
  const RecordList& border() const { return border_; }

  int passes() const { return passes_; }        ///< that the last picture took
  int overflows() const { return overflows_; }  ///< passes in it that were repeated with larger buffers
  size_t bytes() const;

 private:
  void sort_parts();
  void first_pass(bool blended);
  void next_pass();
  /// Draws each of `groups` and adds what comes out to the lists, as often as it takes for these to be large enough.
  void capture(std::span<const size_t> groups, const std::function<void(size_t group)>& draw);

  DrawTools& tools_;
  const ScenePixels& pixels_;
  SplitForm form_;
  std::vector<SplitGroup> groups_;
  gl::Buffer plain_, part_records_, point_commands_, plain_commands_;
  gl::VertexArray part_array_, record_array_;
  RecordList straight_, border_;
  std::array<RecordList, 2> next_;
  int passes_ = 0, overflows_ = 0;
};

}  // namespace omma
