// The files that a rendering goes to: `-o city.png -o city.exr:distance`, `-o 'frame_%04d.png'`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/image/metadata.h"

namespace omma::tool {

struct OutputFile {
  std::string path;  ///< may hold one pattern such as %04d that stands for the frame's number
  Channel channel = Channel::color;

  bool has_pattern() const;
  std::filesystem::path path_of(int frame) const;
};

/// From the texts of -o. Throws CommandError for an unknown channel or format, a format that cannot hold the channel, a
/// folder that is missing, a file named twice, a pattern that is none.
std::vector<OutputFile> parse_outputs(const std::vector<std::string>& texts);

/// Where the picture of an equirectangular camera lies within the whole panorama. Nothing for other cameras, and for a
/// picture that reaches beyond the poles or the seam behind the camera.
std::optional<PanoramaPlace> panorama_place(const Camera& camera, const glm::dmat4& worldFromCamera);

}  // namespace omma::tool
