// The two cameras that are a picture warped: camera textures and warp meshes.
#include <algorithm>
#include <array>
#include <cmath>

#include "omma/base/error.h"
#include "omma/base/numbered_name.h"
#include "omma/camera/camera_parameters.h"
#include "omma/camera/deformation/deformation.h"
#include "omma/camera/deformation/warp.h"
#include "omma/image/formats.h"
#include "omma/image/srgb.h"

namespace omma {
namespace {

constexpr std::array texture_keys = {"file", "base", "strength", "frame"};
constexpr std::array mesh_keys = {"file", "base", "width", "height", "base_width", "base_height"};

// Back to what an 8-bit or 16-bit file holds, the middle of its numbers meaning no offset.
void decode_offsets(FloatImage& image) {
  bool eight_bits = true;
  for (float& value : image.values) {
    value = 255.0F * srgb_from_linear(value);
    eight_bits = eight_bits && std::abs(value - std::round(value)) < 1e-3F;
  }
  for (float& value : image.values) {
    value = eight_bits ? (std::round(value) - 128.0F) / 127.0F : (value * 257.0F - 32768.0F) / 32767.0F;
  }
}

FloatImage read_offsets(const std::string& path, const Limits& limits) {
  FloatImage image = read_vectors(path, limits);
  const ImageFormat format = find_image_format(path)->format;
  if (format == ImageFormat::png || format == ImageFormat::jpg) decode_offsets(image);
  return image;
}

std::string file_of(const DeformationText& text) {
  const std::string& file = text.value("file");
  if (!text.has("frame")) {
    if (has_number_pattern(file)) {
      throw CommandError("{} is missing: {} stands for a sequence of files", text.label("frame"), file);
    }
    return file;
  }
  const long frame = parse_integer(text.label("frame"), text.value("frame"));
  if (frame < 0 || frame > 999'999'999) throw CommandError("{}={}: no frame's number", text.label("frame"), frame);
  if (!has_number_pattern(file)) {
    throw CommandError("{} has no place: {} has no pattern such as %04d for it", text.label("frame"), file);
  }
  return numbered_name(file, static_cast<int>(frame));
}

}  // namespace

// Spindler, Bubke, Germer, Strothotte, "Camera Textures", GRAPHITE 2006; Lorenz and Döllner 2009, section 3.2: a point
// of the base image is moved by the offset found there. Each cell of the texture's grid is two triangles whose corners
// are moved, so that the way back from a pixel needs no search.
Camera make_camera_texture(const Spec& spec, std::optional<ImageSize> size, const Limits& limits) {
  const DeformationText text(spec, limits);
  const double strength = text.number_within("strength", -1e6, 1e6).value_or(1.0);
  const Camera base = base_camera(text, texture_keys, std::nullopt, size);
  const ImageSize own = text.own_size().value_or(base.size());
  const std::string file = file_of(text);
  const FloatImage offsets = read_offsets(file, limits);
  const WarpMesh mesh =
      texture_mesh(offsets.size, [&](const glm::dvec2& place, const glm::ivec2& texel, const glm::dvec2&) {
        const float* offset = offsets.at(texel.x, texel.y);
        return WarpNode{place + strength * glm::dvec2(offset[0], offset[1]), place};
      });
  const glm::dvec2 scale(static_cast<double>(base.size().width) / own.width,
                         static_cast<double>(base.size().height) / own.height);
  // A base with a size of its own, such as a ray map's file, takes none.
  const bool sized = find_lens_model(text.value("base")) || find_deformation(text.value("base"));
  return warped_camera(mesh, base, base.size(), file, sized ? source_text(spec, base.size(), scale) : spec_text(spec),
                       limits);
}

Camera make_warp_mesh_camera(const Spec& spec, std::optional<ImageSize> size, const Limits& limits) {
  const DeformationText text(spec, limits);
  const ImageSize own = text.own_size().value_or(size.value_or(default_image_size));
  const ImageSize wanted = size.value_or(own);
  if (wanted != own) image_scale(text.label("width"), own, wanted);
  const ImageSize base_size = text.own_size("base_").value_or(ImageSize{wanted.height, wanted.height});
  const std::string file = text.value("file");
  const Camera base = base_camera(text, mesh_keys, base_size, std::nullopt);
  const WarpMesh mesh = read_warp_mesh(file, static_cast<double>(wanted.width) / wanted.height, limits);
  Spec source = spec;
  source.values["width"] = std::to_string(wanted.width);
  source.values["height"] = std::to_string(wanted.height);
  source.values["base_width"] = std::to_string(base_size.width);
  source.values["base_height"] = std::to_string(base_size.height);
  return warped_camera(mesh, base, wanted, file, spec_text(source), limits);
}

bool changes_with_frame(std::string_view camera_text) {
  if (!camera_text.starts_with("camera_texture:")) return false;
  const Spec spec = parse_spec(camera_text);
  const auto file = spec.values.find("file");
  return file != spec.values.end() && !spec.values.contains("frame") && has_number_pattern(file->second);
}

std::string text_of_frame(std::string_view camera_text, int frame) {
  return fmt::format("{},frame={}", camera_text, frame);
}

}  // namespace omma
