// Ray maps: sampled from lenses, read from files good and bad, interpolated.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/camera/ray_bundle.h"
#include "omma/image/npy.h"
#include "tests/unit/camera_samples.h"

namespace omma {
namespace {

class RayMapFile : public testing::Test {
 protected:
  ~RayMapFile() override { std::filesystem::remove(path_); }

  template <typename T>
  void write(std::vector<size_t> shape, const std::vector<T>& values) {
    write_npy<T>(path_, shape, values);
  }

  // The message of the InputError that loading throws.
  std::string error() {
    try {
      load_ray_map(path_);
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(path_.string()), std::string::npos) << e.what();
      return e.what();
    }
    return "no InputError";
  }

  std::filesystem::path path_ = std::filesystem::temp_directory_path() / fmt::format("omma_rays_{}.npy", ::getpid());
};

TEST_F(RayMapFile, HoldsTheRaysOfEveryLens) {
  for (const LensModel& model : lens_models()) {
    for (const auto& [text, camera] : sample_cameras_of_today(model)) {
      const RayMap rays = rays_of(camera);
      ASSERT_EQ(rays.size, camera.size());
      size_t seen = 0;
      for (int y = 0; y < rays.size.height; y += 3) {
        for (int x = 0; x < rays.size.width; x += 3) {
          const glm::dvec2 pixel(x + 0.5, y + 0.5);
          const auto expected = camera.unproject(pixel);
          const auto found = rays.unproject(pixel);
          ASSERT_EQ(expected.has_value(), found.has_value()) << text << ' ' << x << ' ' << y;
          if (!expected) continue;
          ++seen;
          ASSERT_LT(glm::distance(expected->direction, *found), 1e-7) << text << ' ' << x << ' ' << y;
        }
      }
      EXPECT_GT(seen, 1000U) << text;
    }
  }
}

TEST_F(RayMapFile, SamplesARegion) {
  const Camera camera = make_camera("perspective", ImageSize{40, 30});
  const RayMap whole = rays_of(camera), part = rays_of(camera, {10, 20, 25, 30});
  ASSERT_EQ(part.size, (ImageSize{15, 10}));
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 15; ++x) EXPECT_EQ(part.directions[y * 15 + x], whole.directions[(y + 20) * 40 + x + 10]);
  }
  const RayMap shifted = rays_of(camera, {3, 4, 4, 5}, {0.25, -0.125});
  EXPECT_LT(glm::distance(glm::dvec3(shifted.directions[0]), camera.unproject({3.75, 4.375})->direction), 1e-7);
  EXPECT_TRUE(rays_of(camera, {5, 5, 5, 9}).directions.empty());
  const RayMap outside = rays_of(Camera(whole), {-1, 0, 1, 1});
  EXPECT_EQ(outside.directions[0], glm::vec3(0.0F));
  EXPECT_EQ(outside.directions[1], whole.directions[0]);
}

TEST_F(RayMapFile, IsReadAsACamera) {
  const RayMap rays = rays_of(make_camera("equidistant", ImageSize{32, 24}));
  std::vector<double> values;
  for (const glm::vec3& ray : rays.directions) {
    for (int i = 0; i < 3; ++i) values.push_back(7.0 * ray[i]);  // any length
  }
  write<double>({24, 32, 3}, values);
  const Camera camera = make_camera(path_.string());
  EXPECT_EQ(camera.size(), rays.size);
  EXPECT_EQ(camera.lens(), nullptr);
  EXPECT_EQ(to_text(camera), path_.string());
  for (size_t i = 0; i < rays.directions.size(); ++i) {
    EXPECT_LT(glm::distance(camera.ray_map()->directions[i], rays.directions[i]), 2e-7F);
  }
  EXPECT_NEAR(camera.pixels_per_radian(), 24 / 3.14159265358979, 0.1);
  EXPECT_THROW(camera.project({0, 0, -1}), CommandError);
  EXPECT_EQ(make_camera(path_.string(), ImageSize{32, 24}).size(), rays.size);
  EXPECT_THROW(make_camera(path_.string(), ImageSize{64, 48}), CommandError);
  EXPECT_THROW(to_text(Camera(rays)), CommandError);
}

