#include "omma/scene/geometry.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace omma {
namespace {

template <typename Vector>
bool finite(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(v[i])) return false;
  }
  return true;
}

template <typename Vector>
void zero_non_finite(std::vector<Vector>& array) {
  for (Vector& v : array) {
    if (!finite(v)) v = Vector(0.0f);
  }
}

/// Calls `function` with every per-vertex array of the mesh.
template <typename Function>
void for_each_vertex_array(Mesh& mesh, Function function) {
  function(mesh.positions);
  function(mesh.normals);
  function(mesh.tangents);
  function(mesh.uvs);
  function(mesh.colors);
  if (mesh.skin) {
    function(mesh.skin->vertex_joints);
    function(mesh.skin->vertex_weights);
  }
  for (MorphTarget& target : mesh.morph_targets) {
    function(target.position_offsets);
    function(target.normal_offsets);
  }
}

/// Vertex i becomes what vertex source[i] was.
void gather_vertices(Mesh& mesh, const std::vector<uint32_t>& source) {
  for_each_vertex_array(mesh, [&](auto& array) {
    if (array.empty()) return;
    std::remove_reference_t<decltype(array)> gathered(source.size());
    for (size_t i = 0; i < source.size(); ++i) gathered[i] = array[source[i]];
    array = std::move(gathered);
  });
}

uint64_t hash_bytes(uint64_t hash, const void* data, size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (size_t i = 0; i < size; i += 4) {
    uint32_t word = 0;
    std::memcpy(&word, bytes + i, std::min<size_t>(4, size - i));
    hash = (hash ^ word) * 0x9E3779B97F4A7C15ull;
    hash ^= hash >> 29;
  }
  return hash;
}

glm::dvec3 corner(const Mesh& mesh, const glm::uvec3& triangle, int index) {
  return glm::dvec3(mesh.positions[triangle[index % 3]]);
}

/// Twice the area long; zero for a degenerate triangle.
glm::dvec3 area_normal(const Mesh& mesh, const glm::uvec3& triangle) {
  const glm::dvec3 a = corner(mesh, triangle, 0);
  return glm::cross(corner(mesh, triangle, 1) - a, corner(mesh, triangle, 2) - a);
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

/// Radians between the two edges at a corner.
double corner_angle(const Mesh& mesh, const glm::uvec3& triangle, int index) {
  const glm::dvec3 p = corner(mesh, triangle, index);
  const glm::dvec3 a = unit_or_zero(corner(mesh, triangle, index + 1) - p);
  const glm::dvec3 b = unit_or_zero(corner(mesh, triangle, index + 2) - p);
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

}  // namespace

size_t drop_non_finite(Mesh& mesh) {
  std::vector<bool> usable(mesh.positions.size());
  for (size_t i = 0; i < usable.size(); ++i) usable[i] = finite(mesh.positions[i]);
  const size_t dropped =
      std::erase_if(mesh.triangles, [&](const glm::uvec3& t) { return !usable[t.x] || !usable[t.y] || !usable[t.z]; });
  zero_non_finite(mesh.positions);
  zero_non_finite(mesh.normals);
  zero_non_finite(mesh.tangents);
  zero_non_finite(mesh.uvs);
  for (MorphTarget& target : mesh.morph_targets) {
    zero_non_finite(target.position_offsets);
    zero_non_finite(target.normal_offsets);
  }
  return dropped;
}

void weld_vertices(Mesh& mesh) {
  const size_t count = mesh.positions.size();
  std::vector<uint64_t> hashes(count, 1469598103934665603ull);
  for_each_vertex_array(mesh, [&](auto& array) {
    for (size_t i = 0; i < array.size(); ++i) {
      hashes[i] = hash_bytes(hashes[i], &array[i], sizeof array[i]);
    }
  });
  const auto equal = [&](uint32_t a, uint32_t b) {
    bool same = true;
    for_each_vertex_array(mesh, [&](auto& array) {
      same = same && (array.empty() || std::memcmp(&array[a], &array[b], sizeof array[a]) == 0);
    });
    return same;
  };
  const auto hash = [&](uint32_t i) { return static_cast<size_t>(hashes[i]); };
  std::unordered_map<uint32_t, uint32_t, decltype(hash), decltype(equal)> welded(count, hash, equal);
  std::vector<uint32_t> source;
  for (glm::uvec3& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto [entry, fresh] = welded.try_emplace(triangle[k], static_cast<uint32_t>(source.size()));
      if (fresh) source.push_back(triangle[k]);
      triangle[k] = entry->second;
    }
  }
  gather_vertices(mesh, source);
}

void generate_smooth_normals(Mesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 normal = unit_or_zero(area_normal(mesh, triangle));
    for (int k = 0; k < 3; ++k) sums[triangle[k]] += normal * corner_angle(mesh, triangle, k);
  }
  mesh.normals.resize(sums.size());
  for (size_t i = 0; i < sums.size(); ++i) mesh.normals[i] = glm::vec3(unit_or_zero(sums[i]));
  normalize_normals(mesh);
}

