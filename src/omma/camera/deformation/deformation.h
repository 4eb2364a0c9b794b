// Cameras without a lens's formula in Omma: typed formulae, tables, camera textures, warp meshes. Each becomes a ray
// map of the image's size when it is made, so that every technique for ray maps draws it. docs/deformations.md shows
// their texts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "omma/base/limits.h"
#include "omma/base/names.h"
#include "omma/camera/camera.h"

namespace omma {

struct DeformationInfo {
  const char* name;
  const char* description;  ///< one line
  const char* example;
  Camera (*make)(const Spec& spec, std::optional<ImageSize> size, const Limits& limits);
};

std::span<const DeformationInfo> deformations();

/// Null when none has this name.
const DeformationInfo* find_deformation(std::string_view name);

/// Whether the text is of a camera that changes with the frame: a camera texture whose file has a number pattern such
/// as %04d and that names no frame.
bool changes_with_frame(std::string_view camera_text);

/// The text for that frame.
std::string text_of_frame(std::string_view camera_text, int frame);

// All take the text taken apart and the size asked for, and throw CommandError for the text and InputError for a file.

/// `expression:r=…`, `theta=…`, `longitude=…,latitude=…` or `x=…,y=…,z=…`; or `file=` with a line for each.
Camera make_expression_camera(const Spec& spec, std::optional<ImageSize> size, const Limits& limits);
/// `table:file=…`: two columns, the angle from the axis in degrees and the radius in the image.
Camera make_table_camera(const Spec& spec, std::optional<ImageSize> size, const Limits& limits);
/// `camera_texture:file=…,base=…`: an image of offsets.
Camera make_camera_texture(const Spec& spec, std::optional<ImageSize> size, const Limits& limits);
/// `warp_mesh:file=…,base=…`: a mesh of Paul Bourke's format, of Wavefront OBJ, or a PFM.
Camera make_warp_mesh_camera(const Spec& spec, std::optional<ImageSize> size, const Limits& limits);

}  // namespace omma
