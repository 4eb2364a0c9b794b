#include "omma/shading/shadow_layers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string_view>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/math/pose.h"

namespace omma {
namespace {

/// More than any machine has to spare for shadows. Their texels can be counted in 32 bits.
constexpr int most_side = 1 << 15;
constexpr size_t most_texels = size_t{1} << 31;
constexpr double margin_texels = 4.0;
constexpr double narrowest = 0.01;         ///< radians from a spot's axis
constexpr double widest_flat = 0.7853982;  ///< radians from its axis that one perspective map shows
constexpr double last_share = 0.02;        ///< of the scene, at its end as the light travels
constexpr double sun_distance = 200.0;     ///< in radii of the scene

/// A plane's coordinate at the edge of a map that shows `at_edge` and, all around, the margin.
double with_margin(double at_edge, int size) { return at_edge / (1.0 - 2.0 * margin_texels / size); }

Camera camera_of(const char* lens, double half_angle, int size) {
  const double degrees = glm::degrees(2.0 * half_angle);
  return make_camera(fmt::format("{}:fov_deg={:.12g}", lens, degrees), ImageSize{size, size});
}

Camera flat_camera(double angle, int size) {
  return camera_of("perspective", std::atan(with_margin(std::tan(angle), size)), size);
}

Camera paraboloid_camera(double angle, int size) {
  return camera_of("stereographic", 2.0 * std::atan(with_margin(std::tan(0.5 * angle), size)), size);
}

glm::dmat4 looking(const glm::dvec3& from, const glm::dvec3& along) {
  return look_at_worldFromCamera(from, from + along);
}

/// Around what may cast a shadow worth seeing when light travels along `direction`. The ground casts none: next to
/// nothing lies beyond it, and it may be a hundred times as large as what stands on it. It is drawn where the map shows
/// it.
Bounds casters(std::span<const Bounds> boxes, const glm::dvec3& direction) {
  Bounds scene, result;
  for (const Bounds& box : boxes) scene.add(box);
  const glm::dvec3 low = scene.min + last_share * scene.extent(), high = scene.max - last_share * scene.extent();
  for (const Bounds& box : boxes) {
    bool last = false;
    for (int axis = 0; axis < 3; ++axis) {
      last |= direction[axis] < 0.0 && box.max[axis] <= low[axis];
      last |= direction[axis] > 0.0 && box.min[axis] >= high[axis];
    }
    if (!last) result.add(box);
  }
  return result.empty() ? scene : result;
}

class Planner {
 public:
  Planner(std::span<const Bounds> boxes, Shadows kind, int size) : boxes_(boxes), kind_(kind), size_(size) {}

  void add(int number, const Light& light) {
    number_ = number;
    if (light.kind == Light::Kind::sun) return add_sun(glm::normalize(light.direction));
    const bool spot = light.kind == Light::Kind::spot;
    const glm::dvec3 axis = spot ? glm::normalize(light.direction) : glm::dvec3(0.0, -1.0, 0.0);
    const double angle = spot ? std::max(double(light.outer_angle), narrowest) : glm::pi<double>();
    if (kind_ == Shadows::paraboloid) {
      add_paraboloids(light.position, axis, angle);
    } else {
      add_faces(light.position, axis, angle);
    }
  }

  std::vector<ShadowLayer> layers;

 private:
  void add_layer(Camera camera, const glm::dmat4& worldFromMap) {
    layers.push_back({number_, std::move(camera), worldFromMap});
  }

  void add_sun(const glm::dvec3& direction) {
    const Bounds seen = casters(boxes_, direction);
    const double radius = std::max(0.5 * glm::length(seen.extent()), 1e-6);
    const glm::dvec3 from = seen.center() - sun_distance * radius * direction;
    add_layer(flat_camera(std::asin(1.0 / sun_distance), size_), looking(from, direction));
  }

