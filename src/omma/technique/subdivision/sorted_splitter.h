// Subdivision of blended triangles, which are drawn from back to front: what is done is passed through with the rest,
// so that each triangle's parts stay where it was in the order.
#pragma once

#include "omma/technique/subdivision/lens_field.h"
#include "omma/technique/subdivision/record_list.h"
#include "omma/technique/subdivision/scene_pixels.h"
#include "omma/technique/subdivision/scene_triangle.h"

namespace omma {

class SortedSplitter {
 public:
  /// `form`: of the other triangles, whose edges are then split where these are.
  SortedSplitter(DrawTools& tools, const ScenePixels& pixels, SplitForm form);

  void split(const View& view, const LensField& field, double tolerance_px);

  /// A run's group is the number of a part that its material and winding are those of.
  const RecordList& list() const { return lists_[0]; }
  size_t bytes() const { return lists_[0].bytes() + lists_[1].bytes(); }

 private:
  /// From the bound vertex array to the other list. True when something was split.
  bool pass(uint32_t count);
  void find_runs();

  DrawTools& tools_;
  const ScenePixels& pixels_;
  SplitForm form_;
  gl::VertexArray triangle_array_, record_array_;
  std::array<RecordList, 2> lists_;
};

}  // namespace omma
