// Places spread evenly over a pixel.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace omma {

/// The R2 sequence (Roberts 2018) in -0.5 to 0.5: any first n points are spread evenly, and the first is 0.
inline glm::dvec2 spread_point(int i) {
  return glm::fract(glm::dvec2(0.5) + double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532)) - 0.5;
}

}  // namespace omma
