#include "tests/gpu/gpu_test.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "omma/base/error.h"
#include "omma/camera/ray_bundle.h"
#include "omma/image/compare.h"
#include "omma/math/pose.h"
#include "omma/technique/registry.h"
#include "tests/proof.h"

namespace omma {
namespace {

/// Mesa's software driver spends most of these tests' time on optimizing programs that draw a few small pictures. What
/// they compute is the same without; the full proof has what users have.
class CompilePlainly : public ::testing::Environment {
  void SetUp() override {
    if (!full_proof()) ::setenv("GALLIVM_PERF", "nopt", 0);
  }
};

[[maybe_unused]] const auto* const compile_plainly = ::testing::AddGlobalTestEnvironment(new CompilePlainly);

}  // namespace

Camera small_camera(const LensModel& model, int side) {
  const ImageSize full = make_camera(model.info.example).size();
  const double scale = double(side) / std::max(full.width, full.height);
  return make_camera(model.info.example,
                     ImageSize{int(std::lround(full.width * scale)), int(std::lround(full.height * scale))});
}

Camera as_ray_map(const Camera& camera) { return Camera(rays_of(camera)); }

Camera wavy_ray_map(int side) {
  RayMap map{.size = {side, 3 * side / 4}, .directions = {}, .source = {}};
  for (int y = 0; y < map.size.height; ++y) {
    for (int x = 0; x < map.size.width; ++x) {
      const double u = (x + 0.5) / side - 0.5, v = (y + 0.5) / side - 0.375;
      const double longitude = 3.1 * u + 0.1 * std::sin(9.0 * v), latitude = 0.3 - 2.2 * v + 0.08 * std::sin(11.0 * u);
      const bool hole = std::hypot(u - 0.2, v + 0.1) < 0.06;
      map.directions.push_back(
          hole ? glm::vec3(0.0f)
               : glm::vec3(glm::normalize(glm::dvec3(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                                     -std::cos(longitude) * std::cos(latitude)))));
    }
  }
  return Camera(std::move(map));
}

std::vector<NamedCamera> all_cameras(int side) {
  std::vector<NamedCamera> cameras;
  for (const LensModel& model : lens_models()) cameras.push_back({model.info.name, small_camera(model, side)});
  const ImageSize size{side, side * 3 / 4};
  cameras.push_back({"turned perspective", make_camera("perspective:yaw_deg=25,pitch_deg=-15,roll_deg=40", size)});
  cameras.push_back({"ray map", wavy_ray_map(side)});
  return cameras;
}

std::vector<std::string> technique_names() {
  std::vector<std::string> names;
  for (const TechniqueInfo& technique : techniques()) {
    if (technique.variants.empty()) names.push_back(technique.name);
    for (const VariantInfo& variant : technique.variants) names.push_back(technique.name + ":" + variant.name);
  }
  return names;
}

std::vector<std::string> technique_names_of_today() {
  std::vector<std::string> names;
  for (const TechniqueInfo& technique : techniques()) {
    if (technique.variants.empty()) names.push_back(technique.name);
    for (size_t i = 0; i < technique.variants.size(); ++i) {
      const std::string name = technique.name + ":" + technique.variants[i].name;
      if (name == "visibility:cpu" || is_proved_today(0, i, technique.variants.size())) names.push_back(name);
    }
  }
  return names;
}

std::vector<std::string> distinct_technique_names() {
  std::vector<std::string> names = technique_names();
  std::erase_if(names, [](const std::string& name) {
    // PiecewiseTest.VariantsDrawTheSamePicture, BoundingShapesTest.DrawWhatRaysMeet, GpuFinderTest, WithoutGlTest
    return (name.starts_with("piecewise:") && name != "piecewise:compute") ||
           (name.starts_with("nonlinear:") && name != "nonlinear:hybrid") || name == "visibility:gpu" ||
           name == "visibility:resolve";
  });
  return names;
}

bool can_draw(const std::string& technique, const Camera& camera) {
  try {
    choose_technique(technique, camera);
    return true;
  } catch (const CommandError&) {
    return false;
  }
}

glm::dmat4 default_pose(const Scene& scene) { return look_at_worldFromCamera(scene.default_from, scene.default_to); }

gl::Program link_compute(const std::string& text) {
  const char* source = text.c_str();
  gl::Program program = gl::Program::wrap(glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source));
  GLint linked = 0;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  std::string log(4096, '\0');
  glGetProgramInfoLog(program.id(), GLsizei(log.size()), nullptr, log.data());
  EXPECT_TRUE(linked) << log;
  return program;
}

std::string test_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return text;
}

namespace {

std::unique_ptr<Device> shared_device;
std::unique_ptr<PreparedScene> shared_scene;

/// GL goes before the process does.
class DeviceEnvironment : public ::testing::Environment {
 public:
  void TearDown() override {
    shared_scene.reset();
    shared_device.reset();
  }
};

[[maybe_unused]] const auto* const environment = ::testing::AddGlobalTestEnvironment(new DeviceEnvironment);

}  // namespace

const Device& GpuTest::device() {
  if (shared_device == nullptr) {
    shared_device = std::make_unique<Device>();
    shared_device->open_gl();
  }
  return *shared_device;
}

void GpuTest::prepare(const Scene& scene) { shared_scene = std::make_unique<PreparedScene>(device(), scene); }

PreparedScene& GpuTest::prepared() { return *shared_scene; }

void GpuTest::follow(const Scene& scene) {
  prepared().edit([&](SceneEdit& edit) {
    for (const Instance& instance : scene.instances) edit.move(instance.key, instance.worldFromObject);
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
      edit.set_vertices(int(m), scene.meshes[m].positions, scene.meshes[m].normals);
    }
    edit.set_lights(scene.lights);
  });
}

IntImage GpuTest::draw_ids(const Camera& camera, const glm::dmat4& pose, const std::string& technique) {
  return std::get<IntImage>(draw(camera, pose, {Channel::id}, {.technique = technique}).at(Channel::id));
}

FloatImage GpuTest::draw_color(const Camera& camera, const glm::dmat4& pose, const RenderOptions& options) {
  return std::get<FloatImage>(draw(camera, pose, {Channel::color}, options).at(Channel::color));
}

std::map<Channel, Image> GpuTest::draw(const Camera& camera, const glm::dmat4& pose,
                                       std::initializer_list<Channel> channels, const RenderOptions& options) {
  return prepared().render(camera, pose, std::vector<Channel>(channels), options);
}

double share_of_differences(const IntImage& a, const IntImage& b) {
  return compare_images(a, b, Scale::raw).mismatch_share;
}

double psnr(const FloatImage& a, const FloatImage& b) { return compare_images(a, b, Scale::display).psnr.value(); }

double largest_difference(const FloatImage& a, const FloatImage& b) {
  return compare_images(a, b, Scale::raw).max.value();
}

}  // namespace omma
