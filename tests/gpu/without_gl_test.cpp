// What the processor draws alone against what OpenGL draws of the same visible triangles.
#include <fmt/core.h>

#include <glm/gtc/matrix_transform.hpp>

#include "omma/base/error.h"
#include "omma/software/software_renderer.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr Channel all_but_color[] = {Channel::distance, Channel::z,  Channel::normal, Channel::position,
                                     Channel::uv,       Channel::id, Channel::object, Channel::material};

/// Masks, panes that cover more and less than half, a normal map, both sides, mirrored and sheared instances.
Scene make_everything() {
  SceneMaker maker;
  Texture leaves;
  leaves.width = leaves.height = 16;
  for (int i = 0; i < 256; ++i) leaves.texels.emplace_back(40, 160, 30, (i / 3 + i / 48) % 2 ? 255 : 0);
  Texture bumps;
  bumps.srgb = false;
  bumps.width = bumps.height = 8;
  for (int i = 0; i < 64; ++i) bumps.texels.emplace_back(i % 2 ? 60 : 200, i / 8 % 2 ? 60 : 200, 200, 255);
  Material masked, bumpy, sheet;
  masked.alpha = Material::Alpha::mask;
  masked.double_sided = true;
  masked.base_color_texture = maker.add(leaves);
  bumpy.normal_texture = maker.add(bumps);
  sheet.double_sided = true;
  Material thin = unlit({1, 0, 0, 0.4f}), thick = unlit({0, 0, 1, 0.7f});
  thin.alpha = thick.alpha = Material::Alpha::blend;
  Mesh ball = make_ball(1.0f, maker.add(bumpy));
  for (const glm::vec3& normal : ball.normals) {
    ball.tangents.emplace_back(glm::normalize(glm::cross(glm::vec3(0.1f, 1.0f, 0.2f), normal)), 1.0f);
  }
  const int ball_number = maker.add(ball);
  const auto pane = [&](const Material& material, float half) {
    return maker.add(make_pane(0.0f, half, maker.add(material)));
  };
  const int leaf_pane = pane(masked, 2.0f), thin_pane = pane(thin, 1.5f), thick_pane = pane(thick, 1.5f);
  const int wall = pane(sheet, 6.0f);
  const glm::dmat4 one(1.0);
  maker.place(wall, translation({0, 0, -9}));
  maker.place(wall, glm::rotate(translation({-7, 0, 0}), 1.2, {0, 1, 0}));
  maker.place(leaf_pane, translation({-2, 0.5, -4}));
  maker.place(leaf_pane, glm::rotate(translation({3, 0, 4}), 2.5, {0.3, 1, 0}));
  maker.place(thin_pane, translation({1, 0, -3}));
  maker.place(thick_pane, translation({2, 1, -5}));
  maker.place(thick_pane, glm::rotate(translation({-1, 1, 5}), 3.0, {0, 1, 0}));
  maker.place(ball_number, translation({1, -1.5, -4}));
  maker.place(ball_number, glm::scale(translation({4, 0, -2}), {-0.6, 1.4, 1.0}));
  maker.place(ball_number, glm::scale(glm::rotate(translation({0, 3, 2}), 0.7, {1, 2, 3}), {1.2, -0.5, 0.8}));
  Scene scene = maker.finish();
  scene.default_from = {0.1, 0.2, 0.3};
  scene.default_to = {0.2, 0.1, -4.0};
  return scene;
}

