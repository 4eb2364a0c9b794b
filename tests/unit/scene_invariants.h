// What holds for every scene, however it came to be.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "omma/scene/scene.h"

namespace omma {

inline bool is_finite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

inline void expect_sound(const Mesh& mesh, const Scene& scene) {
  SCOPED_TRACE("mesh " + mesh.name);
  const size_t count = mesh.positions.size();
  ASSERT_EQ(mesh.normals.size(), count);
  for (const size_t size : {mesh.tangents.size(), mesh.uvs.size(), mesh.colors.size()}) {
    EXPECT_TRUE(size == 0 || size == count) << size << " of " << count;
  }
  ASSERT_FALSE(mesh.triangles.empty());
  size_t out_of_range = 0, not_finite = 0, not_unit = 0;
  for (const glm::uvec3& t : mesh.triangles) out_of_range += t.x >= count || t.y >= count || t.z >= count;
  for (size_t i = 0; i < count; ++i) {
    const glm::vec3 p = mesh.positions[i];
    not_finite += !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
    not_unit += !(std::abs(glm::length(mesh.normals[i]) - 1.0f) < 1e-4f);
    if (!mesh.uvs.empty()) not_finite += !std::isfinite(mesh.uvs[i].x) || !std::isfinite(mesh.uvs[i].y);
    if (!mesh.tangents.empty()) {
      not_unit += !(std::abs(glm::length(glm::vec3(mesh.tangents[i])) - 1.0f) < 1e-4f);
      not_unit += std::abs(mesh.tangents[i].w) != 1.0f;
    }
  }
  EXPECT_EQ(out_of_range, 0u);
  EXPECT_EQ(not_finite, 0u);
  EXPECT_EQ(not_unit, 0u);
  ASSERT_GE(mesh.material, 0);
  ASSERT_LT(mesh.material, static_cast<int>(scene.materials.size()));
  if (mesh.skin) {
    ASSERT_EQ(mesh.skin->vertex_joints.size(), count);
    ASSERT_EQ(mesh.skin->vertex_weights.size(), count);
    for (size_t i = 0; i < count; ++i) {
      const glm::vec4 w = mesh.skin->vertex_weights[i];
      const float sum = w.x + w.y + w.z + w.w;
      ASSERT_TRUE(sum == 0.0f || std::abs(sum - 1.0f) < 1e-4f);
      for (int k = 0; k < 4; ++k) ASSERT_LT(mesh.skin->vertex_joints[i][k], mesh.skin->joints.size());
    }
    for (const Skin::Joint& joint : mesh.skin->joints) {
      ASSERT_GE(joint.node, 0);
      ASSERT_LT(joint.node, static_cast<int>(scene.nodes.size()));
    }
  }
  for (const MorphTarget& target : mesh.morph_targets) EXPECT_EQ(target.position_offsets.size(), count);
  EXPECT_EQ(mesh.deforms(), mesh.skin.has_value() || !mesh.morph_targets.empty());
}

inline void expect_sound(const Scene& scene) {
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    EXPECT_LT(scene.nodes[i].parent, static_cast<int>(i));
    EXPECT_TRUE(is_finite(scene.nodes[i].worldFromNode)) << scene.nodes[i].name;
  }
  for (const Mesh& mesh : scene.meshes) expect_sound(mesh, scene);
  uint32_t first = 0;
  int object = -1;
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(static_cast<size_t>(instance.mesh), scene.meshes.size());
    ASSERT_LT(static_cast<size_t>(instance.node), scene.nodes.size());
    EXPECT_EQ(instance.first_triangle, first);
    first += static_cast<uint32_t>(scene.meshes[static_cast<size_t>(instance.mesh)].triangles.size());
    EXPECT_TRUE(instance.object == object || instance.object == object + 1);
    object = instance.object;
  }
  EXPECT_EQ(scene.triangle_count(), first);
  EXPECT_GT(first, 0u);
  for (const Material& material : scene.materials) {
    for (const int texture : {material.base_color_texture, material.normal_texture, material.metallic_roughness_texture,
                              material.emissive_texture}) {
      EXPECT_GE(texture, -1);
      EXPECT_LT(texture, static_cast<int>(scene.textures.size()));
    }
  }
  for (const Texture& texture : scene.textures) {
    EXPECT_GT(texture.width, 0);
    EXPECT_EQ(texture.texels.size(), static_cast<size_t>(texture.width) * static_cast<size_t>(texture.height));
  }
  for (const SceneCamera& camera : scene.cameras) {
    const glm::dmat3 axes(camera.worldFromCamera);
    EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-9) << camera.name;
    EXPECT_NEAR(glm::length(axes[0]), 1.0, 1e-9) << camera.name;
  }
  for (const Light& light : scene.lights) EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-9);
  EXPECT_NE(scene.default_from, scene.default_to);
  EXPECT_FALSE(scene.bounds().empty());
}

}  // namespace omma
