// Fuzz targets for readers that take a path: what the fuzzer makes up is a file. Any bytes give a result, a
// CommandError or an InputError; nothing else.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/camera/camera.h"
#include "omma/camera/pose_file.h"
#include "omma/image/codec/decode.h"

namespace omma {

/// A file of the fuzzer's own, gone when it ends.
class FuzzFile {
 public:
  explicit FuzzFile(const char* extension)
      : path_(std::filesystem::temp_directory_path() / fmt::format("omma_fuzz_{}{}", ::getpid(), extension)) {}
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;
  ~FuzzFile() { std::filesystem::remove(path_); }

  std::string holding(const uint8_t* data, size_t size) const {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path_.string();
  }

 private:
  std::filesystem::path path_;
};

template <typename Read>
void fuzz_reader(const Read& read) {
  try {
    read();
  } catch (const CommandError&) {
  } catch (const InputError&) {
  }
}

/// The camera of a text that names the file, small. What it says of itself has to make a camera again.
inline void fuzz_camera(const std::string& text) {
  std::optional<Camera> camera;
  fuzz_reader([&] { camera = make_camera(text, ImageSize{40, 30}); });
  if (camera && make_camera(to_text(*camera)).size() != camera->size()) std::abort();
}

inline void fuzz_poses(const std::string& path) {
  fuzz_reader([&] { load_poses(path); });
}

/// The content says which format it is; what has no mark of its own is TGA.
inline void fuzz_picture(const std::string& path) {
  fuzz_reader([&] {
    decode_picture(read_file(path), ".tga", [](const PictureInfo& info) {
      if (int64_t{info.size.width} * info.size.height > 1 << 20) throw InputError("too large");
    });
  });
}

inline void fuzz_ray_map(const std::string& path) {
  fuzz_reader([&] { Camera(load_ray_map(path)); });
}

}  // namespace omma

/// `...` says what is done with the file at `path`.
#define OMMA_FUZZ_FILE(extension, ...)                                      \
  extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) { \
    using namespace omma;                                                   \
    static const FuzzFile file(extension);                                  \
    const std::string path = file.holding(data, size);                      \
    __VA_ARGS__;                                                            \
    return 0;                                                               \
  }