void generate_normals(Mesh& mesh, float crease) {
  mesh.normals.clear();
  // Faces meet where their corners' positions are equal, whatever uvs and colours say.
  const auto hash = [](const glm::vec3& p) { return static_cast<size_t>(hash_bytes(0, &p, sizeof p)); };
  std::unordered_map<glm::vec3, uint32_t, decltype(hash)> places(mesh.positions.size(), hash);
  std::vector<uint32_t> place_of_vertex;
  place_of_vertex.reserve(mesh.positions.size());
  for (const glm::vec3& position : mesh.positions) {
    const auto next = static_cast<uint32_t>(places.size());
    // Adding zero makes -0 and 0 one place.
    place_of_vertex.push_back(places.try_emplace(position + 0.0f, next).first->second);
  }

  // All corners, sorted by place: those of place p are corners[first[p]] to corners[first[p + 1] - 1].
  const auto corner_count = static_cast<uint32_t>(3 * mesh.triangles.size());
  const auto vertex_of = [&](uint32_t c) { return mesh.triangles[c / 3][static_cast<int>(c % 3)]; };
  std::vector<uint32_t> first(places.size() + 1, 0), corners(corner_count);
  for (uint32_t c = 0; c < corner_count; ++c) ++first[place_of_vertex[vertex_of(c)] + 1];
  for (size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
  std::vector<uint32_t> next = first;
  for (uint32_t c = 0; c < corner_count; ++c) corners[next[place_of_vertex[vertex_of(c)]]++] = c;

  std::vector<glm::dvec3> face_normals, weighted(corner_count);
  for (const glm::uvec3& triangle : mesh.triangles) {
    face_normals.push_back(unit_or_zero(area_normal(mesh, triangle)));
    for (int k = 0; k < 3; ++k) {
      weighted[3 * (face_normals.size() - 1) + static_cast<size_t>(k)] =
          face_normals.back() * corner_angle(mesh, triangle, k);
    }
  }

  // A place with a thousand faces is no crease to smooth, and comparing all pairs there would take for ever.
  constexpr uint32_t too_many = 1000;
  const double limit = std::cos(crease);
  std::vector<uint32_t> source(corner_count);
  mesh.normals.reserve(corner_count);
  for (uint32_t c = 0; c < corner_count; ++c) {
    source[c] = vertex_of(c);
    const glm::dvec3& own = face_normals[c / 3];
    const uint32_t place = place_of_vertex[source[c]];
    glm::dvec3 sum = weighted[c];
    if (first[place + 1] - first[place] <= too_many) {
      sum = glm::dvec3(0.0);  // in one order for all corners here, or equal normals would differ in their last bit
      for (uint32_t i = first[place]; i < first[place + 1]; ++i) {
        if (glm::dot(face_normals[corners[i] / 3], own) >= limit) sum += weighted[corners[i]];
      }
    }
    mesh.normals.push_back(glm::vec3(unit_or_zero(sum)));
  }
  std::vector<glm::vec3> normals = std::move(mesh.normals);
  mesh.normals.clear();
  gather_vertices(mesh, source);
  mesh.normals = std::move(normals);
  for (uint32_t c = 0; c < corner_count; ++c) mesh.triangles[c / 3][static_cast<int>(c % 3)] = c;
  normalize_normals(mesh);
  weld_vertices(mesh);
}

void normalize_normals(Mesh& mesh) {
  std::vector<bool> bad(mesh.normals.size());
  bool any = false;
  for (size_t i = 0; i < bad.size(); ++i) {
    const glm::dvec3 normal = unit_or_zero(glm::dvec3(mesh.normals[i]));
    bad[i] = normal == glm::dvec3(0.0);
    any = any || bad[i];
    mesh.normals[i] = bad[i] ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(normal);
  }
  if (!any) return;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 normal = unit_or_zero(area_normal(mesh, triangle));
    if (normal == glm::dvec3(0.0)) continue;
    for (int k = 0; k < 3; ++k) {
      if (bad[triangle[k]]) mesh.normals[triangle[k]] = glm::vec3(normal);
    }
  }
}

void generate_tangents(Mesh& mesh) {
  if (mesh.uvs.empty()) return;
  const size_t count = mesh.positions.size();
  std::vector<glm::dvec3> along_u(count, glm::dvec3(0.0)), along_v(count, glm::dvec3(0.0));
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::dvec3 p = corner(mesh, triangle, 0);
    const glm::dvec3 e1 = corner(mesh, triangle, 1) - p, e2 = corner(mesh, triangle, 2) - p;
    const glm::dvec2 uv = mesh.uvs[triangle.x];
    const glm::dvec2 d1 = glm::dvec2(mesh.uvs[triangle.y]) - uv;
    const glm::dvec2 d2 = glm::dvec2(mesh.uvs[triangle.z]) - uv;
    const double area = d1.x * d2.y - d2.x * d1.y;
    if (area == 0.0 || !std::isfinite(area)) continue;
    const double sign = area < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 u = unit_or_zero((e1 * d2.y - e2 * d1.y) * sign);
    const glm::dvec3 v = unit_or_zero((e2 * d1.x - e1 * d2.x) * sign);
    for (int k = 0; k < 3; ++k) {
      const double weight = corner_angle(mesh, triangle, k);
      along_u[triangle[k]] += u * weight;
      along_v[triangle[k]] += v * weight;
    }
  }
  mesh.tangents.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec3 normal(mesh.normals[i]);
    glm::dvec3 tangent = unit_or_zero(along_u[i] - normal * glm::dot(normal, along_u[i]));
    if (tangent == glm::dvec3(0.0)) {
      tangent =
          glm::normalize(glm::cross(std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), normal));
    }
    // glTF: bitangent = cross(normal, tangent) * w points along v as the *picture's* up, which is -v with v = 0 at the
    // top row.
    const double handedness = glm::dot(glm::cross(normal, tangent), along_v[i]);
    mesh.tangents[i] = glm::vec4(glm::vec3(tangent), handedness > 0.0 ? -1.0f : 1.0f);
  }
}

}  // namespace omma
