#include "omma/visibility/recent_rays.h"

#include "omma/base/isolated.h"

namespace omma {

std::shared_ptr<const RaySource> RecentRays::of(const Camera& camera, const std::vector<glm::dvec2>& shifts) {
  return isolated([&] {
    const std::lock_guard lock(mutex_);
    return find(camera, shifts);
  });
}

std::shared_ptr<const RaySource> RecentRays::find(const Camera& camera, const std::vector<glm::dvec2>& shifts) {
  const auto patches = patches_.get(camera, [](const Camera& of) {
    return std::make_shared<const SquarePatches>(of, PixelRect{0, 0, of.size().width, of.size().height});
  });
  // What is of a camera that is forgotten is asked for no more.
  std::erase_if(passes_, [&](const Pass& pass) {
    bool is_known = false;
    patches_.each([&](const std::shared_ptr<const SquarePatches>& known) { is_known |= known == pass.patches; });
    return !is_known;
  });
  for (auto pass = passes_.begin(); pass != passes_.end(); ++pass) {
    if (pass->patches != patches || pass->shifts != shifts) continue;
    passes_.splice(passes_.begin(), passes_, pass);
    if (!pass->kept) keep(*pass);
    if (pass->kept) return pass->kept;
    return pass->rays;
  }
  if (passes_.size() == most_passes) passes_.pop_back();
  return passes_.emplace_front(Pass{patches, shifts, std::make_shared<const CameraRays>(patches, shifts)}).rays;
}

void RecentRays::keep(Pass& pass) {
  size_t kept = pass.rays->squares() * (size_t(pass.rays->samples()) * sizeof(RayBlock) + sizeof(SquareBorder));
  if (kept > most_bytes) return;
  for (const Pass& other : passes_) kept += other.kept ? other.kept->bytes() : 0;
  for (auto oldest = passes_.rbegin(); kept > most_bytes && oldest != passes_.rend(); ++oldest) {
    if (!oldest->kept) continue;
    kept -= oldest->kept->bytes();
    oldest->kept.reset();
  }
  pass.kept = std::make_shared<const RayTree>(*pass.rays);
}

size_t RecentRays::bytes() const {
  const std::lock_guard lock(mutex_);
  size_t sum = 0;
  patches_.each([&](const std::shared_ptr<const SquarePatches>& patches) { sum += patches->bytes(); });
  for (const Pass& pass : passes_) sum += pass.kept ? pass.kept->bytes() : 0;
  return sum;
}

}  // namespace omma
