#include "arguments.h"

#include <algorithm>
#include <vector>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/camera/camera.h"

namespace omma::tool {
namespace {

template <typename Vector>
Vector vector_of(std::string_view option, const std::string& text, std::string_view accepted) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != size_t(Vector::length())) {
    throw CommandError("{}: '{}' has {} numbers, {} is expected", option, text, parts.size(), accepted);
  }
  Vector vector;
  for (int i = 0; i < Vector::length(); ++i) vector[i] = parse_number(option, parts[size_t(i)]);
  return vector;
}

}  // namespace

double number_of(std::string_view option, const std::string& text, double min, double max) {
  const double value = parse_number(option, text);
  if (value < min || value > max) throw CommandError("{} {}: {} to {} is accepted", option, text, min, max);
  return value;
}

int count_of(std::string_view option, const std::string& text, int min, int max) {
  const long value = parse_integer(option, text);
  if (value < min || value > max) throw CommandError("{} {}: {} to {} is accepted", option, text, min, max);
  return static_cast<int>(value);
}

glm::dvec2 vector2_of(std::string_view option, const std::string& text) {
  return vector_of<glm::dvec2>(option, text, "x,y");
}

glm::dvec3 vector3_of(std::string_view option, const std::string& text) {
  return vector_of<glm::dvec3>(option, text, "x,y,z");
}

ImageSize size_of(std::string_view option, const std::string& text) {
  const std::vector<std::string> parts = split(text, 'x');
  if (parts.size() != 2) throw CommandError("{}: '{}' is no size; 1600x1200 would be one", option, text);
  const auto side = [&](const std::string& part) { return count_of(option, part, 1, max_image_side); };
  return {side(parts[0]), side(parts[1])};
}

std::optional<glm::vec3> background_of(const std::string& text) {
  if (text == "sky") return std::nullopt;
  if (text.find(',') == std::string::npos) {
    throw CommandError("--background '{}': sky, or linear r,g,b such as 0,0,0 is accepted", text);
  }
  const glm::dvec3 color = vector3_of("--background", text);
  if (glm::any(glm::lessThan(color, glm::dvec3(0.0)))) {
    throw CommandError("--background {}: light is not negative", text);
  }
  return glm::vec3(color);
}

void set_shadows(RenderOptions& options, const Text& kind, const Text& size) {
  if (kind) options.shadows = shadows_from_name(*kind);
  if (size) options.shadow_size = count_of("--shadow-size", *size, 16, max_image_side);
  if (size && options.shadows == Shadows::off) {
    throw CommandError("--shadow-size is the size of shadow maps; add --shadows paraboloid or --shadows cube");
  }
}

}  // namespace omma::tool
