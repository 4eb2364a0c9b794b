// Changes of a scene by its host: what follows them equals what is made anew, and what cannot be is refused whole.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "omma/base/error.h"
#include "omma/math/pose.h"
#include "omma/scene/edit.h"
#include "omma/software/software_renderer.h"
#include "tests/gpu/hand_made.h"
#include "tests/gpu/random_scenes.h"
#include "tests/proof.h"

namespace omma {
namespace {

constexpr Channel wanted[] = {Channel::color, Channel::id, Channel::object, Channel::distance};

std::map<Channel, Image> draw(const SoftwareRenderer& renderer) {
  const Camera camera = make_camera("equidistant:fov_deg=240", ImageSize{44, 36});
  return renderer.render(
      camera, glm::dmat4(1.0), wanted,
      {.samples = 1, .shadows = Shadows::cube, .shadow_size = 32, .reflect = 7, .reflection_size = 16});
}

bool are_equal(const Image& a, const Image& b) {
  return std::visit(
      [](const auto& x, const auto& y) {
        if constexpr (std::is_same_v<decltype(x), decltype(y)>) return x.values == y.values;
        return false;
      },
      a, b);
}

/// A host that changes whatever it may, at random.
class RandomHost {
 public:
  explicit RandomHost(unsigned seed) : random_(seed) {}

  /// Makes a change. Returns its name.
  std::string change(SceneEdit& edit) {
    const Scene& scene = edit.scene();
    switch (random_() % 10) {
      case 0:
      case 1:
        if (scene.instances.empty()) return "nothing";
        edit.move(any(scene.instances).key, transform());
        return "move";
      case 2:
        edit.add_instance(number(scene.meshes), transform(), int(random_() % 5));
        return "add an instance";
      case 3:
        if (scene.instances.size() < 3) return "nothing";
        edit.remove_instance(scene.instances[1 + random_() % (scene.instances.size() - 1)].key);
        return "remove an instance";
      case 4: {
        const int mesh = number(scene.meshes);
        std::vector<glm::vec3> positions = scene.meshes[size_t(mesh)].positions;
        for (glm::vec3& p : positions) p += 0.2f * glm::vec3(uniform(), uniform(), uniform());
        edit.set_vertices(mesh, positions);
        return "deform";
      }
      case 5:
        if (scene.meshes.size() < 12) edit.add_instance(edit.add_mesh(ball(scene)), transform(), 7);
        return "add a mesh";
      case 6:
        edit.replace_mesh(number(scene.meshes), ball(scene));
        return "replace a mesh";
      case 7: {
        const int changed = number(scene.materials);
        Material material = scene.materials[size_t(changed)];
        material.base_color = glm::vec4(0.5f + 0.5f * glm::vec3(uniform(), uniform(), uniform()), 0.6f);
        material.double_sided = random_() % 2 == 0;
        material.alpha = Material::Alpha(random_() % 3);
        edit.set_material(changed, material);
        return "change a material";
      }
      case 8: {
        Texture texture{.name = "noise", .width = 4, .height = 2, .texels = {}};
        for (int i = 0; i < 8; ++i) texture.texels.emplace_back(random_(), random_(), random_(), 255);
        Material material = scene.materials.front();
        material.base_color_texture = edit.add_texture(texture);
        edit.add_material(material);
        return "add a texture and a material";
      }
      default:
        light_.kind = Light::Kind::point;
        light_.position = {2.0 * uniform(), 3.0, uniform()};
        light_.color = glm::vec3(9.0f);
        edit.set_lights({light_});
        edit.set_ambient(glm::vec3(0.2f + 0.1f * uniform()));
        return "change the light";
    }
  }

 private:
  float uniform() { return std::uniform_real_distribution<float>(-1.0f, 1.0f)(random_); }
  template <typename T>
  int number(const std::vector<T>& of) {
    return int(random_() % of.size());
  }
  template <typename T>
  const T& any(const std::vector<T>& of) {
    return of[random_() % of.size()];
  }
  glm::dmat4 transform() {
    glm::dmat4 made = glm::rotate(translation(3.0 * glm::dvec3(uniform(), uniform(), uniform())), 3.0 * uniform(),
                                  glm::normalize(glm::dvec3(uniform(), uniform(), 1.5)));
    return glm::scale(made, glm::dvec3(random_() % 3 == 0 ? -0.7 : 1.0, 1.0, 1.0));
  }
  Mesh ball(const Scene& scene) {
    Mesh mesh = make_ball(0.6f, number(scene.materials));
    mesh.triangles.resize(mesh.triangles.size() - random_() % 40);
    return mesh;
  }

