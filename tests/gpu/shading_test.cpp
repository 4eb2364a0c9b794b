// Colours that can be worked out by hand, in every technique: materials, lights, coverage.
#include <fmt/core.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/gpu/gpu_test.h"
#include "tests/gpu/hand_made.h"

namespace omma {
namespace {

constexpr double pi = glm::pi<double>();
const glm::vec3 backdrop(0.125f, 0.25f, 0.5f);

/// Colours pass through half floats, which hold eleven bits.
constexpr double half_float = 1e-3;

/// 64 pixels a side, flat and curved; the camera stands at the origin and looks along -Z.
Camera flat_camera() { return make_camera("perspective:fov_deg=60", ImageSize{64, 64}); }
Camera round_camera() { return make_camera("equidistant:fov_deg=120,fit=width", ImageSize{64, 64}); }

class ShadingTest : public GpuTest, public ::testing::WithParamInterface<std::string> {
 protected:
  static std::vector<Camera> cameras() {
    std::vector<Camera> list;
    for (const Camera& camera : {flat_camera(), round_camera()}) {
      // Straight edges leave out or bend a pane that fills the view.
      const bool bends = GetParam() == "vertex" && !can_draw("planar", camera);
      if (can_draw(GetParam(), camera) && !bends) list.push_back(camera);
    }
    return list;
  }

  static std::map<Channel, Image> look(const Scene& scene, const Camera& camera, int samples = 4) {
    prepare(scene);
    return draw(
        camera, glm::dmat4(1.0), {Channel::color, Channel::id, Channel::object, Channel::normal},
        {.technique = GetParam(), .samples = samples, .pieces = {.tolerance_px = 0.02}, .background = backdrop});
  }

