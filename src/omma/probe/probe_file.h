// Points to probe and what was found there, as files.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "omma/probe/probe.h"
#include "omma/scene/scene.h"

namespace omma {

/// Points of a `.npy` file: K x 6 numbers, position and normal, or K x 3, positions that share `normal`. Throws
/// InputError for any other content, with the row of a point without a direction.
std::vector<ProbePoint> load_probe_points(const std::filesystem::path& path, const std::optional<glm::dvec3>& normal,
                                          const Limits& limits = {});

struct ProbeMesh {
  std::vector<ProbePoint> points;
  std::vector<glm::uvec3> triangles;
};

/// An object's vertices in the world, and its triangles over them; vertices without a normal look up.
ProbeMesh object_mesh(const Scene& scene, int object);

/// Throws CommandError unless the file's extension is .npy or .ply.
void check_probe_output(const std::filesystem::path& path);

/// `.npy`: float64, a row a point: x, y, z, normal x, y, z, occlusion, sky, irradiance r, g, b, open solid angle.
/// `.ply`: binary; vertices with normal, openness (1 - occlusion) as grey colour and as `quality`, and the rest as
/// properties of their own; faces where there are triangles.
void write_probes(const std::filesystem::path& path, std::span<const ProbePoint> points,
                  std::span<const ProbeResult> results, std::span<const glm::uvec3> triangles);

}  // namespace omma
