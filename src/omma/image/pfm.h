// Portable float maps: one or three 32-bit floats a pixel, rows from the bottom.
// Format: https://www.pauldebevec.com/Research/HDR/PFM/
#pragma once

#include <filesystem>

#include "omma/base/limits.h"
#include "omma/image/image.h"

namespace omma {

/// Either byte order. The scale factor of the header is not applied. Throws InputError for a file that is no whole PFM
/// and for one beyond the limits.
FloatImage read_pfm(const std::filesystem::path& path, const Limits& limits = {});

/// Little-endian; `image` has one or three components.
void write_pfm(const std::filesystem::path& path, const FloatImage& image);

}  // namespace omma
