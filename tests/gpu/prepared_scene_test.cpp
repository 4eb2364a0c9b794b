// A prepared scene as its callers meet it: refusals, several at a time, scenes and cameras that come and go.
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "omma/base/error.h"
#include "omma/gl/context.h"
#include "omma/gl/objects.h"
#include "omma/math/pose.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

Scene make_wall() {
  SceneMaker maker;
  maker.place(maker.add(make_pane(-2.0f, 1.0f, maker.add(unlit({1, 0, 0, 1})))));
  return maker.finish();
}

class PreparedSceneTest : public GpuTest {
 protected:
  void SetUp() override { prepare(scene_); }
  const Scene scene_ = make_wall();
  const Camera camera_ = make_camera("equidistant", ImageSize{32, 32});
  const glm::dmat4 pose_{1.0};
};

TEST_F(PreparedSceneTest, RefusesOptionsThatMakeNoSense) {
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
  // Refusals leave everything as it was.
  EXPECT_GE(*draw_ids(camera_, pose_, "raycast").at(16, 16), 0);
}

TEST_F(PreparedSceneTest, SaysWhenFacesAreTooLarge) {
  for (const int size : {1 << 20, std::numeric_limits<int>::max()}) {
    EXPECT_THROW(draw(camera_, pose_, {Channel::color}, {.technique = "image-based:passes", .face_size = size}),
                 MachineError);
  }
}

/// Another picture for each number: other cameras, poses, options; some by OpenGL.
std::map<Channel, Image> numbered_picture(const PreparedScene& scene, int number) {
  static constexpr Channel wanted[] = {Channel::color, Channel::distance};
  constexpr const char* lenses[] = {"equidistant:fov_deg=180", "perspective:fov_deg=80", "equirectangular",
                                    "cylinder:fov_deg=300"};
  const Camera camera = make_camera(lenses[number % 4], ImageSize{80 + number, 60});
  RenderOptions options{.technique = number % 4 == 3 ? "visibility:resolve" : "visibility:cpu",
                        .samples = 1 + number % 3};
  if (number % 2 == 0) options.shadows = Shadows::cube;
  options.shadow_size = 64;
  if (number == 5) options.reflect = 0;
  options.reflection_size = 64;
  const glm::dmat4 pose = look_at_worldFromCamera({0.3 * number - 1.0, 0.5, 0.2}, {0.0, 0.2 * number, -4.0});
  return scene.render(camera, pose, wanted, options);
}

TEST_F(PreparedSceneTest, ViewsOnThreadsEqualThoseOneAfterAnother) {
  const Scene room = load_scene("room");
  const PreparedScene together(device(), room), in_turn(device(), room);
  constexpr int views = 8;
  std::vector<std::map<Channel, Image>> expected;
  for (int view = 0; view < views; ++view) expected.push_back(numbered_picture(in_turn, view));
  for (int round = 0; round < 3; ++round) {
    std::vector<std::map<Channel, Image>> pictures(views);
    std::vector<std::thread> threads;
    for (int view = 0; view < views; ++view) {
      threads.emplace_back([&, view] { pictures[size_t(view)] = numbered_picture(together, view); });
    }
    for (std::thread& thread : threads) thread.join();
    for (size_t view = 0; view < views; ++view) {
      for (const auto& [channel, image] : expected[view]) {
        EXPECT_EQ(std::get<FloatImage>(pictures[view].at(channel)).values, std::get<FloatImage>(image).values)
            << "view " << view << ", round " << round;
      }
    }
  }
}

