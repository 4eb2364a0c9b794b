#include "omma/scene/object.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {

int find_object(const Scene& scene, std::string_view text) {
  std::set<int> objects, named;
  std::vector<std::string> names;
  for (const Instance& instance : scene.instances) {
    objects.insert(instance.object);
    if (instance.node < 0) continue;
    const std::string& name = scene.nodes[size_t(instance.node)].name;
    if (name.empty()) continue;
    names.push_back(name);
    if (name == text) named.insert(instance.object);
  }
  if (objects.empty()) throw CommandError("the scene has no object '{}': nothing is in it", text);
  if (named.size() == 1) return *named.begin();
  if (named.size() > 1) {
    throw CommandError("'{}' is the name of objects {}; give one of their numbers", text, fmt::join(named, ", "));
  }
  const bool is_number =
      !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (is_number && text.size() < 10) {
    const int number = int(parse_integer("object", text));
    if (objects.contains(number)) return number;
  }
  const std::optional<std::string> nearest = nearest_name(text, names);
  constexpr size_t worth_listing = 24;
  std::string known = nearest ? fmt::format("; did you mean '{}'?", *nearest) : "";
  if (!names.empty() && names.size() <= worth_listing) known += fmt::format(" ({})", fmt::join(names, ", "));
  throw CommandError("the scene has no object '{}'{}; a name, or a number from {} to {} is accepted", text, known,
                     *objects.begin(), *objects.rbegin());
}

Bounds object_bounds(const Scene& scene, int object) {
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    if (instance.object != object) continue;
    const Bounds of_mesh = scene.meshes[size_t(instance.mesh)].bounds();
    if (!of_mesh.empty()) bounds.add(of_mesh.transformed(instance.worldFromObject));
  }
  return bounds;
}

}  // namespace omma
