#include "omma/viewpoint/framing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "omma/viewpoint/core_bounds.h"

namespace omma {
namespace {

constexpr int sides = 16;  // of the pyramid that stands for the camera's field; a multiple of 4
constexpr double share_of_field = 0.85;
constexpr double widest = 0.84;  // radians from the axis, 48°
constexpr double unseen = 0.52;  // taken for the field where the camera sees nothing along its axis, 30°

/// How far from its axis the camera sees, radians, in each of the directions around it: from the right by way of up.
std::array<double, sides> field_of(const Camera& camera) {
  constexpr int columns = 64, rows = 48;
  std::array<double, sides> field{};
  const ImageSize size = camera.size();
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto ray = camera.unproject({(column + 0.5) / columns * size.width, (row + 0.5) / rows * size.height});
      if (!ray) continue;
      const glm::dvec3 d = ray->direction;
      const double from_axis = std::atan2(std::hypot(d.x, d.y), -d.z);
      const int side = int(std::lround(std::atan2(d.y, d.x) / (2.0 * M_PI) * sides) + sides) % sides;
      field[side] = std::max(field[side], from_axis);
    }
  }
  const bool sees_ahead = *std::min_element(field.begin(), field.end()) > 0.0;
  for (double& angle : field) angle = std::min(share_of_field * (sees_ahead ? angle : unseen), widest);
  return field;
}

/// Calls `each` for points, world, whose convex hull holds the scene: the vertices, or the corners of the box around a
/// mesh that stands at many places. What lies outside the core is drawn to its border.
template <typename Each>
void each_extreme(const Scene& scene, const Bounds& core, const Each& each) {
  std::vector<int> places(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++places[instance.mesh];
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto at = [&](const glm::dvec3& p) {
      each(glm::clamp(glm::dvec3(instance.worldFromObject * glm::dvec4(p, 1.0)), core.min, core.max));
    };
    if (places[instance.mesh] == 1) {
      for (const glm::vec3& p : mesh.positions) at(p);
    } else {
      const Bounds box = mesh.bounds();
      for (int corner = 0; corner < 8; ++corner) {
        at({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
            corner & 4 ? box.max.z : box.min.z});
      }
    }
  }
}

/// Towards the camera: the first of some directions from which nearly as much surface is seen from its front as from
/// the best.
glm::dvec3 best_side(const Scene& scene) {
  std::vector<glm::dvec3> directions;
  for (const double y : {0.4, -0.4}) {
    for (const double z : {1.0, -1.0}) {
      for (const double x : {0.6, -0.6}) directions.push_back(glm::normalize(glm::dvec3(x, y, z)));
    }
  }
  std::vector<double> areas(directions.size());
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool double_sided = scene.materials[mesh.material].double_sided;
    const glm::dmat3 axes(instance.worldFromObject);
    const double side = glm::determinant(axes) < 0.0 ? -1.0 : 1.0;
    const size_t step = 1 + mesh.triangles.size() / 20000;  // a sample of a large mesh is like the whole
    for (size_t i = 0; i < mesh.triangles.size(); i += step) {
      const glm::uvec3& t = mesh.triangles[i];
      const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      const glm::dvec3 normal = side * double(step) * glm::cross(axes * (b - a), axes * (c - a));
      for (size_t k = 0; k < directions.size(); ++k) {
        const double area = glm::dot(normal, directions[k]);
        areas[k] += double_sided ? std::abs(area) : std::max(area, 0.0);
      }
    }
  }
  const double enough = 0.5 * *std::max_element(areas.begin(), areas.end());
  for (size_t k = 0; k < directions.size(); ++k) {
    if (areas[k] >= enough) return directions[k];
  }
  return directions.front();
}

}  // namespace

Viewpoint frame_object(const Scene& scene, const Camera& camera) {
  const Bounds core = core_bounds(scene);
  const glm::dvec3 center = core.center(), backward = best_side(scene);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), backward));
  const glm::dvec3 up = glm::cross(backward, right);

  // A point p lies within the field's side k, at the angle f, of a camera at c when
  // (p - c) · e <= (c - p) · backward * tan f, e being the direction of that side: (backward + e / tan f) · (c - p) >=
  // 0. Of all points the one that is farthest along that normal counts.
  const std::array<double, sides> field = field_of(camera);
  std::array<glm::dvec3, sides> normals;
  std::array<double, sides> farthest, slopes;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * M_PI * k / sides;
    slopes[k] = 1.0 / std::tan(field[k]);
    normals[k] = backward + slopes[k] * (std::cos(angle) * right + std::sin(angle) * up);
    farthest[k] = 0.0;
  }
  each_extreme(scene, core, [&](const glm::dvec3& point) {
    const glm::dvec3 p = point - center;
    for (int k = 0; k < sides; ++k) farthest[k] = std::max(farthest[k], glm::dot(normals[k], p));
  });

  // Aside, so that what is left and right, above and below, is as far from the field's border.
  const auto aside = [&](int k) {
    const int opposite = k + sides / 2;
    return (farthest[k] - farthest[opposite]) / (slopes[k] + slopes[opposite]);
  };
  const double x = aside(0), y = aside(sides / 4);
  double distance = 0.0;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * M_PI * k / sides;
    distance = std::max(distance, farthest[k] - slopes[k] * (x * std::cos(angle) + y * std::sin(angle)));
  }
  if (!(distance > 0.0)) distance = 1.0;  // a point
  const glm::dvec3 to = center + x * right + y * up;
  return {to + distance * backward, to};
}

}  // namespace omma