TEST_F(RayMapFile, TakesZeroAndWhatIsNotFiniteForNoRay) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  write<float>({1, 5, 3}, {0, 0, 0, nan, 0, 1, 0, inf, 0, 1e-30F, 0, 0, 0, 3e38F, 3e38F});
  const RayMap map = load_ray_map(path_);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(map.directions[i], glm::vec3(0.0F));
  EXPECT_EQ(map.directions[3], glm::vec3(1, 0, 0));
  EXPECT_NEAR(map.directions[4].z, std::sqrt(0.5), 1e-7);
}

TEST_F(RayMapFile, RefusesOtherArrays) {
  write<float>({2, 3}, {1, 2, 3, 4, 5, 6});
  EXPECT_NE(error().find("the array is (2, 3), a ray map is height x width x 3"), std::string::npos);
  write<float>({1, 2, 4}, {1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_NE(error().find("height x width x 3"), std::string::npos);
  write<float>({0, 2, 3}, {});
  EXPECT_NE(error().find("a height of 0 pixels"), std::string::npos);
  write<float>({1, 70000, 3}, std::vector<float>(210000, 1.0F));
  EXPECT_NE(error().find("a width of 70000 pixels, 1 to 65536"), std::string::npos);
  write<float>({1, 2, 3}, {0, 0, 0, 0, 0, 0});
  EXPECT_NE(error().find("no pixel has a ray"), std::string::npos);
  std::filesystem::remove(path_);
  EXPECT_NE(error().find("no such file"), std::string::npos);
  write_text(path_, "");
  EXPECT_NE(error(), "no InputError");
}

TEST_F(RayMapFile, SurvivesDamage) {
  write<float>({2, 3, 3}, std::vector<float>(18, 0.5F));
  const std::string good = read_file(path_);
  const auto survives = [&](const std::string& bytes) {
    std::ofstream(path_, std::ios::binary) << bytes;
    try {
      load_ray_map(path_);
      return true;
    } catch (const InputError&) {
      return false;  // any other exception fails the test
    }
  };
  for (size_t length = 0; length < good.size(); ++length) {
    EXPECT_FALSE(survives(good.substr(0, length))) << "truncated to " << length;
  }
  size_t refused = 0;
  const size_t header = good.size() - 18 * sizeof(float);
  for (size_t at = 0; at < header; ++at) {
    for (const int value : {0, 1, 127, 255, int{'9'}, int{'('}, int{'-'}}) {
      std::string bytes = good;
      bytes[at] = static_cast<char>(value);
      refused += !survives(bytes);
    }
  }
  EXPECT_GT(refused, 200U);
}

TEST(RayMap, InterpolatesBetweenPixelCentres) {
  RayMap map{.size = {2, 2},
             .directions = {{-0.6F, 0.0F, -0.8F}, {0.6F, 0.0F, -0.8F}, {-0.6F, 0.0F, -0.8F}, {0.6F, 0.0F, -0.8F}},
             .source = {}};
  EXPECT_LT(glm::distance(*map.unproject({0.5, 0.5}), glm::dvec3(-0.6, 0, -0.8)), 1e-7);
  EXPECT_LT(glm::distance(*map.unproject({1.0, 1.0}), glm::dvec3(0, 0, -1)), 1e-7);
  // On to the edge in the same steps: x = -1.2 there, before its length is made 1.
  EXPECT_LT(glm::distance(*map.unproject({0.0, 1.0}), glm::normalize(glm::dvec3(-1.2, 0, -0.8))), 1e-7);
  EXPECT_FALSE(map.unproject({-0.01, 1.0}));
  EXPECT_FALSE(map.unproject({1.0, 2.01}));
  EXPECT_FALSE(map.unproject({std::nan(""), 1.0}));
  map.directions[1] = glm::vec3(0.0F);
  EXPECT_TRUE(map.unproject({0.5, 0.5}));
  EXPECT_FALSE(map.unproject({0.6, 0.5}));
  EXPECT_TRUE(map.unproject({1.2, 1.5}));
  map.directions[1] = {0.6F, 0.0F, 0.8F};
  EXPECT_FALSE(map.unproject({1.0, 0.5})) << "halfway between opposite directions";
}

TEST(RayMap, OfOnePixelHasItsRayEverywhere) {
  const RayMap map{.size = {1, 1}, .directions = {{0.0F, 1.0F, 0.0F}}, .source = {}};
  for (const glm::dvec2& pixel : {glm::dvec2(0, 0), glm::dvec2(0.5, 0.5), glm::dvec2(1, 1)}) {
    EXPECT_EQ(*map.unproject(pixel), glm::dvec3(0, 1, 0));
  }
}

}  // namespace
}  // namespace omma
