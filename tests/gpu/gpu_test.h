// What all tests that draw share: one device for the process, every camera, every technique.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/gl/program.h"
#include "omma/render/prepared_scene.h"
#include "omma/scene/scene.h"

namespace omma {

struct NamedCamera {
  std::string name;
  Camera camera;
};

/// The lens's own example, its longer side scaled to `side` pixels.
Camera small_camera(const LensModel& model, int side);

/// The rays of a lens, measured: no formula stands behind them any more.
Camera as_ray_map(const Camera& camera);

/// A ray map that no lens makes: tilted, wavy, with a hole.
Camera wavy_ray_map(int side);

/// Every lens, a lens turned within its camera, and a ray map, `side` pixels on the longer side.
std::vector<NamedCamera> all_cameras(int side);

/// Every technique in every variant, as render takes it.
std::vector<std::string> technique_names();
/// Each technique, by one of its variants each day (tests/proof.h); by all in the full proof. What `auto` takes without
/// a GPU is always among them.
std::vector<std::string> technique_names_of_today();
/// Those without the variants that tests of their own show to draw the same picture, only slower.
std::vector<std::string> distinct_technique_names();
bool can_draw(const std::string& technique, const Camera& camera);

/// Where the scene says to stand.
glm::dmat4 default_pose(const Scene& scene);

/// A compute program of this text. The test fails with the linker's words where it does not link.
gl::Program link_compute(const std::string& text);

/// A name that GoogleTest accepts.
std::string test_name(std::string text);

class GpuTest : public ::testing::Test {
 protected:
  /// Opened by the first test that asks. Its programs serve all tests after it: compiling them takes longer than
  /// drawing.
  static const Device& device();
  /// What the others draw from now on.
  static void prepare(const Scene& scene);
  static PreparedScene& prepared();
  /// Moves what is prepared to where the instances, vertices and lights of `scene` are, which is otherwise the same.
  static void follow(const Scene& scene);
  static IntImage draw_ids(const Camera& camera, const glm::dmat4& pose, const std::string& technique);
  static FloatImage draw_color(const Camera& camera, const glm::dmat4& pose, const RenderOptions& options);
  static std::map<Channel, Image> draw(const Camera& camera, const glm::dmat4& pose,
                                       std::initializer_list<Channel> channels, const RenderOptions& options);
};

/// Share of pixels whose numbers differ.
double share_of_differences(const IntImage& a, const IntImage& b);
/// Decibels, as a screen shows the pictures.
double psnr(const FloatImage& a, const FloatImage& b);
/// Largest |a - b| over all components.
double largest_difference(const FloatImage& a, const FloatImage& b);

}  // namespace omma