TEST_F(PreparedSceneTest, ARigInOneCallEqualsItsCamerasOneByOne) {
  const PreparedScene scene(device(), load_scene("room"));
  for (const char* technique : {"visibility:cpu", "nonlinear"}) {
    const RenderOptions options{.technique = technique, .samples = 2, .shadows = Shadows::cube, .shadow_size = 64};
    std::vector<Shot> rig;
    std::vector<std::vector<uint8_t>> colors;
    std::vector<std::vector<float>> distances;
    for (int i = 0; i < 4; ++i) {
      const Camera camera = make_camera("equidistant:fov_deg=170", ImageSize{40 + 10 * i, 40});
      const auto pixels = size_t(camera.size().width) * 40;
      colors.emplace_back(3 * pixels);
      distances.emplace_back(pixels);
      const glm::dmat4 pose = look_at_worldFromCamera({0.1 * i, 0.5, 0.0}, {std::sin(1.6 * i), 0.4, std::cos(1.6 * i)});
      rig.push_back({camera,
                     pose,
                     {{Channel::color, {colors.back().data(), 3 * pixels, 0, PixelFormat::srgb8}},
                      {Channel::distance, {distances.back().data(), 4 * pixels}}}});
    }
    std::vector<RenderStats> stats;
    scene.render(rig, options, &stats);
    ASSERT_EQ(stats.size(), rig.size());
    const Channel wanted[] = {Channel::color, Channel::distance};
    for (size_t i = 0; i < rig.size(); ++i) {
      auto alone = scene.render(rig[i].camera, rig[i].worldFromCamera, wanted, options);
      std::vector<uint8_t> encoded(colors[i].size());
      copy_image(alone.at(Channel::color), {Channel::color, {encoded.data(), encoded.size(), 0, PixelFormat::srgb8}});
      EXPECT_EQ(colors[i], encoded) << technique << " " << i;
      EXPECT_EQ(distances[i], std::get<FloatImage>(alone.at(Channel::distance)).values) << technique << " " << i;
    }
    // One output that does not fit: nothing is drawn of any.
    const std::vector<uint8_t> before = colors[0];
    std::fill(colors[0].begin(), colors[0].end(), uint8_t(7));
    rig.back().outputs.back().to.bytes -= 4;
    EXPECT_THROW(scene.render(rig, options), CommandError);
    EXPECT_EQ(colors[0], std::vector<uint8_t>(before.size(), 7));
    rig.back().outputs.back() = rig.back().outputs.front();
    EXPECT_THROW(scene.render(rig, options), CommandError);
  }
}

TEST_F(PreparedSceneTest, WhatIsStoppedHalfWayHarmsNoPictureAfterIt) {
  const Scene room = load_scene("room");
  const PreparedScene fresh(device(), room);
  const Channel wanted[] = {Channel::color};
  std::vector<Camera> cameras;
  for (int i = 0; i < 5; ++i) {
    cameras.push_back(make_camera("equirectangular:yaw_deg=" + std::to_string(i), ImageSize{160, 80}));
  }
  const glm::dmat4 pose = default_pose(room);
  const RenderOptions options{.technique = "visibility:cpu", .samples = 2, .shadows = Shadows::cube, .shadow_size = 64};
  for (int wait = 0; wait < 8; ++wait) {
    const PreparedScene stopped(device(), room);
    std::vector<ByteImage> images(cameras.size(), ByteImage({160, 80}, 3));
    std::vector<Shot> rig;
    for (size_t i = 0; i < cameras.size(); ++i) {
      std::vector<uint8_t>& bytes = images[i].values;
      rig.push_back({cameras[i], pose, {{Channel::color, {bytes.data(), bytes.size(), 0, PixelFormat::srgb8}}}});
    }
    std::stop_source source;
    RenderOptions once = options;
    once.stop = source.get_token();
    std::thread hand([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(4 * wait));
      source.request_stop();
    });
    try {
      stopped.render(rig, once);
    } catch (const Cancelled&) {
    }
    hand.join();
    for (const Camera& camera : cameras) {
      EXPECT_EQ(std::get<FloatImage>(stopped.render(camera, pose, wanted, options).at(Channel::color)).values,
                std::get<FloatImage>(fresh.render(camera, pose, wanted, options).at(Channel::color)).values)
          << wait;
    }
  }
}

TEST_F(PreparedSceneTest, StopsInEveryTechnique) {
  std::stop_source source;
  source.request_stop();
  for (const std::string& technique : technique_names_of_today()) {
    const Camera flat = make_camera("perspective:fov_deg=90", ImageSize{33, 20});
    const Camera& camera = can_draw(technique, camera_) ? camera_ : flat;
    const RenderOptions stopped{.technique = technique, .stop = source.get_token()};
    EXPECT_THROW(draw(camera, pose_, {Channel::color}, stopped), Cancelled) << technique;
    EXPECT_THROW(draw(camera, pose_, {Channel::id}, stopped), Cancelled) << technique;
    EXPECT_NO_THROW(draw(camera, pose_, {Channel::color}, {.technique = technique})) << technique;
  }
}

