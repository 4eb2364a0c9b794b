// Reading the values of options.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "command_line.h"
#include "omma/math/ray.h"
#include "omma/technique/picture.h"

namespace omma::tool {

/// Each throws CommandError naming `option` and what is accepted.
double number_of(std::string_view option, const std::string& text, double min, double max);
int count_of(std::string_view option, const std::string& text, int min, int max);
glm::dvec2 vector2_of(std::string_view option, const std::string& text);
glm::dvec3 vector3_of(std::string_view option, const std::string& text);
/// `1600x1200`
ImageSize size_of(std::string_view option, const std::string& text);

/// `sky`, which is nothing, or linear `r,g,b`.
std::optional<glm::vec3> background_of(const std::string& text);
/// --shadows and --shadow-size.
void set_shadows(RenderOptions& options, const Text& kind, const Text& size);

}  // namespace omma::tool
