// A picture as its file holds it: numbers that nobody has given a meaning yet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <utility>
#include <variant>
#include <vector>

#include "omma/math/ray.h"

namespace omma {

/// What a file's header says.
struct PictureInfo {
  ImageSize size;
  int components = 0;
  int alpha = -1;  ///< which component is alpha; -1: none
};

/// Called before anything of that size is allocated, since a broken header must not be able to ask for all memory.
/// Throws InputError where it is too much.
using Accept = std::function<void(const PictureInfo&)>;

/// Zeros that the system hands out by pages as they are written: a header that claims a gigabyte and is followed by
/// nothing takes no memory. Elements that a vector gives up and takes back keep their values.
template <typename T>
struct ZeroPages {
  using value_type = T;

  ZeroPages() = default;
  template <typename Other>
  ZeroPages(const ZeroPages<Other>&) {}

  T* allocate(size_t count) {
    void* const pages = std::calloc(count, sizeof(T));
    if (pages == nullptr) throw std::bad_alloc();
    return static_cast<T*>(pages);
  }
  void deallocate(T* pages, size_t) { std::free(pages); }
  template <typename Element>
  void construct(Element*) {}
  template <typename Element, typename... Values>
  void construct(Element* at, Values&&... values) {
    ::new (static_cast<void*>(at)) Element(std::forward<Values>(values)...);
  }
  friend bool operator==(const ZeroPages&, const ZeroPages&) { return true; }
};

/// What a decoder fills.
template <typename T>
using SampleVector = std::vector<T, ZeroPages<T>>;

struct Pixels {
  static constexpr int most_components = 4;
  using Samples =
      std::variant<SampleVector<uint8_t>, SampleVector<uint16_t>, SampleVector<uint32_t>, SampleVector<float>>;

  PictureInfo info;
  /// Rows from the top, the first `stored()` components of each pixel beside each other.
  Samples samples;

  int stored() const { return std::min(info.components, most_components); }
  size_t count() const { return size_t(info.size.width) * size_t(info.size.height) * size_t(stored()); }
};

/// As 8-bit samples: whole numbers scaled to their type's range, floats clamped to 0..1.
SampleVector<uint8_t> to_8_bits(Pixels pixels);

}  // namespace omma
