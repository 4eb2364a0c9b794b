// What write_image writes, read_image reads; what is broken is refused; a full disk leaves no file.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <random>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/pfm.h"
#include "omma/image/read.h"
#include "omma/image/srgb.h"
#include "omma/image/write.h"

namespace omma {
namespace {

namespace fs = std::filesystem;

constexpr ImageSize size{7, 5};
const std::vector<std::string> extensions{".png", ".jpg", ".exr", ".pfm", ".npy"};

/// Different numbers everywhere, some of them those that stand for nothing.
Image sample_image(const ChannelInfo& info) {
  if (info.integer) {
    IntImage image(size, info.components);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = int32_t(i * 1000) - 1;
    return image;
  }
  FloatImage image(size, info.components);
  for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i) / image.values.size();
  if (info.channel != Channel::color) {
    image.values[0] = std::numeric_limits<float>::infinity();
    image.values[1] = -12345.678f;
  }
  return image;
}

class ImageFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("omma_image_{}", ::getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  std::string read_error(const std::string& name) const {
    try {
      read_image(file(name));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

TEST_F(ImageFile, EveryChannelComesBackFromEveryFormatThatHoldsIt) {
  int tried = 0, refused = 0;
  for (const ChannelInfo& info : channels()) {
    const Image image = sample_image(info);
    for (const std::string& extension : extensions) {
      SCOPED_TRACE(info.name + extension);
      const fs::path path = file(std::string(info.name) + extension);
      try {
        check_image_output(path, info.channel);
      } catch (const CommandError&) {
        ++refused;
        EXPECT_THROW(write_image(path, image, info.channel), CommandError);
        EXPECT_FALSE(fs::exists(path));
        continue;
      }
      ++tried;
      write_image(path, image, info.channel);
      const Image back = read_image(path);
      ASSERT_EQ(image_size(back), size);
      ASSERT_EQ(image_components(back), info.components);
      ASSERT_EQ(back.index(), image.index());
      if (info.integer) {
        EXPECT_EQ(std::get<IntImage>(back).values, std::get<IntImage>(image).values);
        continue;
      }
      const bool eight_bit = extension == ".png" || extension == ".jpg";
      for (size_t i = 0; i < std::get<FloatImage>(image).values.size(); ++i) {
        const float before = std::get<FloatImage>(image).values[i], after = std::get<FloatImage>(back).values[i];
        if (!eight_bit) {
          EXPECT_EQ(before, after);
        } else {
          // Rounding to 8 bits is off by half a step; JPEG of a steep ramp observed off by 10.
          const float steps = 255.0f * std::abs(srgb_from_linear(before) - srgb_from_linear(after));
          EXPECT_LE(steps, extension == ".png" ? 0.501f : 12.0f) << i;
        }
      }
    }
  }
  EXPECT_EQ(tried, 4 + 1 + 9 + 5 + 9);  // png, jpg, exr, pfm, npy
  EXPECT_EQ(tried + refused, int(channels().size() * extensions.size()));
}

TEST_F(ImageFile, RefusalNamesTheFormatsThatWouldDo) {
  const auto refusal = [&](const char* name, Channel channel) -> std::string {
    try {
      check_image_output(file(name), channel);
    } catch (const CommandError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(refusal("a.png", Channel::distance).find(".exr, .pfm, .npy can"), std::string::npos);
  EXPECT_NE(refusal("a.pfm", Channel::id).find(".png, .exr, .npy can"), std::string::npos);
  EXPECT_NE(refusal("a.gif", Channel::color).find(".png, .jpg, .jpeg, .exr, .pfm, .npy"), std::string::npos);
  EXPECT_NE(refusal("missing/a.png", Channel::color).find("does not exist"), std::string::npos);
  EXPECT_EQ(refusal("a.PNG", Channel::color), "no error");
}

TEST_F(ImageFile, NumbersTooLargeForPngAreRefused) {
  IntImage image(size, 1, 65534);
  write_image(file("a.png"), image, Channel::id);
  EXPECT_EQ(std::get<IntImage>(read_image(file("a.png"))).values[3], 65534);
  image.values[3] = 65535;
  EXPECT_THROW(write_image(file("b.png"), image, Channel::id), CommandError);
  EXPECT_FALSE(fs::exists(file("b.png")));
}

TEST_F(ImageFile, ColourIsClampedAndEncoded) {
  FloatImage image({4, 1}, 3);
  image.values = {-1, 0, 2, 0.5f, 0.5f, 0.5f, NAN, INFINITY, 0.0f, 1, 1, 1};
  write_image(file("a.png"), image, Channel::color);
  const FloatImage back = std::get<FloatImage>(read_image(file("a.png")));
  EXPECT_EQ(std::vector<float>(back.values.begin(), back.values.begin() + 3), (std::vector<float>{0, 0, 1}));
  EXPECT_NEAR(back.values[3], linear_from_srgb(188.0f / 255.0f), 1e-6);  // 0.5 encodes to 187.5
  EXPECT_EQ(std::vector<float>(back.values.begin() + 6, back.values.end()), (std::vector<float>{0, 1, 0, 1, 1, 1}));
}

TEST_F(ImageFile, SrgbRoundTripAndHandComputedValues) {
  EXPECT_NEAR(srgb_from_linear(0.18f), 0.46135612f, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.001f), 0.01292f, 1e-7);
  for (int i = 0; i <= 255; ++i) {
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(i / 255.0f)), i / 255.0f, 1e-6);
  }
}

TEST_F(ImageFile, PfmRowsRunFromTheBottomInEitherByteOrder) {
  write_text(file("a.pfm"), std::string("Pf\n1 2\n1.0\n\x3f\x80\0\0\x40\0\0\0", 19));
  EXPECT_EQ(read_pfm(file("a.pfm")).values, (std::vector<float>{2.0f, 1.0f}));
  write_pfm(file("b.pfm"), read_pfm(file("a.pfm")));
  EXPECT_EQ(read_file(file("b.pfm")), std::string("Pf\n1 2\n-1.0\n\0\0\x80\x3f\0\0\0\x40", 20));
}

TEST_F(ImageFile, BrokenFilesAreRefused) {
  const FloatImage image({64, 64}, 3, 0.25f);
  for (const std::string& extension : extensions) {
    SCOPED_TRACE(extension);
    const std::string name = "a" + extension;
    EXPECT_NE(read_error(name).find("no such file"), std::string::npos);
    write_text(file(name), "");
    EXPECT_NE(read_error(name), "no error");
    write_text(file(name), std::string(300, 'x'));
    EXPECT_NE(read_error(name), "no error");
    write_image(file(name), image, Channel::color);
    const std::string whole = read_file(file(name));
    for (const size_t length : {size_t{3}, size_t{20}, whole.size() / 2}) {
      write_text(file(name), whole.substr(0, length));
      EXPECT_NE(read_error(name), "no error") << length;
    }
  }
  EXPECT_THROW(read_image(file("a.tga")), CommandError);
  for (const char* header :
       {"Pf\n99999999 99999999\n-1.0\n", "Pf\n-1 1\n-1\n", "Pf\n1 1\n0\n", "Pf\nx 1\n-1\n", "Pf", "PF 1 1 nan\n"}) {
    write_text(file("a.pfm"), header);
    EXPECT_NE(read_error("a.pfm"), "no error") << header;
  }
}

TEST_F(ImageFile, NpyOfNoImageShapeIsRefused) {
  const std::pair<std::string, std::string> files[] = {{"(4,)", "1234"}, {"(1, 1, 1, 4)", "1234"}, {"(1, 4, 0)", ""}};
  for (const auto& [shape, data] : files) {
    const std::string header = fmt::format("{{'descr': '|u1', 'fortran_order': False, 'shape': {}}}", shape);
    write_text(file("a.npy"), std::string("\x93NUMPY\x01\0", 8) + char(header.size()) + '\0' + header + data);
    EXPECT_NE(read_error("a.npy").find("H x W"), std::string::npos) << shape;
  }
}

/// A limit on file size refuses writes like a full disk does.
TEST_F(ImageFile, FullDiskIsAMachineErrorAndLeavesNothing) {
  FloatImage image({256, 256}, 3);
  std::minstd_rand random;  // nothing that compresses
  for (float& value : image.values) value = float(random() % 1009) / 1009.0f;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limited{10000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limited), 0);
  std::vector<std::string> left_alone;
  for (const std::string& extension : extensions) {
    try {
      write_image(file("a" + extension), image, Channel::color);
    } catch (const MachineError&) {
      left_alone.push_back(extension);
    }
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(left_alone, extensions);
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace omma
