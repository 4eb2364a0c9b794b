// The slow truth: every triangle against every ray, in double precision, and a judge of pictures by it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/image/image.h"
#include "omma/scene/scene.h"

namespace omma {

/// Materials must be opaque: nobody looks into textures here.
class Oracle {
 public:
  struct Hit {
    uint32_t triangle = 0;
    uint32_t instance = 0;
    double distance = 0.0;
    glm::dvec3 weights{0.0};  ///< barycentric
  };

  Oracle(const Scene& scene, const glm::dmat4& worldFromCamera);

  /// The first triangle on a ray of the camera frame.
  std::optional<Hit> nearest(const glm::dvec3& direction) const;
  /// One triangle on a ray, whatever is before it.
  std::optional<Hit> meet(uint32_t triangle, const glm::dvec3& direction) const;

  /// True where one of the triangle's edges is within `angle` (radians) of a ray.
  bool ends_within(uint32_t triangle, const glm::dvec3& direction, double angle) const;

  /// Interpolated, in the world, on the camera's side.
  glm::dvec3 normal(const Hit& hit) const;
  glm::dvec2 uv(const Hit& hit) const;
  /// How far uv changes along the triangle's edges, at most, per metre.
  double uv_per_metre(const Hit& hit) const;
  /// Of the ray and the triangle's own normal; small where the view grazes.
  double cosine(const Hit& hit, const glm::dvec3& direction) const;

 private:
  struct Triangle {
    glm::dmat3 planes;  ///< b x c, c x a, a x b, turned so that rays inside are positive
    double volume;      ///< |det(a, b, c)|
    uint32_t id, instance;
    bool culled;  ///< it faces away
  };
  static std::optional<Hit> meet(const Triangle& triangle, const glm::dvec3& direction);
  const glm::uvec3& corners(const Hit& hit) const;

  const Scene* scene_;
  glm::dmat4 worldFromCamera_;
  std::vector<Triangle> triangles_;  ///< by their ids
};

/// How a picture's ids compare with the oracle's.
struct Verdict {
  size_t pixels = 0, hits = 0;
  size_t edges = 0;  ///< right for a ray within the radius
  size_t ties = 0;   ///< another triangle at the same distance, relative 1e-5
  size_t wrong = 0;
  std::string first_wrong;
};

/// What is forgiven beside an edge.
struct Forgiven {
  double radius;        ///< pixels
  bool cracks = false;  ///< what is behind an edge, too: rounded vertices open cracks where edges meet at a T
};

/// Where `agreed`, somebody else's picture, has the same id, that is taken to be right: the oracle is slow.
Verdict judge(const Oracle& oracle, const Camera& camera, const IntImage& ids, const Forgiven& forgiven,
              const IntImage* agreed = nullptr);

}  // namespace omma
