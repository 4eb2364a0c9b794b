// Deflate (RFC 1951) of a long text on all processors: bands that know nothing of each other, each ending at a whole
// byte, so that they make one stream when they are put one after another.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace omma {

/// For one thread and many bands: zlib's memory is set up once.
class BandDeflater {
 public:
  BandDeflater();
  ~BandDeflater();
  BandDeflater(BandDeflater&&) noexcept;

  /// One band of a stream. What comes out depends on the bytes alone.
  std::string operator()(std::span<const uint8_t> bytes, bool last);

 private:
  struct Zlib;
  std::unique_ptr<Zlib> zlib_;
};

}  // namespace omma
