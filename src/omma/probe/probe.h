// What a point of a surface sees of its hemisphere, from pictures whose pixels all count alike: in an orthographic
// fisheye (a cosine sphere) a pixel stands for as much cosine-weighted solid angle as any other, in Lambert's
// equal-area one for as much solid angle. Integrals over the hemisphere are then averages over the picture.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/render/prepared_scene.h"

namespace omma {

struct ProbePoint {
  glm::dvec3 position{0.0};  ///< world metres
  glm::dvec3 normal{0.0};    ///< world, any length but zero
};

struct ProbeOptions {
  int size = 64;  ///< pixels along each picture, 8 or more; the error falls with its power 1.5
  double max_distance = std::numeric_limits<double>::infinity();  ///< metres beyond which nothing occludes
  double offset = 1e-3;    ///< metres along the normal from the point to where it is looked from
  RenderOptions render{};  ///< the technique, background, shadows; samples are one
};

/// Over the hemisphere around the normal.
struct ProbeResult {
  double occlusion = 0.0;         ///< cosine-weighted share that surfaces within max_distance cover, 0 to 1
  double sky = 0.0;               ///< cosine-weighted share that nothing covers, however far, 0 to 1
  glm::dvec3 irradiance{0.0};     ///< linear RGB: cosine-weighted integral of the radiance of surfaces and background
  double open_solid_angle = 0.0;  ///< steradians that nothing covers within max_distance, 0 to 2π
};

/// Throws CommandError for a point or normal that is not finite and a normal without length.
void check_probe_point(const ProbePoint& point);

class Prober {
 public:
  /// The scene must outlive this object. Throws CommandError for options out of range.
  Prober(const PreparedScene& scene, const ProbeOptions& options);

  /// Occlusion, sky and irradiance. A list is done faster by one of the two for all points, then the other: techniques
  /// keep what they know of a camera while it stays the same.
  void look_cosine_weighted(const ProbePoint& point, ProbeResult& result);
  void look_unweighted(const ProbePoint& point, ProbeResult& result);

 private:
  glm::dmat4 pose(const ProbePoint& point) const;

  const PreparedScene& scene_;
  ProbeOptions options_;
  Camera cosine_sphere_, lambert_;
  std::vector<bool> in_cosine_sphere_, in_lambert_;  ///< which pixels have a ray
};

}  // namespace omma
