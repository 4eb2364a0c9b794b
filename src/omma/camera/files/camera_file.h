// Calibration files of other programs: cameras in and out. docs/camera-files.md says which, and what each means by its
// numbers.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

struct CameraFormat;

/// A file with one camera or several. Poses and what else a file holds are not read.
class CameraFile {
 public:
  /// Knows the format by the content. Throws InputError, with file, line and key where there are, when it is none that
  /// is known or could be several, when nothing in it is a camera, and when it is beyond the limits.
  static CameraFile load(const std::filesystem::path& path, const Limits& limits = {});
  /// The same of a text; `file` begins the messages.
  static CameraFile parse(std::string file, std::string_view text, const Limits& limits = {});

  /// Its name on the command line: "kalibr".
  const char* format() const;
  /// In the file's order.
  std::vector<std::string> names() const;
  /// Throws CommandError when there is none of that name, InputError when its content makes no camera of Omma's.
  Camera camera(std::string_view name) const;
  /// The file's only camera; CommandError, with all names, when there are several.
  Camera camera() const;

  /// A camera of the file, read when it is asked for: one that cannot be used does not spoil the others.
  struct Entry {
    std::string name;
    std::function<Camera()> read;
  };

 private:
  std::string file_;
  const CameraFormat* format_ = nullptr;
  std::vector<Entry> entries_;
};

/// The parts of `calibration.yaml#cam1`: a file and which of its cameras.
struct CameraFileText {
  std::filesystem::path path;
  std::optional<std::string> name;
};

/// Nothing unless the part before the last # has the extension of a calibration file or is a file that exists.
std::optional<CameraFileText> camera_file_text(std::string_view text);

/// Throws CommandError and InputError as CameraFile does.
Camera load_camera(const CameraFileText& text, const Limits& limits = {});

struct NamedCamera {
  std::string name;
  Camera camera;
};

/// Writes cameras into one file, whole or not at all. The format is `format`, or the only one that is written with the
/// path's extension. Throws CommandError when neither settles it, when the format has no place for several cameras,
/// and when it has none for a camera's lens.
void write_camera_file(const std::filesystem::path& path, std::span<const NamedCamera> cameras,
                       std::string_view format = {});

/// Throws CommandError unless write_camera_file could settle on a format for this path.
void require_camera_format(const std::filesystem::path& path, std::string_view format);

/// Markdown: all formats, with their models and conventions. docs/camera-files.md holds it.
std::string camera_format_table();

}  // namespace omma