  static void expect_color(const std::map<Channel, Image>& pictures, int x, int y, const glm::dvec3& expected,
                           double tolerance = half_float) {
    const float* found = std::get<FloatImage>(pictures.at(Channel::color)).at(x, y);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(found[c], expected[c], tolerance * std::max(1.0, expected[c]))
          << "component " << c << " at " << x << ", " << y;
    }
  }
  static int label(const std::map<Channel, Image>& pictures, Channel channel, int x, int y) {
    return *std::get<IntImage>(pictures.at(channel)).at(x, y);
  }
};

TEST_P(ShadingTest, UnlitColorsAndTheBackgroundComeThroughUnchanged) {
  SceneMaker maker;
  maker.place(maker.add(make_pane(-2.0f, 0.5f, maker.add(unlit({0.2f, 0.4f, 0.8f, 1.0f})))));
  const Scene scene = maker.finish();
  for (const Camera& camera : cameras()) {
    for (const int samples : {1, 3, 4, 7}) {
      const auto pictures = look(scene, camera, samples);
      expect_color(pictures, 32, 32, {0.2, 0.4, 0.8});
      expect_color(pictures, 4, 32, backdrop);
      EXPECT_EQ(label(pictures, Channel::id, 4, 32), -1);
      EXPECT_GE(label(pictures, Channel::id, 32, 32), 0);
    }
  }
}

TEST_P(ShadingTest, VertexColorsMultiplyAndAreInterpolated) {
  SceneMaker maker;
  Mesh pane = make_pane(-2.0f, 4.0f, maker.add(unlit({0.5f, 1.0f, 1.0f, 1.0f})));
  // Red grows with x, green with y; blue is full.
  pane.colors = {{0, 0, 255, 255}, {255, 0, 255, 255}, {255, 255, 255, 255}, {0, 255, 255, 255}};
  maker.place(maker.add(pane));
  const Scene scene = maker.finish();
  for (const Camera& camera : cameras()) {
    const auto pictures = look(scene, camera, 1);
    for (const auto& [x, y] : {std::pair{32, 32}, {20, 40}, {44, 26}}) {
      // The naive technique interpolates by distance instead of depth: right on its axis only.
      if (GetParam() == "vertex" && x != 32) continue;
      const glm::dvec3 d = camera.unproject({x + 0.5, y + 0.5})->direction, p = d * (-2.0 / d.z);
      const double tolerance = GetParam().starts_with("image-based") ? 0.01 : 2e-3;
      expect_color(pictures, x, y, {0.5 * (p.x / 8.0 + 0.5), p.y / 8.0 + 0.5, 1.0}, tolerance);
    }
  }
}

TEST_P(ShadingTest, EmissionIsAddedToLight) {
  SceneMaker maker;
  Material lamp;
  lamp.base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  lamp.emissive = glm::vec3(1.5f, 0.25f, 3.0f);
  lamp.roughness = 1.0f;
  maker.place(maker.add(make_pane(-2.0f, 2.0f, maker.add(lamp))));
  Light dark;
  dark.color = glm::vec3(0.0f);
  maker.add(dark);
  const Scene scene = maker.finish();
  for (const Camera& camera : cameras()) expect_color(look(scene, camera), 32, 32, {1.5, 0.25, 3.0});
}

/// A pane of albedo `rho` at distance 2, as rough as can be, under one light.
Scene lit_pane(const glm::vec3& rho, const Light& light, const glm::vec3& ambient = glm::vec3(0.0f)) {
  SceneMaker maker;
  Material paint;
  paint.base_color = glm::vec4(rho, 1.0f);
  paint.roughness = 1.0f;
  maker.place(maker.add(make_pane(-2.0f, 8.0f, maker.add(paint))));
  maker.add(light);
  maker.scene().ambient = ambient;
  return maker.finish();
}

/// Roughness 1 leaves of GGX a constant, 1/π; Smith's masking is then 1 / (2 (n·l + n·v)); Schlick's Fresnel 0.04 + …
double reflected(double rho, double n_l, double n_v, double v_h) {
  const double fresnel = 0.04 + 0.96 * std::pow(1.0 - v_h, 5.0);
  return n_l / pi * (rho + fresnel * 0.5 / (n_l + n_v));
}

TEST_P(ShadingTest, ASunGivesLambertAndASheen) {
  for (const double tilt_deg : {0.0, 60.0}) {
    const double tilt = glm::radians(tilt_deg);
    Light sun;
    sun.direction = glm::dvec3(-std::sin(tilt), 0.0, -std::cos(tilt));
    sun.color = glm::vec3(2.0f, 1.0f, 0.5f);
    const Scene scene = lit_pane({0.5f, 0.25f, 0.75f}, sun);
    for (const Camera& camera : cameras()) {
      const glm::dvec3 d = camera.unproject({32.5, 32.5})->direction, to_sun = -sun.direction;
      const double n_v = -d.z, v_h = glm::dot(glm::normalize(to_sun - d), -d);
      glm::dvec3 expected;
      for (int c = 0; c < 3; ++c) {
        expected[c] = sun.color[c] * reflected(glm::dvec3(0.5, 0.25, 0.75)[c], std::cos(tilt), n_v, v_h);
      }
      expect_color(look(scene, camera), 32, 32, expected);
    }
  }
}

TEST_P(ShadingTest, AmbientLightIsStrongerFromAbove) {
  Light dark;
  dark.color = glm::vec3(0.0f);
  // Upright: three quarters of it, on albedo and on the 4% that everything reflects.
  const Scene scene = lit_pane(glm::vec3(0.5f), dark, glm::vec3(0.4f, 0.8f, 1.2f));
  for (const Camera& camera : cameras()) {
    expect_color(look(scene, camera), 32, 32, glm::dvec3(0.4, 0.8, 1.2) * 0.75 * (0.5 + 0.04));
  }
}

TEST_P(ShadingTest, APointLightFallsOffWithDistanceAndEndsAtItsRange) {
  Light point;
  point.kind = Light::Kind::point;
  point.color = glm::vec3(12.0f);
  for (const float range : {0.0f, 4.0f, 2.0f}) {
    point.range = range;
    const Scene scene = lit_pane(glm::vec3(0.5f), point);
    for (const Camera& camera : cameras()) {
      const glm::dvec3 d = camera.unproject({32.5, 32.5})->direction;
      const double distance = -2.0 / d.z, cosine = -d.z;
      const double share = range > 0.0f ? 1.0 - std::pow(distance / range, 4.0) : 1.0;
      const double window = share > 0.0 ? share * share : 0.0;
      // The light is where the eye is: n·l = n·v and h = v.
      const double expected = 12.0 / (distance * distance) * window * reflected(0.5, cosine, cosine, 1.0);
      expect_color(look(scene, camera), 32, 32, glm::dvec3(expected));
    }
  }
}

TEST_P(ShadingTest, ASpotFadesBetweenItsInnerAndOuterAngle) {
  Light spot;
  spot.kind = Light::Kind::spot;
  spot.direction = {0, 0, -1};
  spot.color = glm::vec3(12.0f);
  spot.inner_angle = 0.1f;
  spot.outer_angle = 0.4f;
  const Scene scene = lit_pane(glm::vec3(0.5f), spot);
  if (GetParam() == "vertex")
    GTEST_SKIP() << "it interpolates positions by distance instead of depth: right on the axis only";
  for (const Camera& camera : cameras()) {
    const auto pictures = look(scene, camera, 1);
    size_t dark = 0, half_lit = 0, full = 0;
    for (int x = 2; x < 62; x += 3) {
      const glm::dvec3 d = camera.unproject({x + 0.5, 32.5})->direction;
      const double distance = -2.0 / d.z, cosine = -d.z;
      const double outer = std::cos(double(spot.outer_angle)), inner = std::cos(double(spot.inner_angle));
      const double t = glm::clamp((cosine - outer) / (inner - outer), 0.0, 1.0), share = t * t * (3.0 - 2.0 * t);
      (share == 0.0 ? dark : share == 1.0 ? full : half_lit) += 1;
      const double expected = 12.0 / (distance * distance) * share * reflected(0.5, cosine, cosine, 1.0);
      expect_color(pictures, x, 32, glm::dvec3(expected), GetParam().starts_with("image-based") ? 0.02 : 2e-3);
    }
    EXPECT_GT(dark, 0u);
    EXPECT_GT(half_lit, 0u);
    EXPECT_GT(full, 0u);
  }
}

TEST_P(ShadingTest, BackFacesAreSeenOnlyWhereTwoSided) {
  for (const bool double_sided : {false, true}) {
    for (const bool turned : {false, true}) {
      for (const bool mirrored : {false, true}) {
        SCOPED_TRACE(fmt::format("double sided {}, turned {}, mirrored {}", double_sided, turned, mirrored));
        SceneMaker maker;
        Material material = unlit({1, 0, 0, 1});
        material.double_sided = double_sided;
        const int pane = maker.add(make_pane(0.0f, 1.0f, maker.add(material)));
        glm::dmat4 place = translation({0, 0, -2});
        if (turned) place = glm::rotate(place, pi, {0, 1, 0});
        if (mirrored) place = glm::scale(place, {-1, 1, 1});
        maker.place(pane, place);
        const Scene scene = maker.finish();
        for (const Camera& camera : cameras()) {
          const auto pictures = look(scene, camera);
          const bool seen = double_sided || !turned;
          EXPECT_EQ(label(pictures, Channel::id, 32, 32) >= 0, seen);
          expect_color(pictures, 32, 32, seen ? glm::dvec3(1, 0, 0) : glm::dvec3(backdrop));
          if (!seen) continue;
          const float* normal = std::get<FloatImage>(pictures.at(Channel::normal)).at(32, 32);
          EXPECT_NEAR(normal[2], 1.0, 1e-4);  // towards the camera, whichever side that is
        }
      }
    }
  }
}

TEST_P(ShadingTest, HolesShowWhatIsBehind) {
  SceneMaker maker;
  Texture lattice;
  lattice.width = lattice.height = 2;
  lattice.wrap_u = lattice.wrap_v = Texture::Wrap::clamp;
  lattice.texels = {{255, 255, 255, 0}, {255, 255, 255, 255}, {255, 255, 255, 255}, {255, 255, 255, 0}};
  Material masked = unlit({1, 1, 0, 1});
  masked.base_color_texture = maker.add(lattice);
  masked.alpha = Material::Alpha::mask;
  const int front = maker.place(maker.add(make_pane(-2.0f, 0.8f, maker.add(masked))));
  const int back = maker.place(maker.add(make_pane(-3.0f, 1.2f, maker.add(unlit({0, 0, 1, 1})))));
  const Scene scene = maker.finish();
  for (const Camera& camera : cameras()) {
    for (const int samples : {1, 4}) {
      const auto pictures = look(scene, camera, samples);
      // The texture's first texel is at the pane's top left.
      const double quarter = 0.4;
      for (const bool right : {false, true}) {
        for (const bool down : {false, true}) {
          const glm::dvec3 towards(right ? quarter : -quarter, down ? -quarter : quarter, -2.0);
          const glm::dvec2 pixel = *camera.project(towards);
          const bool hole = right == down;
          EXPECT_EQ(label(pictures, Channel::object, int(pixel.x), int(pixel.y)), hole ? back : front);
          expect_color(pictures, int(pixel.x), int(pixel.y), hole ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 1, 0));
        }
      }
    }
  }
}