/// Textures of odd sizes, wrapped every way, of colours, normals, roughness and light, on a mesh with colours of its
/// own; lights of every kind; magnified in front and far smaller than a pixel behind.
Scene make_textured() {
  std::mt19937 random(17);
  SceneMaker maker;
  const auto texture = [&](int width, int height, Texture::Wrap wrap, bool srgb) {
    Texture made;
    made.width = width;
    made.height = height;
    made.wrap_u = wrap;
    made.wrap_v = wrap == Texture::Wrap::clamp ? Texture::Wrap::mirror : wrap;
    made.srgb = srgb;
    for (int i = 0; i < width * height; ++i) {
      made.texels.emplace_back(random() % 256, random() % 256, 128 + random() % 128, 255);
    }
    return maker.add(made);
  };
  constexpr Texture::Wrap wraps[] = {Texture::Wrap::repeat, Texture::Wrap::clamp, Texture::Wrap::mirror};
  for (int i = 0; i < 6; ++i) {
    Material material;
    material.double_sided = true;
    material.base_color_texture = texture(i % 2 ? 8 : 5, i % 2 ? 4 : 7, wraps[i % 3], true);
    if (i >= 2) material.normal_texture = texture(6, 6, wraps[i % 3], false);
    if (i >= 3) material.metallic_roughness_texture = texture(4, 4, wraps[i % 3], false);
    if (i >= 4) material.emissive_texture = texture(3, 5, wraps[i % 3], true);
    material.emissive = glm::vec3(0.3f);
    material.metallic = 0.8f;
    Mesh pane = make_pane(0.0f, 1.0f, maker.add(material));
    for (glm::vec2& uv : pane.uvs) uv = 4.0f * uv - 1.5f;
    pane.tangents.assign(pane.positions.size(), glm::vec4(1, 0, 0, i % 2 ? 1 : -1));
    if (i % 2) pane.colors.assign(pane.positions.size(), glm::u8vec4(200, 100, 250, 255));
    const int number = maker.add(pane);
    const double around = 1.05 * i;
    maker.place(number, glm::rotate(translation({2.5 * std::sin(around), 0, -2.5 * std::cos(around)}), -around,
                                    {0.0, 1.0, 0.0}));
    maker.place(number, glm::rotate(translation({9 * std::sin(around + 0.5), 1, -9 * std::cos(around + 0.5)}),
                                    0.9 - around, {0.1, 1.0, 0.2}));
  }
  Light point, spot, sun;
  point.kind = Light::Kind::point;
  point.position = {0.5, 1.5, 0.0};
  point.color = glm::vec3(6.0f);
  point.range = 9.0f;
  spot.kind = Light::Kind::spot;
  spot.position = {0.0, 1.0, 0.5};
  spot.direction = {0.0, -0.2, -1.0};
  spot.inner_angle = 0.2f;
  spot.color = glm::vec3(20.0f, 15.0f, 10.0f);
  sun.direction = glm::normalize(glm::dvec3(0.3, -1.0, 0.5));
  for (const Light& light : {point, spot, sun}) maker.add(light);
  Scene scene = maker.finish();
  scene.default_from = {0.1, 0.2, 0.3};
  scene.default_to = {0.2, 0.1, -4.0};
  return scene;
}

using Case = std::pair<const char*, Scene (*)()>;
const Case cases[] = {
    {"everything", make_everything},
    {"textured", make_textured},
    {"room", [] { return load_scene("room"); }},
    {"temple", [] { return load_scene("temple"); }},
    {"city", [] { return load_scene("city:blocks=2"); }},
};

class WithoutGlTest : public GpuTest, public ::testing::WithParamInterface<Case> {};

