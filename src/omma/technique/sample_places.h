// Where a driver's samples lie within a pixel.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <vector>

namespace omma {

/// Places are counted from the pixel's top left corner in parts of the pixel.
inline constexpr int sample_parts = 256;
inline constexpr std::array one_sample_place{glm::ivec2(sample_parts / 2)};

/// Asks the driver once for each number of samples. Of the thread with the context.
class SamplePlaces {
 public:
  /// As many as the driver gives for the asked number, at least as many. They stay where they are as long as this does.
  std::span<const glm::ivec2> of(int samples);

 private:
  std::map<int, std::vector<glm::ivec2>> known_;
};

}  // namespace omma
