// Pictures into memory of the caller's: where each pixel goes, and what is refused before anything is written.
#include <gtest/gtest.h>

#include <numeric>

#include "omma/base/error.h"
#include "omma/image/pixel_buffer.h"
#include "omma/image/srgb8.h"

namespace omma {
namespace {

constexpr ImageSize size{5, 3};

TEST(PixelBufferTest, RowsMayBeApartAndFromTheBottom) {
  Image image = IntImage(size, 1);
  std::iota(std::get<IntImage>(image).values.begin(), std::get<IntImage>(image).values.end(), 0);
  for (const bool bottom_up : {false, true}) {
    std::vector<int32_t> memory(7 * 3, -7);
    const Output output{Channel::id, {memory.data(), memory.size() * 4, 7 * 4, PixelFormat::int32, bottom_up}};
    check(output, size);
    copy_image(image, output);
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 7; ++x) {
        const int row = bottom_up ? 2 - y : y;
        EXPECT_EQ(memory[size_t(7 * row + x)], x < 5 ? 5 * y + x : -7) << x << ", " << y;
      }
    }
    fill_with_nothing(output, size);
    for (int i = 0; i < 21; ++i) EXPECT_EQ(memory[size_t(i)], i % 7 < 5 ? -1 : -7);
  }
}

TEST(PixelBufferTest, ColourIsEncodedAsFilesHaveIt) {
  Image image = FloatImage(size, 3);
  auto& values = std::get<FloatImage>(image).values;
  for (size_t i = 0; i < values.size(); ++i) values[i] = float(i) / float(values.size()) * 1.2f - 0.05f;
  std::vector<uint8_t> expected(values.size());
  srgb8_from_linear(values.data(), expected.data(), values.size());
  std::vector<uint8_t> three(45), four(60, 9);
  copy_image(image, {Channel::color, {three.data(), three.size(), 0, PixelFormat::srgb8}});
  copy_image(image, {Channel::color, {four.data(), four.size(), 0, PixelFormat::srgba8}});
  EXPECT_EQ(three, expected);
  for (size_t pixel = 0; pixel < 15; ++pixel) {
    for (size_t c = 0; c < 4; ++c) EXPECT_EQ(four[4 * pixel + c], c == 3 ? 255 : expected[3 * pixel + c]);
  }
}

std::string refusal(const Output& output) {
  try {
    check(output, size);
  } catch (const CommandError& error) {
    return error.what();
  }
  ADD_FAILURE() << "was not refused";
  return {};
}

TEST(PixelBufferTest, RefusesWhatThePictureDoesNotFitInto) {
  alignas(4) uint8_t memory[400] = {};
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(refusal({Channel::color, {nullptr, 400, 0, PixelFormat::srgb8}}), "no memory");
  expect(refusal({Channel::color, {memory, 44, 0, PixelFormat::srgb8}}), "take 45");
  expect(refusal({Channel::color, {memory, 46, 16, PixelFormat::srgb8}}), "take 47");
  expect(refusal({Channel::color, {memory, 400, 14, PixelFormat::srgb8}}), "14 bytes apart");
  expect(refusal({Channel::distance, {memory, 400, 0, PixelFormat::srgb8}}), "float32");
  expect(refusal({Channel::distance, {memory, 400, 0, PixelFormat::int32}}), "float32");
  expect(refusal({Channel::id, {memory, 400, 0, PixelFormat::float32}}), "int32");
  expect(refusal({Channel::id, {memory + 1, 399, 0, PixelFormat::int32}}), "aligned");
  expect(refusal({Channel::id, {memory, 400, 22, PixelFormat::int32}}), "aligned");
  // Steps whose products overflow.
  expect(refusal({Channel::id, {memory, 400, size_t(-20), PixelFormat::int32}}), "more than can be counted");
  expect(refusal({Channel::id, {memory, 400, size_t(1) << 63, PixelFormat::int32}}), "more than can be counted");
  check({Channel::color, {memory + 1, 47, 16, PixelFormat::srgb8}}, size);  // the last row has no need of all of it
}

}  // namespace
}  // namespace omma