TEST_P(ShadingTest, BlendedPanesLieOverEachOtherInTheOrderOfTheirDistance) {
  const glm::dvec3 red(0.9, 0.1, 0.0), green(0.0, 0.8, 0.2);
  for (const bool far_first : {false, true}) {
    SceneMaker maker;
    Material near_pane = unlit(glm::vec4(glm::vec3(red), 0.6f)), far_pane = unlit(glm::vec4(glm::vec3(green), 0.25f));
    near_pane.alpha = far_pane.alpha = Material::Alpha::blend;
    const int near_mesh = maker.add(make_pane(-2.0f, 1.0f, maker.add(near_pane)));
    const int far_mesh = maker.add(make_pane(-3.0f, 1.5f, maker.add(far_pane)));
    for (const int mesh : far_first ? std::vector{far_mesh, near_mesh} : std::vector{near_mesh, far_mesh}) {
      maker.place(mesh);
    }
    const int wall = maker.place(maker.add(make_pane(-4.0f, 0.7f, maker.add(unlit({0, 0, 1, 1})))));
    const Scene scene = maker.finish();
    const int near_object = far_first ? 1 : 0;
    for (const Camera& camera : cameras()) {
      for (const int samples : {1, 4}) {
        const auto pictures = look(scene, camera, samples);
        const auto over = [&](const glm::dvec3& behind) { return 0.6 * red + 0.4 * (0.25 * green + 0.75 * behind); };
        expect_color(pictures, 32, 32, over({0, 0, 1}), 2 * half_float);
        const glm::dvec2 beside = *camera.project({0.8, 0.0, -2.0});
        expect_color(pictures, int(beside.x), 32, over(backdrop), 2 * half_float);
        // Labels take a blended surface for solid from one half on.
        EXPECT_EQ(label(pictures, Channel::object, 32, 32), near_object);
        EXPECT_NE(near_object, wall);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, ShadingTest, ::testing::ValuesIn(technique_names_of_today()),
                         [](const auto& tested) { return test_name(tested.param); });

}  // namespace
}  // namespace omma