TEST_F(PreparedSceneTest, NoPictureHasAPartOfAChange) {
  // Both walls are at one place or both at the other, whichever picture is asked for when.
  SceneMaker maker;
  const int pane = maker.add(make_pane(-2.0f, 0.4f, maker.add(unlit({1, 0, 0, 1}))));
  maker.place(pane);
  maker.place(pane);
  PreparedScene scene(device(), maker.finish());
  const auto stand = [&](double left, double right) {
    scene.edit([&](SceneEdit& edit) {
      edit.move(0, translation({left, 0.0, 0.0}));
      edit.move(1, translation({right, 0.0, 0.0}));
    });
  };
  stand(-1.0, 1.0);
  std::atomic<bool> done = false;
  std::thread host([&] {
    for (int change = 0; !done; ++change) stand(change % 2 == 0 ? 1.0 : -1.0, change % 2 == 0 ? -1.0 : 1.0);
  });
  const Camera camera = make_camera("perspective:fov_deg=90", ImageSize{64, 32});
  const Channel wanted[] = {Channel::object};
  std::set<int> seen;
  // Two that draw all the time do not hold the host up.
  std::thread other([&] {
    while (!done) scene.render(camera, pose_, wanted, {});
  });
  for (int frame = 0; frame < 60 || (seen.size() < 2 && frame < 5000); ++frame) {
    const auto pictures = scene.render(camera, pose_, wanted, {});
    const auto& objects = std::get<IntImage>(pictures.at(Channel::object));
    const int left = *objects.at(16, 16), right = *objects.at(48, 16);
    EXPECT_TRUE((left == 0 && right == 1) || (left == 1 && right == 0)) << left << ", " << right;
    seen.insert(left);
  }
  done = true;
  host.join();
  other.join();
  EXPECT_EQ(seen.size(), 2u);
}

TEST_F(PreparedSceneTest, EveryTechniqueFollowsInstancesAndMeshesThatComeAndGo) {
  const Camera fisheye = make_camera("equidistant:fov_deg=160", ImageSize{72, 60});
  const Camera flat = make_camera("perspective:fov_deg=90", ImageSize{72, 60});
  const Channel wanted[] = {Channel::color, Channel::id};
  for (const std::string& technique : technique_names_of_today()) {
    const Camera& camera = can_draw(technique, fisheye) ? fisheye : flat;
    PreparedScene followed(device(), make_ball_and_pane());
    const auto expect_as_made_anew = [&](const char* what) {
      const RenderOptions options{.technique = technique,
                                  .samples = 1,
                                  .shadows = Shadows::paraboloid,
                                  .shadow_size = 64,
                                  .reflect = 1,
                                  .reflection_size = 32};
      const auto pictures = followed.render(camera, pose_, wanted, options);
      const PreparedScene anew(device(), followed.scene());
      const auto expected = anew.render(camera, pose_, wanted, options);
      EXPECT_EQ(share_of_differences(std::get<IntImage>(pictures.at(Channel::id)),
                                     std::get<IntImage>(expected.at(Channel::id))),
                0.0)
          << technique << ": " << what;
      EXPECT_LE(largest_difference(std::get<FloatImage>(pictures.at(Channel::color)),
                                   std::get<FloatImage>(expected.at(Channel::color))),
                1e-6)
          << technique << ": " << what;
    };
    expect_as_made_anew("as it was");
    uint32_t added = 0;
    followed.edit([&](SceneEdit& edit) { added = edit.add_instance(0, translation({1.5, 0.5, -4.0}), 5); });
    expect_as_made_anew("another ball");
    followed.edit([&](SceneEdit& edit) {
      edit.remove_instance(0);
      Material blue = edit.scene().materials[0];
      blue.base_color = {0.1f, 0.2f, 0.9f, 1.0f};
      edit.set_material(0, blue);
    });
    expect_as_made_anew("the first ball gone, a material");
    followed.edit([&](SceneEdit& edit) {
      edit.move(added, translation({-0.5, 0.2, -3.0}));
      edit.add_instance(edit.add_mesh(make_pane(-3.5f, 0.7f, 0)), translation({0.8, 0.6, 0.0}), 6);
    });
    expect_as_made_anew("a mesh of the host's");
    followed.edit([&](SceneEdit& edit) {
      std::vector<glm::vec3> positions = edit.scene().meshes.back().positions;
      for (glm::vec3& p : positions) p.x *= 0.5f;
      edit.set_vertices(int(edit.scene().meshes.size()) - 1, positions);
      Material veil = edit.scene().materials[1];
      veil.alpha = Material::Alpha::blend;
      veil.base_color.a = 0.5f;
      edit.set_material(1, veil);
    });
    expect_as_made_anew("its vertices moved, a material that lets light through");
  }
}

