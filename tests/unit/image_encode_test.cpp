// What is written, down to the bytes: bands that make one PNG, exact 8-bit sRGB, JPEG's tables, OpenEXR's attributes.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "omma/image/codec/decode.h"
#include "omma/image/codec/encode.h"
#include "omma/image/srgb.h"
#include "omma/image/srgb8.h"

namespace omma {
namespace {

using namespace std::string_view_literals;

void accept_all(const PictureInfo&) {}

/// Smooth with some noise, as rendered pictures are, or a pattern that comes again and again.
std::vector<uint8_t> bytes_of(ImageSize size, size_t row_bytes, bool pattern) {
  std::vector<uint8_t> bytes(row_bytes * size_t(size.height));
  std::minstd_rand random(1);
  for (size_t i = 0; i < bytes.size(); ++i) {
    const size_t x = i % row_bytes, y = i / row_bytes;
    bytes[i] = static_cast<uint8_t>(pattern ? (x % 37) * (x % 37) + 91 * (y % 5) : x / 8 + y / 4 + random() % 3);
  }
  return bytes;
}

std::string png_of(ImageSize size, int components, int bits, const std::vector<uint8_t>& bytes) {
  Rows rows{.size = size, .components = components, .bits = bits, .fill = {}};
  rows.fill = [&](int y, uint8_t* to) { std::memcpy(to, &bytes[size_t(y) * rows.row_bytes()], rows.row_bytes()); };
  return encode_png(rows, false, {});
}

TEST(ImageEncode, PngOfAnySizeComesBack) {
  // From one pixel to several bands, and rows longer than a band.
  const ImageSize sizes[] = {{1, 1}, {1, 700}, {700, 1}, {3, 5}, {301, 1500}, {200000, 3}};
  for (const ImageSize& size : sizes) {
    for (const auto& [components, bits] : {std::pair{3, 8}, {1, 8}, {1, 16}, {3, 16}}) {
      for (const bool pattern : {false, true}) {
        const size_t row_bytes = size_t(size.width) * size_t(components * bits / 8);
        const std::vector<uint8_t> bytes = bytes_of(size, row_bytes, pattern);
        const Pixels back = decode_png(png_of(size, components, bits, bytes), accept_all);
        ASSERT_EQ(back.info.size, size);
        ASSERT_EQ(back.info.components, components);
        if (bits == 8) {
          EXPECT_TRUE(std::ranges::equal(std::get<SampleVector<uint8_t>>(back.samples), bytes)) << size.width;
          continue;
        }
        const auto& numbers = std::get<SampleVector<uint16_t>>(back.samples);
        bool same = numbers.size() * 2 == bytes.size();
        for (size_t i = 0; i < numbers.size(); ++i) same &= numbers[i] == bytes[2 * i] * 256 + bytes[2 * i + 1];
        EXPECT_TRUE(same) << size.width;
      }
    }
  }
}

TEST(ImageEncode, PngIsTheSameForAnyNumberOfThreads) {
  const ImageSize size{1000, 1500};
  const std::vector<uint8_t> bytes = bytes_of(size, 3000, false);
  const std::string by_many = png_of(size, 3, 8, bytes);
  const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(png_of(size, 3, 8, bytes) == by_many);
}

TEST(ImageEncode, PatternsAreFoundInPng) {
  const ImageSize size{1000, 1500};
  const std::vector<uint8_t> bytes = bytes_of(size, 3000, true);
  EXPECT_LT(png_of(size, 3, 8, bytes).size(), bytes.size() / 50);
}

TEST(ImageEncode, Srgb8IsTheRoundedFormula) {
  const auto exact = [](float linear) { return static_cast<uint8_t>(std::lround(255.0f * srgb_from_linear(linear))); };
  std::vector<float> values{-1.0f, -0.0f, 0.0f, 1.0f, 2.0f, NAN, INFINITY, -INFINITY, 1e-40f};
  // Every change from one number to the next, and what lies around it.
  for (uint32_t bits = std::bit_cast<uint32_t>(1e-5f), step = 0; bits < std::bit_cast<uint32_t>(1.0f); bits += step) {
    values.push_back(std::bit_cast<float>(bits));
    step = 997;
    if (exact(std::bit_cast<float>(bits)) == exact(std::bit_cast<float>(bits + step))) continue;
    for (uint32_t i = 0; i < step; ++i) values.push_back(std::bit_cast<float>(bits + i));
  }
  std::vector<uint8_t> bytes(values.size());
  srgb8_from_linear(values.data(), bytes.data(), values.size());
  size_t wrong = 0, highest = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    wrong += bytes[i] != exact(values[i]);
    highest = std::max<size_t>(highest, bytes[i]);
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(highest, 255U);
  EXPECT_GT(values.size(), 255U * 997U);
}

TEST(ImageEncode, JpegIsNotSubsampledAndOfQuality95) {
  const std::vector<uint8_t> bytes = bytes_of({40, 30}, 120, false);
  const Rows rows{.size = {40, 30}, .fill = [&](int y, uint8_t* to) { std::memcpy(to, &bytes[size_t(y) * 120], 120); }};
  const std::string jpeg = encode_jpeg(rows, 95, {});
  // A frame of 8 bits, 30 x 40, three components with factors of 1 x 1; and the luma table's first numbers.
  EXPECT_NE(jpeg.find("\xff\xc0\x00\x11\x08\x00\x1e\x00\x28\x03\x01\x11\x00\x02\x11\x01\x03\x11\x01"sv),
            std::string::npos);
  EXPECT_NE(jpeg.find("\xff\xdb\x00\x43\x00\x02\x01\x01\x01\x01\x01\x02\x01"sv), std::string::npos);
}

TEST(ImageEncode, ExrNamesItsChannelsAndItsCompression) {
  const std::vector<float> values(12, 0.5f);
  const std::string exr = encode_exr({.size = {2, 3}, .channels = {"U", "V"}, .samples = values.data()});
  EXPECT_NE(exr.find("channels\0chlist\0"sv), std::string::npos);
  EXPECT_NE(exr.find("U\0\2\0\0\0"sv), std::string::npos);  // 2: float
  EXPECT_NE(exr.find("V\0\2\0\0\0"sv), std::string::npos);
  EXPECT_NE(exr.find("compression\0compression\0\1\0\0\0\3"sv), std::string::npos);  // 3: ZIP
}

}  // namespace
}  // namespace omma
