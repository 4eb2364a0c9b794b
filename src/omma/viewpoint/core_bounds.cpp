#include "omma/viewpoint/core_bounds.h"

#include <algorithm>
#include <vector>

namespace omma {

Bounds core_bounds(const Scene& scene) {
  constexpr size_t most_samples = 20000;
  constexpr double outside = 0.02;  // of the triangles, beyond each end of each axis
  const Bounds all = scene.bounds();
  const size_t step = 1 + scene.triangle_count() / most_samples;
  std::vector<double> places[3];
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (size_t i = (step - instance.first_triangle % step) % step; i < mesh.triangles.size(); i += step) {
      const glm::uvec3& t = mesh.triangles[i];
      const glm::dvec3 middle = glm::dvec3(mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0;
      const glm::dvec3 place(instance.worldFromObject * glm::dvec4(middle, 1.0));
      for (int axis = 0; axis < 3; ++axis) places[axis].push_back(place[axis]);
    }
  }
  Bounds core;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& values = places[axis];
    if (values.empty()) return all;
    const auto at = [&](double share) {
      const auto nth = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
      std::nth_element(values.begin(), nth, values.end());
      return *nth;
    };
    core.min[axis] = at(outside);
    core.max[axis] = at(1.0 - outside);
  }
  if (!(glm::length(core.extent()) > 0.0) || 4.0 * glm::length(core.extent()) > glm::length(all.extent())) return all;
  const glm::dvec3 margin = 0.1 * core.extent();
  return {glm::max(core.min - margin, all.min), glm::min(core.max + margin, all.max)};
}

}  // namespace omma
