// Pictures of every format that is read: tests/unit/pictures holds the same 7 x 5 pixels in all of them, written by
// other programs. In color_* red is 36 x, green 60 y, blue 255 - 36 x; grey_* is 30 x + 15 y; with alpha_* and
// greyalpha_* comes an alpha of 255 - 20 (x + y).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <set>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/codec/decode.h"
#include "omma/image/codec/encode.h"
#include "omma/image/read.h"
#include "omma/image/srgb.h"
#include "tests/places.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

const ImageSize size{7, 5};

std::vector<fs::path> pictures() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(places::source) / "tests/unit/pictures")) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

fs::path picture(const char* name) { return fs::path(places::source) / "tests/unit/pictures" / name; }

void accept_all(const PictureInfo&) {}

/// Whether OpenImageIO reads it, which a build may lack.
bool is_rare(const fs::path& path) { return path.extension() == ".ppm"; }

Pixels decode_file(const fs::path& path) {
  return decode_picture(read_file(path), path.extension().string(), accept_all);
}

std::vector<int> expected_pixel(const std::string& name, int x, int y) {
  std::vector<int> pixel{36 * x, 60 * y, 255 - 36 * x};
  if (name.starts_with("grey")) pixel = {30 * x + 15 * y};
  if (name.find("alpha") != std::string::npos) pixel.push_back(255 - 20 * (x + y));
  return pixel;
}

/// In steps of 8 bits: none but where the format loses something. Observed: JPEG 2, HDR 1, lossy WebP 35.
int tolerance(const std::string& name) {
  if (name.ends_with(".jpg")) return 3;
  if (name.ends_with(".hdr")) return 1;
  return name.find("lossy") != std::string::npos ? 40 : 0;
}

TEST(ImageCodec, EveryFormatHoldsTheSamePicture) {
  std::set<std::string> formats;
  for (const fs::path& path : pictures()) {
    const std::string name = path.filename().string();
    if (name.starts_with("numbers")) continue;
    SCOPED_TRACE(name);
    Pixels pixels;
    try {
      pixels = decode_file(path);
    } catch (const InputError& error) {
      const bool no_module = std::string(error.what()).find("module for OpenImageIO") != std::string::npos;
      EXPECT_TRUE(is_rare(path) && no_module) << error.what();
      continue;
    }
    formats.insert(path.extension().string());
    ASSERT_EQ(pixels.info.size, size);
    const size_t components = size_t(pixels.stored());
    const SampleVector<uint8_t> values = to_8_bits(pixels);
    ASSERT_EQ(values.size(), components * 35);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        std::vector<int> expected = expected_pixel(name, x, y);
        const uint8_t* value = &values[size_t(y * size.width + x) * components];
        // Some formats have no grey, or no picture without alpha.
        if (components >= 3 && expected.size() <= 2) expected.insert(expected.begin(), 2, expected.front());
        if (components > expected.size()) expected.push_back(255);
        ASSERT_EQ(components, expected.size());
        for (size_t c = 0; c < components; ++c) {
          EXPECT_NEAR(value[c], expected[c], tolerance(name)) << x << ", " << y << ": " << c;
        }
      }
    }
  }
  for (const char* extension : {".png", ".jpg", ".exr", ".webp", ".tif", ".hdr", ".bmp", ".gif", ".tga"}) {
    EXPECT_TRUE(formats.contains(extension)) << extension;
  }
}

TEST(ImageCodec, BitsAndAlphaAreAsInTheFile) {
  const auto is = [](const char* name, size_t type, int components, int alpha) {
    const Pixels pixels = decode_file(picture(name));
    return pixels.samples.index() == type && pixels.info.components == components && pixels.info.alpha == alpha;
  };
  enum : size_t { u8, u16, u32, f32 };
  EXPECT_TRUE(is("color_8.png", u8, 3, -1));
  EXPECT_TRUE(is("color_16.png", u16, 3, -1));
  EXPECT_TRUE(is("color_palette.png", u8, 3, -1));
  EXPECT_TRUE(is("grey_16.png", u16, 1, -1));
  EXPECT_TRUE(is("greyalpha_8.png", u8, 2, 1));
  EXPECT_TRUE(is("alpha_16_interlaced.png", u16, 4, 3));
  EXPECT_TRUE(is("color_cmyk.jpg", u8, 3, -1));
  EXPECT_TRUE(is("grey.jpg", u8, 1, -1));
  EXPECT_TRUE(is("color_half_window.exr", f32, 3, -1));
  EXPECT_TRUE(is("alpha_tiles.exr", f32, 4, 3));
  EXPECT_TRUE(is("numbers.exr", u32, 1, -1));
  EXPECT_TRUE(is("color_lzw_16.tif", u16, 3, -1));
  EXPECT_TRUE(is("color_float.tif", f32, 3, -1));
  EXPECT_TRUE(is("alpha_zip.tif", u8, 4, 3));
  EXPECT_TRUE(is("color.hdr", f32, 3, -1));
}

