#include "omma/probe/probe_file.h"

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cmath>
#include <ostream>

#include "omma/base/error.h"
#include "omma/base/file.h"
#include "omma/image/npy.h"

namespace omma {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY files are written as they lie in memory");

template <typename T>
void put(std::ostream& stream, const T& value) {
  stream.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_npy_rows(const std::filesystem::path& path, std::span<const ProbePoint> points,
                    std::span<const ProbeResult> results) {
  std::vector<double> rows;
  for (size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 &p = points[i].position, &n = points[i].normal, &e = results[i].irradiance;
    rows.insert(rows.end(), {p.x, p.y, p.z, n.x, n.y, n.z, results[i].occlusion, results[i].sky, e.x, e.y, e.z,
                             results[i].open_solid_angle});
  }
  const std::array<size_t, 2> shape{points.size(), 12};
  write_npy<double>(path, shape, rows);
}

void write_ply(std::ostream& stream, std::span<const ProbePoint> points, std::span<const ProbeResult> results,
               std::span<const glm::uvec3> triangles) {
  stream << "ply\nformat binary_little_endian 1.0\ncomment omma probe\nelement vertex " << points.size() << '\n';
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) stream << "property float " << name << '\n';
  for (const char* name : {"red", "green", "blue"}) stream << "property uchar " << name << '\n';
  for (const char* name :
       {"quality", "occlusion", "sky", "irradiance_r", "irradiance_g", "irradiance_b", "open_solid_angle"}) {
    stream << "property float " << name << '\n';
  }
  if (!triangles.empty())
    stream << "element face " << triangles.size() << "\nproperty list uchar uint vertex_indices\n";
  stream << "end_header\n";
  for (size_t i = 0; i < points.size(); ++i) {
    put(stream, glm::vec3(points[i].position));
    put(stream, glm::vec3(glm::normalize(points[i].normal)));
    const double open = 1.0 - results[i].occlusion;
    put(stream, glm::u8vec3(uint8_t(std::lround(255.0 * open))));
    put(stream, float(open));
    put(stream, float(results[i].occlusion));
    put(stream, float(results[i].sky));
    put(stream, glm::vec3(results[i].irradiance));
    put(stream, float(results[i].open_solid_angle));
  }
  for (const glm::uvec3& triangle : triangles) {
    put(stream, uint8_t{3});
    put(stream, triangle);
  }
}

}  // namespace

std::vector<ProbePoint> load_probe_points(const std::filesystem::path& path, const std::optional<glm::dvec3>& normal,
                                          const Limits& limits) {
  const NpyArray<double> file = read_npy<double>(path, limits);
  const size_t columns = file.shape.size() == 2 ? file.shape[1] : 0;
  if (columns != 3 && columns != 6) {
    throw InputError("{}: K x 6 numbers, positions and normals, or K x 3, positions alone, are expected",
                     path.string());
  }
  if (columns == 3 && !normal)
    throw InputError("{}: has positions alone; --normal says which way they look", path.string());
  if (columns == 6 && normal) throw InputError("{}: has normals of its own; leave --normal out", path.string());
  std::vector<ProbePoint> points;
  for (size_t i = 0; i < file.shape[0]; ++i) {
    const double* row = file.values.data() + i * columns;
    ProbePoint point{{row[0], row[1], row[2]}, normal.value_or(glm::dvec3(0.0))};
    if (columns == 6) point.normal = {row[3], row[4], row[5]};
    try {
      check_probe_point(point);
    } catch (const CommandError& error) {
      throw InputError("{}: row {}: {}", path.string(), i, error.what());
    }
    points.push_back(point);
  }
  if (points.empty()) throw InputError("{}: holds no point", path.string());
  return points;
}

ProbeMesh object_mesh(const Scene& scene, int object) {
  ProbeMesh result;
  for (const Instance& instance : scene.instances) {
    if (instance.object != object) continue;
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    const glm::dmat3 turn(instance.worldFromObject);
    // Normals go by the cofactor matrix, which is there for flattened objects, too.
    const glm::dmat3 cofactor(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]), glm::cross(turn[0], turn[1]));
    const auto first = unsigned(result.points.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec3 normal = cofactor * glm::dvec3(mesh.normals[i]);
      const double length = glm::length(normal);
      result.points.push_back({glm::dvec3(instance.worldFromObject * glm::dvec4(mesh.positions[i], 1.0)),
                               length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0)});
    }
    for (const glm::uvec3& triangle : mesh.triangles) result.triangles.push_back(triangle + first);
  }
  return result;
}

void check_probe_output(const std::filesystem::path& path) {
  if (path.extension() != ".npy" && path.extension() != ".ply") {
    throw CommandError("-o {}: probes are written to .npy or .ply", path.string());
  }
  require_writable(path);
}

void write_probes(const std::filesystem::path& path, std::span<const ProbePoint> points,
                  std::span<const ProbeResult> results, std::span<const glm::uvec3> triangles) {
  if (path.extension() == ".npy") return write_npy_rows(path, points, results);
  write_stream(path, [&](std::ostream& stream) { write_ply(stream, points, results, triangles); });
}

}  // namespace omma
