// Eight calibrated cameras around a vehicle, drawn in one call: colour as bytes for a detector, distances in metres and
// labels beside it, all into memory of this program's. Writes the pictures of the first: rig SCENE FOLDER
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "omma/base/error.h"
#include "omma/image/write.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"
#include "omma/viewpoint/viewpoint.h"

namespace {

constexpr int cameras = 8;
constexpr omma::ImageSize size{480, 300};

/// The pixels of one camera.
struct Pictures {
  omma::ByteImage color{size, 3};
  omma::Image distance = omma::make_image(omma::Channel::distance, size);
  omma::Image object = omma::make_image(omma::Channel::object, size);
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: rig SCENE FOLDER\n");
    return 2;
  }
  try {
    const omma::PreparedScene scene(omma::Device(), omma::load_scene(argv[1]));
    const omma::Camera lens = omma::make_camera("opencv_fisheye:f=150,k1=0.05,k2=-0.01", size);
    const glm::dvec3 middle = omma::default_viewpoint(scene.scene(), lens).from;

    std::vector<Pictures> pictures(cameras);
    std::vector<omma::Shot> rig;
    for (size_t i = 0; i < cameras; ++i) {
      const double angle = 2.0 * 3.141592653589793 * double(i) / cameras;
      const glm::dvec3 outwards(std::sin(angle), 0.0, -std::cos(angle));
      const glm::dvec3 place = middle + 0.5 * outwards;
      std::vector<uint8_t>& bytes = pictures[i].color.values;
      rig.push_back(
          {lens,
           omma::look_at_worldFromCamera(place, place + outwards - glm::dvec3(0.0, 0.1, 0.0)),
           {{omma::Channel::color, {.pixels = bytes.data(), .bytes = bytes.size(), .format = omma::PixelFormat::srgb8}},
            {omma::Channel::distance, omma::buffer_of(pictures[i].distance)},
            {omma::Channel::object, omma::buffer_of(pictures[i].object)}}});
    }

    omma::RenderOptions options;
    options.samples = 1;
    scene.render(rig, options);  // sorts the scene, too
    const auto begin = std::chrono::steady_clock::now();
    scene.render(rig, options);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    std::printf("%d cameras of %d x %d with distances and labels: %.1f ms\n", cameras, size.width, size.height,
                took.count());

    const std::filesystem::path folder(argv[2]);
    omma::write_image(folder / "front.png", pictures[0].color);
    omma::write_image(folder / "front_distance.npy", pictures[0].distance, omma::Channel::distance);
    omma::write_image(folder / "front_object.png", pictures[0].object, omma::Channel::object);
  } catch (const omma::Error& error) {
    std::fprintf(stderr, "rig: %s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
