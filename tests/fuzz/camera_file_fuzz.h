// One fuzz target for all readers of calibration files. Any text gives cameras or an InputError; nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "omma/base/error.h"
#include "omma/camera/files/camera_file.h"
#include "omma/camera/files/format.h"

namespace omma {

/// Gives the text straight to one format's reader where that reader says it is its own.
inline void fuzz_format(const CameraFormat& format, std::string_view text) {
  try {
    const auto document = std::make_shared<const Document>(parse_document("fuzz", text));
    if (!format.recognises(*document)) return;
    size_t cameras = 0;
    for (const CameraFile::Entry& entry : format.read(document)) {
      // Thousands of cameras say no more than a few.
      if (++cameras > 8) break;
      try {
        entry.read();
      } catch (const InputError&) {
      }
    }
  } catch (const InputError&) {
  }
}

}  // namespace omma

#define OMMA_FUZZ_FORMAT(name)                                                           \
  extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {              \
    omma::fuzz_format(omma::name##_format, {reinterpret_cast<const char*>(data), size}); \
    return 0;                                                                            \
  }