  void add_paraboloids(const glm::dvec3& from, const glm::dvec3& axis, double angle) {
    constexpr double quarter = glm::half_pi<double>();
    add_layer(paraboloid_camera(std::min(angle, quarter), size_), looking(from, axis));
    if (angle > quarter) add_layer(paraboloid_camera(quarter, size_), looking(from, -axis));
  }

  void add_faces(const glm::dvec3& from, const glm::dvec3& axis, double angle) {
    if (angle <= widest_flat) return add_layer(flat_camera(angle, size_), looking(from, axis));
    const double face_corner = std::acos(1.0 / std::sqrt(3.0));  // from the face's middle
    for (int face = 0; face < 6; ++face) {
      glm::dvec3 middle(0.0);
      middle[face / 2] = face % 2 ? -1.0 : 1.0;
      if (std::acos(std::clamp(glm::dot(middle, axis), -1.0, 1.0)) > angle + face_corner) continue;
      add_layer(flat_camera(widest_flat, size_), looking(from, middle));
    }
  }

  std::span<const Bounds> boxes_;
  Shadows kind_;
  int size_, number_ = 0;
};

}  // namespace

Shadows shadows_from_name(const std::string& name) {
  const std::vector<std::string> names{"off", "paraboloid", "cube"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw CommandError("{}", unknown_name("kind of shadows", name, names));
  return Shadows(found - names.begin());
}

bool ShadowLayer::flat() const { return std::string_view(camera.lens()->model->info.name) == "perspective"; }

std::vector<Bounds> boxes_of_triangles(const Scene& scene) {
  Bounds whole;
  std::vector<Bounds> boxes;
  for (const Instance& instance : scene.instances) {
    boxes.push_back(scene.meshes[size_t(instance.mesh)].bounds().transformed(instance.worldFromObject));
    whole.add(boxes.back());
  }
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const bool inside =
        glm::all(glm::greaterThan(boxes[i].min, whole.min)) && glm::all(glm::lessThan(boxes[i].max, whole.max));
    if (inside) continue;
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    boxes[i] = {};
    for (const glm::uvec3& triangle : mesh.triangles) {
      Bounds& box = boxes.emplace_back();
      for (int c = 0; c < 3; ++c) {
        box.add(glm::dvec3(instance.worldFromObject * glm::dvec4(mesh.positions[triangle[c]], 1.0)));
      }
    }
  }
  std::erase_if(boxes, [](const Bounds& box) { return box.empty(); });
  return boxes;
}

std::vector<ShadowMapRecord> shadow_map_records(std::span<const ShadowLayer> layers, const glm::dmat4& worldFromCamera,
                                                float near, std::span<LightRecord> lights) {
  std::vector<ShadowMapRecord> records;
  for (const ShadowLayer& layer : layers) {
    glm::vec4& cone = lights[size_t(layer.light)].cone;
    if (cone.w == 0.0f) cone.z = float(records.size());
    cone.w += 1.0f;
    const glm::mat4 rows = glm::transpose(glm::mat4(glm::inverse(layer.worldFromMap) * worldFromCamera));
    const Lens& lens = *layer.camera.lens();
    records.push_back(
        {{rows[0], -rows[1], -rows[2]}, glm::vec4(lens.focal.x, lens.centre.x, layer.flat() ? 1.0f : 0.0f, near)});
  }
  return records;
}

std::vector<ShadowLayer> plan_shadow_layers(std::span<const Light> lights, std::span<const Bounds> boxes, Shadows kind,
                                            int size) {
  if (size > most_side) {
    throw MachineError("a shadow map of {} texels is too large; up to {} are possible", size, most_side);
  }
  Planner planner(boxes, kind, size);
  for (size_t i = 0; i < lights.size() && kind != Shadows::off; ++i) planner.add(int(i), lights[i]);
  if (planner.layers.size() * size_t(size) * size_t(size) > most_texels) {
    throw MachineError("{} shadow maps of {} x {} texels are too much; give a smaller --shadow-size",
                       planner.layers.size(), size, size);
  }
  return std::move(planner.layers);
}

}  // namespace omma
