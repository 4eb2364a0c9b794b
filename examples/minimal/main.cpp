// Renders a scene as a 180 degree fisheye sees it: minimal SCENE OUTPUT
#include <array>
#include <cstdio>

#include "omma/base/error.h"
#include "omma/camera/camera.h"
#include "omma/image/write.h"
#include "omma/math/pose.h"
#include "omma/render/prepared_scene.h"
#include "omma/scene/scene.h"
#include "omma/viewpoint/viewpoint.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: minimal SCENE OUTPUT\n");
    return 2;
  }
  try {
    const omma::PreparedScene scene(omma::Device(), omma::load_scene(argv[1]));
    const omma::Camera camera = omma::make_camera("equidistant:fov_deg=180", omma::ImageSize{512, 512});
    const omma::Viewpoint view = omma::default_viewpoint(scene.scene(), camera);
    const glm::dmat4 worldFromCamera = omma::look_at_worldFromCamera(view.from, view.to);

    const std::array wanted{omma::Channel::color};
    const auto images = scene.render(camera, worldFromCamera, wanted, omma::RenderOptions{});
    omma::write_image(argv[2], images.at(omma::Channel::color), omma::Channel::color);
  } catch (const omma::Error& error) {
    std::fprintf(stderr, "minimal: %s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
