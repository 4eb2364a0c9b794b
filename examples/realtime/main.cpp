// A loop that follows a camera and never lets it wait: a picture that is drawn when the camera moves is given up, and
// while the camera stands still its picture gets better. Prints what a window would show: realtime SCENE
//
// Here a second thread turns the camera; in a program with a window it is whoever moves the mouse.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"
#include "omma/viewpoint/viewpoint.h"

namespace {

using namespace std::chrono_literals;

/// What the hand does and what the picture is drawn for.
class Controls {
 public:
  void turn(double degrees) {
    const std::lock_guard lock(mutex_);
    degrees_ = degrees;
    moved_.request_stop();  // whatever is being drawn is of the past
  }
  /// Where the camera is, and what says that it has moved on.
  std::pair<double, std::stop_token> now() {
    const std::lock_guard lock(mutex_);
    if (moved_.stop_requested()) moved_ = std::stop_source();
    return {degrees_, moved_.get_token()};
  }

 private:
  std::mutex mutex_;
  double degrees_ = 0.0;
  std::stop_source moved_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: realtime SCENE\n");
    return 2;
  }
  try {
    const omma::ImageSize size{320, 240};
    const omma::PreparedScene scene(omma::Device(), omma::load_scene(argv[1]));
    const omma::Camera lens = omma::make_camera("equidistant:fov_deg=180", size);
    const omma::Viewpoint stand = omma::default_viewpoint(scene.scene(), lens);

    // What a window shows: pixels of four bytes, the bottom row first, as OpenGL takes them.
    std::vector<uint8_t> window(size_t(4 * size.width * size.height));
    const omma::Output output{
        omma::Channel::color,
        {.pixels = window.data(), .bytes = window.size(), .format = omma::PixelFormat::srgba8, .bottom_up = true}};
    Controls controls;
    std::jthread hand([&] {
      for (int step = 1; step <= 20; ++step) {
        std::this_thread::sleep_for(10ms);
        controls.turn(3.0 * step);  // to 60 degrees in the end
      }
    });

    int shown = 0, given_up = 0, best = 0;
    const std::vector<int> refinement = omma::refinement(16);
    double drawn_at = -1.0;
    while (drawn_at < 60.0 || best < refinement.back()) {
      const auto [degrees, moved] = controls.now();
      if (drawn_at != degrees) best = 0;
      drawn_at = degrees;
      const double angle = glm::radians(degrees);
      const glm::dvec3 ahead(std::sin(angle), 0.0, -std::cos(angle));
      const omma::Shot shot{lens, omma::look_at_worldFromCamera(stand.from, stand.from + ahead), {output}};
      if (best == refinement.back()) std::this_thread::sleep_for(1ms);  // until something moves
      for (const int samples : refinement) {
        if (samples <= best) continue;  // it is there already
        omma::RenderOptions options;
        options.samples = samples;
        options.stop = moved;
        try {
          scene.render(shot, options);
          best = samples;
          ++shown;
        } catch (const omma::Cancelled&) {
          ++given_up;
          break;
        }
      }
    }
    std::printf("%d pictures shown, the last with %d samples a pixel; %d given up\n", shown, best, given_up);
  } catch (const omma::Error& error) {
    std::fprintf(stderr, "realtime: %s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
