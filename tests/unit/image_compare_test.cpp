#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/image/compare.h"
#include "omma/image/srgb.h"
#include "omma/image/ssim.h"

namespace omma {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

FloatImage ramp(ImageSize size, int components) {
  FloatImage image(size, components);
  for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i * 37 % 101) / 101.0f;
  return image;
}

TEST(Compare, EqualImagesDoNotDiffer) {
  const FloatImage image = ramp({16, 12}, 3);
  for (const Scale scale : {Scale::display, Scale::raw}) {
    const Difference difference = compare_images(image, image, scale);
    EXPECT_EQ(difference.max, 0.0);
    EXPECT_EQ(difference.mean, 0.0);
    EXPECT_EQ(difference.psnr, double(inf));
    EXPECT_NEAR(difference.ssim.value(), 1.0, 1e-12);
    EXPECT_EQ(difference.mismatches, 0u);
  }
}

TEST(Compare, MetricsOfAConstantOffset) {
  FloatImage a({16, 16}, 1, 0.5f), b({16, 16}, 1, 0.6f);
  const Difference difference = compare_images(a, b, Scale::raw);
  EXPECT_NEAR(difference.max.value(), 0.1, 1e-7);
  EXPECT_NEAR(difference.mean.value(), 0.1, 1e-7);
  EXPECT_NEAR(difference.psnr.value(), 20.0 * std::log10(0.5 / 0.1), 1e-5);  // the peak is a's largest value
  // Constant images: only the term of the means is left.
  const double c1 = std::pow(0.01 * 0.5, 2);
  EXPECT_NEAR(difference.ssim.value(), (2 * 0.5 * 0.6 + c1) / (0.25 + 0.36 + c1), 1e-6);
}

TEST(Compare, DisplayScaleComparesWhatAScreenShows) {
  FloatImage a({1, 1}, 3), b = a;
  a.values = {0.0f, 1.0f, 0.2f};
  b.values = {0.0f, 9.0f, 0.2f};  // beyond white is white
  EXPECT_EQ(compare_images(a, b, Scale::display).max, 0.0);
  EXPECT_EQ(compare_images(a, b, Scale::raw).max, 8.0);
  b.values = {0.0f, 1.0f, 0.3f};
  EXPECT_NEAR(compare_images(a, b, Scale::display).max.value(), srgb_from_linear(0.3f) - srgb_from_linear(0.2f), 1e-7);
}

/// Against the definition, a window at a time.
TEST(Compare, SsimEqualsItsDefinition) {
  const FloatImage a = ramp({14, 13}, 1);
  FloatImage b = a;
  for (size_t i = 0; i < b.values.size(); ++i) b.values[i] = 0.7f * b.values[i] + float(i * 53 % 89) / 400.0f;
  double total = 0.0, weight_sum = 0.0;
  const auto weight = [](int i, int j) {
    return std::exp(-(std::pow(i - 5, 2) + std::pow(j - 5, 2)) / (2 * 1.5 * 1.5));
  };
  for (int i = 0; i < 11; ++i) {
    for (int j = 0; j < 11; ++j) weight_sum += weight(i, j);
  }
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      double mean_a = 0, mean_b = 0, var_a = 0, var_b = 0, covariance = 0;
      const auto sum = [&](const auto& visit) {
        for (int j = 0; j < 11; ++j) {
          for (int i = 0; i < 11; ++i) visit(weight(i, j) / weight_sum, *a.at(x + i, y + j), *b.at(x + i, y + j));
        }
      };
      sum([&](double w, double va, double vb) { mean_a += w * va, mean_b += w * vb; });
      sum([&](double w, double va, double vb) {
        var_a += w * (va - mean_a) * (va - mean_a);
        var_b += w * (vb - mean_b) * (vb - mean_b);
        covariance += w * (va - mean_a) * (vb - mean_b);
      });
      total += (2 * mean_a * mean_b + 1e-4) * (2 * covariance + 9e-4) /
               ((mean_a * mean_a + mean_b * mean_b + 1e-4) * (var_a + var_b + 9e-4));
    }
  }
  const double ssim = structural_similarity(a, b, 1.0);
  EXPECT_NEAR(ssim, total / 12.0, 1e-12);  // observed 2e-16
  EXPECT_LT(ssim, 0.99);
}

TEST(Compare, ImagesUnderTheWindowHaveNoSsim) {
  EXPECT_FALSE(compare_images(ramp({10, 40}, 3), ramp({10, 40}, 3), Scale::raw).ssim);
  EXPECT_TRUE(compare_images(ramp({11, 11}, 3), ramp({11, 11}, 3), Scale::raw).ssim);
}

TEST(Compare, OneSidedPixelsAreCountedAndUnlimited) {
  FloatImage a({4, 1}, 1), b({4, 1}, 1);
  a.values = {1, inf, inf, 2};
  b.values = {1, inf, 5, 4};
  const Difference difference = compare_images(a, b, Scale::raw);
  EXPECT_EQ(difference.mismatches, 1u);
  EXPECT_EQ(difference.mismatch_share, 0.25);
  EXPECT_EQ(difference.max, double(inf));
  EXPECT_EQ(difference.mean, 1.0);  // over the two that both have
  const FloatImage picture = difference_image(a, b, Scale::raw);
  EXPECT_EQ(picture.values, (std::vector<float>{0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 1, 1}));
}

TEST(Compare, NumbersDifferOrDoNot) {
  IntImage a({3, 1}, 1), b({3, 1}, 1);
  a.values = {-1, 4, 7};
  b.values = {-1, 5, 7};
  const Difference difference = compare_images(a, b, Scale::raw);
  EXPECT_EQ(difference.mismatches, 1u);
  EXPECT_NEAR(difference.mismatch_share, 1.0 / 3.0, 1e-12);
  EXPECT_FALSE(difference.max || difference.psnr || difference.ssim);
  EXPECT_EQ(difference_image(a, b, Scale::raw).values, (std::vector<float>{0, 0, 0, 1, 1, 1, 0, 0, 0}));
}

TEST(Compare, WhatCannotBeComparedIsRefused) {
  const FloatImage a({2, 2}, 3);
  EXPECT_THROW(compare_images(a, FloatImage({2, 3}, 3), Scale::raw), InputError);
  EXPECT_THROW(compare_images(a, FloatImage({2, 2}, 1), Scale::raw), InputError);
  EXPECT_THROW(compare_images(a, IntImage({2, 2}, 3), Scale::raw), InputError);
}

TEST(Channels, TableIsInTheOrderOfTheEnumeration) {
  for (const ChannelInfo& info : channels()) {
    EXPECT_EQ(&channel_info(info.channel), &info);
    EXPECT_EQ(channel_from_name(info.name), info.channel);
  }
  EXPECT_EQ(channel_info(Channel::material).name, std::string("material"));
  try {
    channel_from_name("colour");
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'color'"), std::string::npos);
  }
}

}  // namespace
}  // namespace omma
