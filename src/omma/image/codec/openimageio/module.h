// What the module for OpenImageIO offers; rare.cpp loads it.
#pragma once

#include <string>
#include <string_view>

#include "omma/image/codec/pixels.h"

namespace omma {

/// Throws InputError saying why the picture cannot be read.
using OpenImageIODecode = void (*)(std::string_view bytes, const std::string& extension, const Accept& accept,
                                   Pixels& pixels);

#define OMMA_OPENIMAGEIO_DECODE "omma_openimageio_decode"

}  // namespace omma