TEST_P(WithoutGlTest, ChannelsAreThoseThatOpenGlWrites) {
  const Scene scene = GetParam().second();
  const glm::dmat4 pose = default_pose(scene);
  prepare(scene);
  size_t seen = 0, ids = 0, labels = 0, nothing = 0;
  double distance = 0.0, z = 0.0, position = 0.0, normal = 0.0, uv = 0.0;
  // As maps all cameras have the same rays here and there: the formulae of a driver's atan are off by more than all
  // else.
  for (const auto& [name, lens] : all_cameras(GetParam().first == std::string("everything") ? 160 : 64)) {
    const Camera camera = as_ray_map(lens);
    RenderStats cpu_stats, gl_stats;
    const auto cpu = prepared().render(camera, pose, all_but_color, {.technique = "visibility:cpu"}, &cpu_stats);
    const auto gl = prepared().render(camera, pose, all_but_color, {.technique = "visibility:resolve"}, &gl_stats);
    EXPECT_TRUE(cpu_stats.renderer.starts_with("the processor")) << cpu_stats.renderer;
    EXPECT_FALSE(gl_stats.renderer.starts_with("the processor")) << gl_stats.renderer;
    const auto whole = [](const auto& pictures, Channel channel, int x, int y) {
      return *std::get<IntImage>(pictures.at(channel)).at(x, y);
    };
    const auto real = [](const auto& pictures, Channel channel, int x, int y) {
      const FloatImage& image = std::get<FloatImage>(pictures.at(channel));
      glm::dvec3 value(0.0);
      for (int c = 0; c < image.components; ++c) value[c] = image.at(x, y)[c];
      return value;
    };
    for (int y = 0; y < camera.size().height; ++y) {
      for (int x = 0; x < camera.size().width; ++x) {
        ids += whole(cpu, Channel::id, x, y) != whole(gl, Channel::id, x, y);
        labels += whole(cpu, Channel::object, x, y) != whole(gl, Channel::object, x, y);
        labels += whole(cpu, Channel::material, x, y) != whole(gl, Channel::material, x, y);
        if (whole(gl, Channel::id, x, y) < 0) {
          for (const Channel channel : all_but_color) {
            if (!channel_info(channel).integer) nothing += real(cpu, channel, x, y) != real(gl, channel, x, y);
          }
          continue;
        }
        ++seen;
        const auto off = [&](Channel channel) {
          return glm::distance(real(cpu, channel, x, y), real(gl, channel, x, y));
        };
        const double metres = real(cpu, Channel::distance, x, y).x;
        const glm::dvec3 point = real(cpu, Channel::position, x, y) - glm::dvec3(pose[3]);
        EXPECT_NEAR(glm::length(point), metres, 1e-5 * metres);
        // A ray that is off by so much meets the surface farther away by this much.
        const glm::dvec3 facing = real(cpu, Channel::normal, x, y);
        const double reach = metres / std::max(0.02, std::abs(glm::dot(facing, point)) / metres);
        const auto raise = [](double& error, double value) { error = std::max(error, value); };
        raise(distance, off(Channel::distance) / reach);
        raise(z, off(Channel::z) / reach);
        raise(position, off(Channel::position) / (reach + glm::length(glm::dvec3(pose[3]))));
        raise(normal, off(Channel::normal));
        raise(uv, off(Channel::uv) / std::max(1.0, glm::length(real(cpu, Channel::uv, x, y))));
      }
    }
  }
  EXPECT_GT(seen, 30000u);
  std::cout << fmt::format(
      "{} pixels; {} ids differ; largest differences: distance {:.1e}, z {:.1e}, position {:.1e}, normal {:.1e}, uv "
      "{:.1e}\n",
      seen, ids, distance, z, position, normal, uv);
  EXPECT_EQ(ids, 0u);
  EXPECT_EQ(labels, 0u);
  EXPECT_EQ(nothing, 0u);
  // Observed: 1.5e-6, 7.8e-7, 6.0e-7. Normals 8.4e-5, of 16 bits a coordinate on the GPU; uv 5.3e-4, on columns a pixel
  // wide, whose corners single precision moves.
  EXPECT_LT(distance, 5e-6);
  EXPECT_LT(z, 5e-6);
  EXPECT_LT(position, 5e-6);
  EXPECT_LT(normal, 3e-4);
  EXPECT_LT(uv, 2e-3);
}

TEST_P(WithoutGlTest, ColorIsThatOfOpenGl) {
  const Scene scene = GetParam().second();
  const glm::dmat4 pose = default_pose(scene);
  prepare(scene);
  std::map<Filter, double> least{{Filter::trilinear, 1000.0}, {Filter::anisotropic, 1000.0}};
  for (const auto& [name, lens] : all_cameras(128)) {
    // Where faces meet, OpenGL interpolates between rays of a map that point apart.
    if (name.starts_with("cube") || name == "eac") continue;
    const Camera camera = as_ray_map(lens);
    for (auto& [filter, decibels] : least) {
      const auto draw = [&, f = filter](const char* technique) {
        return draw_color(camera, pose, {.technique = technique, .samples = 1, .filter = f});
      };
      decibels = std::min(decibels, psnr(draw("visibility:cpu"), draw("visibility:resolve")));
    }
  }
  std::cout << fmt::format("at least {:.1f} dB trilinear, {:.1f} dB anisotropic\n", least.at(Filter::trilinear),
                           least.at(Filter::anisotropic));
  // Observed: 47.0 and 47.3; trilinear 40.2 where textures have odd sizes, of which llvmpipe takes other levels.
  EXPECT_GT(least.at(Filter::trilinear), 38.0);
  EXPECT_GT(least.at(Filter::anisotropic), 45.0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WithoutGlTest, ::testing::ValuesIn(cases),
                         [](const auto& tested) { return test_name(tested.param.first); });

}  // namespace
}  // namespace omma