TEST(ImageCodec, ImagesAreReadInLinearLightAndWithoutAlpha) {
  const auto image = std::get<FloatImage>(read_image(picture("color_16.png")));
  EXPECT_FLOAT_EQ(image.at(3, 2)[0], linear_from_srgb(108.0f / 255.0f));
  // Colour that is only partly there is that much darker.
  const auto masked = std::get<FloatImage>(read_image(picture("alpha_8.png")));
  ASSERT_EQ(masked.components, 3);
  EXPECT_FLOAT_EQ(masked.at(3, 2)[0], linear_from_srgb(float(108 * 155 / 255) / 255.0f));
  const auto numbers = std::get<IntImage>(read_image(picture("grey_16.png")));
  EXPECT_EQ(numbers.at(3, 2)[0], 257 * 120 - 1);
  const auto unsigned_numbers = std::get<IntImage>(read_image(picture("numbers.exr")));
  EXPECT_EQ(unsigned_numbers.at(3, 2)[0], 108);
  const auto linear = std::get<FloatImage>(read_image(picture("alpha_tiles.exr")));
  ASSERT_EQ(linear.components, 3);
  EXPECT_FLOAT_EQ(linear.at(3, 2)[1], 120.0f / 255.0f);
}

TEST(ImageCodec, ChannelsOfLayersFollowThoseOfNone) {
  std::vector<float> values(size_t{5} * 35);
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 5);
  const std::string exr =
      encode_exr({.size = size, .channels = {"a.A", "a.R", "a.B", "Z", "a.G"}, .samples = values.data()});
  const Pixels pixels = decode_exr(exr, accept_all);
  EXPECT_EQ(pixels.info.components, 5);
  EXPECT_EQ(pixels.info.alpha, 4);
  const auto& samples = std::get<SampleVector<float>>(pixels.samples);
  EXPECT_EQ(std::vector<float>(samples.begin(), samples.begin() + 4), (std::vector<float>{3, 1, 4, 2}));
  const fs::path path = fs::temp_directory_path() / fmt::format("omma_layers_{}.exr", ::getpid());
  write_text(path, exr);
  const auto image = std::get<FloatImage>(read_image(path));
  fs::remove(path);
  EXPECT_TRUE(std::ranges::equal(image.values, samples));
}

TEST(ImageCodec, SizeIsAskedForBeforeItIsAllocated) {
  for (const fs::path& path : pictures()) {
    if (is_rare(path)) continue;
    const auto refuse = [](const PictureInfo& info) { throw InputError("{} x {}", info.size.width, info.size.height); };
    try {
      decode_picture(read_file(path), path.extension().string(), refuse);
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), "7 x 5") << path;
    }
  }
}

/// Broken on purpose, by a seed. Whatever comes of it, it is pixels or an InputError, and the decoder keeps quiet.
TEST(ImageCodec, BrokenFilesAreRefusedQuietly) {
  const auto small = [](const PictureInfo& info) {
    if (int64_t{info.size.width} * info.size.height > 1 << 20) throw InputError("too large");
  };
  testing::internal::CaptureStderr();
  int refused = 0, decoded = 0;
  for (const fs::path& path : pictures()) {
    if (is_rare(path)) continue;
    const std::string whole = read_file(path), extension = path.extension().string();
    const auto decodes = [&](const std::string& bytes) {
      try {
        const Pixels pixels = decode_picture(bytes, extension, small);
        const size_t count = std::visit([](const auto& samples) { return samples.size(); }, pixels.samples);
        EXPECT_EQ(count, pixels.count()) << path;
        ++decoded;
        return true;
      } catch (const InputError&) {
        ++refused;
        return false;
      }
    };
    for (size_t length = 0; length < whole.size() * 3 / 4; length += 1 + whole.size() / 50) {
      EXPECT_FALSE(decodes(whole.substr(0, length))) << path << " cut at " << length;
    }
    std::minstd_rand random(1);
    for (int i = 0; i < 80; ++i) {
      std::string broken = whole;
      for (int k = 0; k <= i % 4; ++k) broken[random() % broken.size()] = static_cast<char>(random());
      decodes(broken);
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 1500);
  EXPECT_GT(decoded, 300);
}

}  // namespace
}  // namespace omma
