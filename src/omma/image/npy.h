// NumPy's .npy files: an array of numbers with its shape.
// Format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "omma/base/limits.h"

namespace omma {

template <typename T>
struct NpyArray {
  std::vector<size_t> shape;  ///< outermost first; empty: a single value
  std::vector<T> values;      ///< in C order: the last index runs fastest
  bool integer = false;       ///< the file holds whole numbers or booleans
};

/// Reads any real dtype (bool, i1-i8, u1-u8, f2, f4, f8), either byte order, C or Fortran order, as
/// `T`: float, double or int32_t. Throws InputError when the file is no .npy, is truncated, holds
/// something else, holds a number that int32_t cannot (a fraction, one too large), or more numbers than four for each
/// of the limit's picture_pixels.
template <typename T>
NpyArray<T> read_npy(const std::filesystem::path& path, const Limits& limits = {});

/// Writes little-endian float32, float64 or int32 in C order. `values` has as many elements as
/// `shape` says.
template <typename T>
void write_npy(const std::filesystem::path& path, std::span<const size_t> shape, std::span<const T> values);

}  // namespace omma
