// The rays of the last cameras: made where they are used while cameras change, kept in memory while one stands still.
#pragma once

#include <glm/glm.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

#include "omma/base/recent_cache.h"
#include "omma/visibility/camera_rays.h"
#include "omma/visibility/ray_tree.h"

namespace omma {

class RecentRays {
 public:
  /// Trees take no more memory than this; rays of larger images are made anew for each picture.
  static constexpr size_t most_bytes = size_t{256} << 20;

  /// A ray for each of `shifts` from the centres of the pixels of the camera's image; of the same camera and shifts,
  /// from the second time on, kept. Runs on all cores, and may be called by any number of threads.
  std::shared_ptr<const RaySource> of(const Camera& camera, const std::vector<glm::dvec2>& shifts);

  size_t bytes() const;

 private:
  struct Pass {
    std::shared_ptr<const SquarePatches> patches;
    std::vector<glm::dvec2> shifts;
    std::shared_ptr<const CameraRays> rays;
    std::shared_ptr<const RayTree> kept{};
  };
  std::shared_ptr<const RaySource> find(const Camera& camera, const std::vector<glm::dvec2>& shifts);
  void keep(Pass& pass);

  static constexpr size_t most_cameras = 8, most_passes = 16;
  mutable std::mutex mutex_;
  RecentCache<Camera, std::shared_ptr<const SquarePatches>, most_cameras> patches_;
  std::list<Pass> passes_;  ///< the last used first
};

}  // namespace omma
