// What a file format says of itself. One file a format, one line in formats.def.
#pragma once

#include "omma/camera/files/camera_file.h"
#include "omma/camera/files/document.h"

namespace omma {

struct CameraFormat {
  const char* name;        ///< as after --format
  const char* what;        ///< whose it is
  const char* recognised;  ///< what in the content tells that it is this one
  const char* models;      ///< the camera models that are read
  const char* convention;  ///< pixel centre, orders, directions, units: whatever differs from others
  bool (*recognises)(const Document& document);
  std::vector<CameraFile::Entry> (*read)(const std::shared_ptr<const Document>& document);

  /// Both empty where the format is not written.
  const char* extension = "";
  std::string (*write)(std::span<const NamedCamera> cameras) = nullptr;
};

/// In the order of formats.def.
std::span<const CameraFormat* const> camera_formats();

#define OMMA_CAMERA_FORMAT(name) extern const CameraFormat name##_format;
#include "omma/camera/files/formats.def"
#undef OMMA_CAMERA_FORMAT

}  // namespace omma
