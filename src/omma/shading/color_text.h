// Colours as people type them.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

namespace omma {

/// `black`, `ff8000` or `#ff8000` (sRGB) as linear light. Throws CommandError that begins with `what`.
glm::vec3 parse_color(std::string_view what, std::string_view text);

}  // namespace omma