TEST_F(PreparedSceneTest, WhatWasCurrentIsCurrentAgain) {
  const PreparedScene scene(device(), scene_);
  const Channel wanted[] = {Channel::color};
  const gl::Context mine;
  const gl::Texture texture = gl::Texture::image(GL_RGBA8, {4, 4});
  const auto is_mine = [&] { return glIsTexture(texture.id()) == GL_TRUE; };
  ASSERT_TRUE(is_mine());
  scene.render(camera_, pose_, wanted, {.technique = "raycast"});
  EXPECT_TRUE(is_mine());
  {
    const PreparedScene other(Device(), scene_);
    other.render(camera_, pose_, wanted, {.technique = "raycast"});
  }
  EXPECT_TRUE(is_mine());
  // The device's context can be used by another thread meanwhile.
  std::thread([&] { scene.render(camera_, pose_, wanted, {.technique = "raycast"}); }).join();
  EXPECT_TRUE(is_mine());
}

TEST_F(PreparedSceneTest, SeveralLiveAndDieSideBySide) {
  const Channel wanted[] = {Channel::color, Channel::id};
  std::map<std::string, IntImage> before;
  for (const std::string& technique : technique_names_of_today()) {
    if (can_draw(technique, camera_)) before[technique] = draw_ids(camera_, pose_, technique);
  }
  {
    const Device other_device;
    const PreparedScene other(other_device, scene_);
    for (const std::string& technique : technique_names_of_today()) {
      if (can_draw(technique, camera_)) other.render(camera_, pose_, wanted, {.technique = technique});
    }
    draw_ids(camera_, pose_, "raycast");  // the other is no longer current when it goes
  }
  PreparedScene moved(Device(), scene_);  // which lives on without its device
  moved = PreparedScene(device(), scene_);
  moved.render(camera_, pose_, wanted, {});
  for (const auto& [technique, ids] : before) {
    const auto pictures = draw(camera_, pose_, {Channel::color, Channel::id}, {.technique = technique});
    EXPECT_EQ(share_of_differences(std::get<IntImage>(pictures.at(Channel::id)), ids), 0.0) << technique;
    EXPECT_NEAR(*std::get<FloatImage>(pictures.at(Channel::color)).at(16, 16), 1.0f, 1e-3f) << technique;
  }
}

TEST_F(PreparedSceneTest, ANewRayMapIsNotTakenForAnOldOne) {
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

TEST_F(PreparedSceneTest, EveryChannelComesInItsOwnShapeAndSaysNothingWhereThereIsNothing) {
  for (const std::string& technique : technique_names_of_today()) {
    const Camera flat = make_camera("perspective:fov_deg=90", ImageSize{33, 20});
    std::vector<Channel> wanted;
    for (const ChannelInfo& info : channels()) wanted.push_back(info.channel);
    const Camera& camera = can_draw(technique, camera_) ? camera_ : flat;
    const auto pictures = prepared().render(camera, pose_, wanted, {.technique = technique});
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

TEST_F(PreparedSceneTest, ASceneWithoutTrianglesInViewIsBackground) {
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
