#include "outputs.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/base/numbered_name.h"
#include "omma/image/write.h"

namespace omma::tool {
namespace {

OutputFile parse_output(const std::string& text) {
  OutputFile output{text};
  const size_t colon = text.rfind(':');
  // A colon that is followed by a dot or a slash belongs to the file's name.
  if (colon != std::string::npos && text.find_first_of("./", colon) == std::string::npos) {
    output.path = text.substr(0, colon);
    output.channel = channel_from_name(text.substr(colon + 1));
  }
  if (output.path.empty()) throw CommandError("-o: '{}' names no file", text);
  check_image_output(output.path_of(0), output.channel);
  return output;
}

}  // namespace

bool OutputFile::has_pattern() const { return has_number_pattern(path); }

std::filesystem::path OutputFile::path_of(int frame) const { return numbered_name(path, frame); }

std::vector<OutputFile> parse_outputs(const std::vector<std::string>& texts) {
  std::vector<OutputFile> outputs;
  std::set<std::filesystem::path> paths;
  for (const std::string& text : texts) {
    outputs.push_back(parse_output(text));
    if (!paths.insert(std::filesystem::absolute(outputs.back().path).lexically_normal()).second) {
      throw CommandError("-o: '{}' is named twice; each channel needs a file of its own", outputs.back().path);
    }
  }
  return outputs;
}

std::optional<PanoramaPlace> panorama_place(const Camera& camera, const glm::dmat4& worldFromCamera) {
  const Lens* lens = camera.lens();
  if (!lens || lens->model != find_lens_model("equirectangular")) return std::nullopt;
  // The plane's unit is the radian: the sphere reaches half a turn left and right of the centre, a quarter up and down.
  const glm::dvec2 half = std::numbers::pi * glm::dvec2(lens->focal.x, 0.5 * lens->focal.y);
  const glm::dvec2 full = glm::round(2.0 * half), corner = glm::round(half - lens->centre);
  const bool inside = corner.x >= 0.0 && corner.y >= 0.0 && corner.x + lens->size.width <= full.x &&
                      corner.y + lens->size.height <= full.y && std::max(full.x, full.y) < 1e6;
  if (!inside) return std::nullopt;
  return PanoramaPlace{.full = {static_cast<int>(full.x), static_cast<int>(full.y)},
                       .left = static_cast<int>(corner.x),
                       .top = static_cast<int>(corner.y),
                       .pose = heading_of(glm::dmat3(worldFromCamera) * lens->cameraFromLens)};
}

}  // namespace omma::tool
