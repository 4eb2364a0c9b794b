// From pixels to the bytes of a file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "omma/math/ray.h"

namespace omma {

/// What is written, row by row, so that a large picture never lies twice in memory.
struct Rows {
  ImageSize size;
  int components = 3;  ///< 1 or 3
  int bits = 8;        ///< of a component: 8, or 16 in PNG
  /// Puts row `y` at `to`: the bytes of a component from the high one down. Called from several threads at once.
  std::function<void(int y, uint8_t* to)> fill;

  size_t row_bytes() const { return size_t(size.width) * size_t(components) * size_t(bits / 8); }
};

/// A PNG, the same for any number of threads. `srgb` says that the numbers are colour; `xmp` is a packet or empty.
std::string encode_png(const Rows& rows, bool srgb, const std::string& xmp);

/// A JPEG without subsampling of colour. Throws MachineError, without the file's name, for sides beyond 65500.
std::string encode_jpeg(const Rows& rows, int quality, const std::string& xmp);

enum class ExrType { float32, uint32 };

struct ExrPicture {
  ImageSize size;
  std::vector<std::string> channels;  ///< beside each other in each pixel
  ExrType type = ExrType::float32;
  const void* samples = nullptr;
  bool latlong = false;  ///< a panorama of the whole sphere
};

/// Compressed without loss by ZIP.
std::string encode_exr(const ExrPicture& picture);

}  // namespace omma
