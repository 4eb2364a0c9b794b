// The renderer as its callers meet it: refusals, several at a time, scenes and cameras that come and go.
#include <limits>

#include "omma/base/error.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

Scene make_wall() {
  SceneMaker maker;
  maker.place(maker.add(make_pane(-2.0f, 1.0f, maker.add(unlit({1, 0, 0, 1})))));
  return maker.finish();
}

class RendererTest : public GpuTest {
 protected:
  void SetUp() override { renderer().load(scene_); }
  const Scene scene_ = make_wall();
  const Camera camera_ = make_camera("equidistant", ImageSize{32, 32});
  const glm::dmat4 pose_{1.0};
};

TEST_F(RendererTest, RefusesOptionsThatMakeNoSense) {
  const RenderOptions refused[] = {
      {.samples = 0},           {.samples = -4},
      {.samples = 1025},        {.samples = std::numeric_limits<int>::max()},
      {.face_size = -1},        {.tile = -1},
      {.technique = "raycats"}, {.technique = "image-based:sean"},
      {.technique = ""},        {.technique = "raycast:fast"},
  };
  for (const RenderOptions& options : refused) {
    EXPECT_THROW(draw(camera_, pose_, {Channel::color}, options), CommandError)
        << options.technique << " " << options.samples << " " << options.tile << " " << options.face_size;
  }
  EXPECT_THROW(draw(camera_, pose_, {}, {}), CommandError);
  try {
    draw(camera_, pose_, {Channel::id}, {.technique = "raycats"});
  } catch (const CommandError& error) {
    EXPECT_NE(std::string(error.what()).find("raycast"), std::string::npos) << error.what();
  }
  // Refusals leave the renderer as it was.
  EXPECT_GE(*draw_ids(camera_, pose_, "raycast").at(16, 16), 0);
}

TEST_F(RendererTest, SaysWhenFacesAreTooLarge) {
  for (const int size : {1 << 20, std::numeric_limits<int>::max()}) {
    EXPECT_THROW(draw(camera_, pose_, {Channel::color}, {.technique = "image-based:passes", .face_size = size}),
                 MachineError);
  }
}

TEST_F(RendererTest, NeedsAScene) {
  Renderer empty;
  const Channel wanted[] = {Channel::color};
  EXPECT_THROW(empty.render(camera_, pose_, wanted, {}), CommandError);
}

TEST_F(RendererTest, UpdateBeforeLoadIsRefused) {
  Renderer empty;
  EXPECT_THROW(empty.update(), CommandError);
}

TEST_F(RendererTest, SeveralLiveAndDieSideBySide) {
  const Channel wanted[] = {Channel::color, Channel::id};
  std::map<std::string, IntImage> before;
  for (const std::string& technique : technique_names_of_today()) {
    if (can_draw(technique, camera_)) before[technique] = draw_ids(camera_, pose_, technique);
  }
  {
    Renderer other;
    other.load(scene_);
    for (const std::string& technique : technique_names_of_today()) {
      if (can_draw(technique, camera_)) other.render(camera_, pose_, wanted, {.technique = technique});
    }
    draw_ids(camera_, pose_, "raycast");  // the other is no longer current when it goes
  }
  Renderer moved;
  moved = Renderer();
  moved.load(scene_);
  moved.render(camera_, pose_, wanted, {});
  for (const auto& [technique, ids] : before) {
    const auto pictures = draw(camera_, pose_, {Channel::color, Channel::id}, {.technique = technique});
    EXPECT_EQ(share_of_differences(std::get<IntImage>(pictures.at(Channel::id)), ids), 0.0) << technique;
    EXPECT_NEAR(*std::get<FloatImage>(pictures.at(Channel::color)).at(16, 16), 1.0f, 1e-3f) << technique;
  }
}

TEST_F(RendererTest, ANewRayMapIsNotTakenForAnOldOne) {
  // The next map likely lies where the last one lay.
  const auto straight_ahead = [](bool ahead) {
    RayMap map{.size = {8, 8}, .directions = {}, .source = {}};
    for (int i = 0; i < 64; ++i) {
      // Around the axis, which pixel (4, 4) has.
      const glm::dvec3 direction(0.001 * (i % 8 - 4), -0.001 * (i / 8 - 4), -1.0);
      map.directions.emplace_back(glm::normalize(ahead ? direction : -direction));
    }
    return Camera(std::move(map));
  };
  for (int i = 0; i < 6; ++i) {
    const bool ahead = i % 2 == 0;
    for (const std::string& technique : technique_names_of_today()) {
      const Camera map = straight_ahead(ahead);
      if (!can_draw(technique, map)) continue;
      const auto pictures = draw(map, pose_, {Channel::id, Channel::distance}, {.technique = technique});
      EXPECT_EQ(*std::get<IntImage>(pictures.at(Channel::id)).at(4, 4) >= 0, ahead) << technique;
      const float distance = *std::get<FloatImage>(pictures.at(Channel::distance)).at(4, 4);
      EXPECT_FLOAT_EQ(distance, ahead ? 2.0f : std::numeric_limits<float>::infinity()) << technique;
    }
  }
}

TEST_F(RendererTest, EveryChannelComesInItsOwnShapeAndSaysNothingWhereThereIsNothing) {
  for (const std::string& technique : technique_names_of_today()) {
    const Camera flat = make_camera("perspective:fov_deg=90", ImageSize{33, 20});
    std::vector<Channel> wanted;
    for (const ChannelInfo& info : channels()) wanted.push_back(info.channel);
    const Camera& camera = can_draw(technique, camera_) ? camera_ : flat;
    const auto pictures = renderer().render(camera, pose_, wanted, {.technique = technique});
    for (const ChannelInfo& info : channels()) {
      const Image& image = pictures.at(info.channel);
      EXPECT_EQ(image_size(image), camera.size()) << info.name;
      EXPECT_EQ(image_components(image), info.components) << info.name;
      EXPECT_EQ(std::holds_alternative<IntImage>(image), info.integer) << info.name;
      if (info.channel == Channel::color) continue;
      // At the left edge, beside the pane.
      for (int c = 0; c < info.components; ++c) {
        const float found =
            info.integer ? float(std::get<IntImage>(image).at(0, 10)[c]) : std::get<FloatImage>(image).at(0, 10)[c];
        EXPECT_EQ(found, info.nothing) << technique << ", " << info.name;
      }
    }
  }
}

TEST_F(RendererTest, ASceneWithoutTrianglesInViewIsBackground) {
  const glm::dmat4 away = translation({0, 0, -100});
  for (const std::string& technique : technique_names_of_today()) {
    const Camera flat = make_camera("perspective:fov_deg=90", ImageSize{33, 20});
    const Camera& camera = can_draw(technique, camera_) ? camera_ : flat;
    const FloatImage color =
        draw_color(camera, away, {.technique = technique, .background = glm::vec3(0.25f, 0.5f, 0.75f)});
    const float* centre = color.at(16, 10);
    EXPECT_NEAR(centre[0], 0.25f, 1e-3f) << technique;
    EXPECT_NEAR(centre[2], 0.75f, 1e-3f) << technique;
  }
}

}  // namespace
}  // namespace omma
