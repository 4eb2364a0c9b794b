// What the tests of deformed cameras share.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "omma/base/error.h"
#include "omma/camera/camera.h"
#include "omma/camera/ray_bundle.h"

namespace omma {

inline constexpr ImageSize size{160, 120};

class Deformation : public testing::Test {
 protected:
  Deformation() { std::filesystem::create_directories(folder_); }
  ~Deformation() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / fmt::format("omma_deformation_{}", ::getpid());
};

// The kind of error and its message; "accepted" when there is none.
inline std::string refusal(const std::string& text, ErrorKind kind, std::optional<ImageSize> asked = size) {
  try {
    make_camera(text, asked);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << text << ": " << error.what();
    return error.what();
  }
  return "accepted";
}

inline void expect_refused(const std::string& text, ErrorKind kind, const std::vector<std::string>& parts) {
  const std::string message = refusal(text, kind);
  for (const std::string& part : parts) EXPECT_NE(message.find(part), std::string::npos) << text << ": " << message;
}

// Every pixel's ray the same up to rounding; of all pixels that have one in only one of the two there are few.
inline void expect_equal(const Camera& camera, const Camera& expected, double tolerance = 2e-7,
                         size_t most_one_sided = 0) {
  ASSERT_EQ(camera.size(), expected.size());
  const RayMap a = rays_of(camera), b = rays_of(expected);
  size_t seen = 0, one_sided = 0;
  double worst = 0.0;
  for (size_t i = 0; i < a.directions.size(); ++i) {
    const bool has = a.directions[i] != glm::vec3(0.0F), should = b.directions[i] != glm::vec3(0.0F);
    if (has != should) {
      ++one_sided;
    } else if (has) {
      ++seen;
      worst = std::max(worst, static_cast<double>(glm::distance(a.directions[i], b.directions[i])));
    }
  }
  EXPECT_LE(worst, tolerance);
  EXPECT_LE(one_sided, most_one_sided);
  EXPECT_GT(seen, a.directions.size() / 4);
}

}  // namespace omma
