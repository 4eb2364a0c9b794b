// Reading images, by extension: what write.h writes comes back as it was, up to the format's precision.
#pragma once

#include <filesystem>

#include "omma/base/limits.h"
#include "omma/image/image.h"

namespace omma {

/// Colour from .png and .jpg is turned from sRGB into linear light; a 16-bit .png of one component holds numbers + 1
/// and becomes an IntImage, as does a file of whole numbers in .exr (32-bit) or .npy. Everything else is taken as it
/// is. Alpha is dropped, after a .png's numbers are multiplied by it. Throws CommandError for an extension that is no
/// image format, InputError for a file that is missing, broken or beyond the limits.
Image read_image(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace omma