  std::mt19937 random_;
  Light light_;
};

TEST(SceneEditTest, WhatFollowsManyChangesEqualsWhatIsMadeAnew) {
  const unsigned hosts = full_proof() ? 20 : 1;
  std::map<std::string, int> seen;
  for (unsigned seed = 0; seed < hosts; ++seed) {
    Scene scene = random_soup(120, 5 + seed);
    scene.instances.front().object = 7;  // there must be one that reflects
    for (Material& material : scene.materials) material.metallic = 0.5f;
    LazySceneIndex index(scene);
    SoftwareRenderer renderer(index);
    RandomHost host(seed);
    std::map<Channel, Image> before;
    for (int change = 0; change < 200; ++change) {
      SceneChanges changes;
      SceneEdit edit(scene, changes);
      std::string what = host.change(edit);
      for (int more = change % 3; more > 1; --more) host.change(edit);  // several that are followed at once
      index.update(changes);
      renderer.update(changes);
      const LazySceneIndex index_anew(scene);
      const SoftwareRenderer anew(index_anew);
      const auto followed = draw(renderer), made = draw(anew);
      for (const Channel channel : wanted) {
        ASSERT_TRUE(are_equal(followed.at(channel), made.at(channel)))
            << what << ", change " << change << " of host " << seed << ", " << channel_info(channel).name;
      }
      seen[what] += before.empty() || !are_equal(before.at(Channel::color), followed.at(Channel::color));
      before = followed;
    }
  }
  for (const char* what : {"move", "add an instance", "remove an instance", "deform", "change a material"}) {
    EXPECT_GT(seen[what], 3) << what << " changes no picture";
  }
}

TEST(SceneEditTest, KeysStayWhenOthersComeAndGo) {
  Scene scene = random_soup(60, 1);
  SceneChanges changes;
  SceneEdit edit(scene, changes);
  const uint32_t first = edit.add_instance(0, glm::dmat4(1.0), 8), second = edit.add_instance(1, glm::dmat4(1.0), 9);
  EXPECT_NE(first, second);
  edit.remove_instance(scene.instances.front().key);
  edit.remove_instance(first);
  edit.move(second, translation({1, 2, 3}));
  EXPECT_EQ(scene.instances.back().object, 9);
  EXPECT_EQ(scene.instances.back().worldFromObject, translation({1, 2, 3}));
  EXPECT_NE(edit.add_instance(0, glm::dmat4(1.0), 1), first);
  EXPECT_THROW(edit.move(first, glm::dmat4(1.0)), CommandError);
  uint32_t triangles = 0;
  for (const Instance& instance : scene.instances) {
    EXPECT_EQ(instance.first_triangle, triangles);
    triangles += uint32_t(scene.meshes[size_t(instance.mesh)].triangles.size());
  }
  edit.set_time(1.0);
  EXPECT_EQ(scene.instances[scene.instances.size() - 2].worldFromObject, translation({1, 2, 3}));
}

/// The message of what `change` throws; the scene and what has changed are as before.
template <typename Change>
std::string refusal(Scene& scene, const Change& change) {
  const Scene before = scene;
  SceneChanges changes;
  SceneEdit edit(scene, changes);
  std::string message;
  try {
    change(edit);
    ADD_FAILURE() << "was not refused";
  } catch (const CommandError& error) {
    message = error.what();
  }
  EXPECT_TRUE(changes.empty()) << message;
  EXPECT_EQ(scene.meshes.size(), before.meshes.size());
  EXPECT_EQ(scene.instances.size(), before.instances.size());
  EXPECT_EQ(scene.materials.size(), before.materials.size());
  EXPECT_EQ(scene.textures.size(), before.textures.size());
  EXPECT_EQ(scene.meshes.front().positions, before.meshes.front().positions);
  EXPECT_EQ(scene.instances.front().worldFromObject, before.instances.front().worldFromObject);
  return message;
}

TEST(SceneEditTest, RefusesWhatCannotBeAndChangesNothing) {
  Scene scene = random_soup(60, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(refusal(scene, [](SceneEdit& e) { e.move(77, glm::dmat4(1.0)); }), "instance 77");
  expect(refusal(scene, [](SceneEdit& e) { e.remove_instance(77); }), "instance 77");
  expect(refusal(scene, [&](SceneEdit& e) { e.move(0, glm::dmat4(double(nan))); }), "finite");
  expect(
      refusal(scene,
              [&](SceneEdit& e) { e.move(0, glm::dmat4(glm::dvec4(1), glm::dvec4(1), glm::dvec4(1), glm::dvec4(1))); }),
      "last row");
  expect(refusal(scene, [](SceneEdit& e) { e.add_instance(9, glm::dmat4(1.0), 0); }), "mesh 9");
  expect(refusal(scene, [](SceneEdit& e) { e.add_instance(0, glm::dmat4(1.0), -2); }), "object -2");
  expect(refusal(scene, [](SceneEdit& e) { e.set_vertices(0, {}); }), "0 positions");
  std::vector<glm::vec3> positions = scene.meshes[0].positions;
  expect(refusal(scene, [&](SceneEdit& e) { e.set_vertices(0, positions, std::vector(1, glm::vec3(0))); }),
         "1 normals");
  positions[3].y = nan;
  expect(refusal(scene, [&](SceneEdit& e) { e.set_vertices(0, positions); }), "position 3");
  Mesh mesh = scene.meshes[0];
  mesh.triangles[1].y = uint32_t(mesh.positions.size());
  expect(refusal(scene, [&](SceneEdit& e) { e.add_mesh(mesh); }), "triangle 1");
  mesh = scene.meshes[0];
  mesh.normals.pop_back();
  expect(refusal(scene, [&](SceneEdit& e) { e.replace_mesh(0, mesh); }), "normals");
  mesh = scene.meshes[0];
  mesh.material = 50;
  expect(refusal(scene, [&](SceneEdit& e) { e.add_mesh(mesh); }), "material 50");
  Material material;
  material.normal_texture = 3;
  expect(refusal(scene, [&](SceneEdit& e) { e.add_material(material); }), "texture 3");
  expect(refusal(scene, [&](SceneEdit& e) { e.set_material(-1, {}); }), "material -1");
  expect(refusal(scene, [&](SceneEdit& e) { e.add_texture({.name = "t", .width = 2, .height = 2, .texels = {}}); }),
         "'t'");
  Light light;
  light.node = 999;
  expect(refusal(scene, [&](SceneEdit& e) { e.set_lights({light}); }), "node 999");
  expect(refusal(scene, [&](SceneEdit& e) { e.set_ambient(glm::vec3(nan)); }), "finite");
}

}  // namespace
}  // namespace omma
