#include "omma/visibility/find_blocks.h"

#include <algorithm>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "simd_targets.h"

namespace omma {
namespace {

/// Names and numbers of what is both compiled and at hand, the best first.
std::vector<std::pair<std::string, int64_t>> targets_at_hand() {
  static const std::vector<int64_t> targets = hwy::SupportedAndGeneratedTargets();  // before one is asked for
  std::vector<std::pair<std::string, int64_t>> named;
  for (const int64_t target : targets) named.emplace_back(hwy::TargetName(target), target);
  return named;
}

}  // namespace

#define OMMA_DECLARE(name)                 \
  namespace name {                         \
  decltype(omma::find_blocks) find_blocks; \
  }
OMMA_SIMD_TARGETS(OMMA_DECLARE)
#undef OMMA_DECLARE

HWY_EXPORT(find_blocks);

void find_blocks(const BlockQuery& query, std::span<const RayBlock> blocks, std::span<const BlockOrigins> origins,
                 const BlockSource& source, const BlockSink& sink) {
  HWY_DYNAMIC_DISPATCH(find_blocks)(query, blocks, origins, source, sink);
}

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const auto& [name, target] : targets_at_hand()) names.push_back(name);
  return names;
}

void use_simd_target(const std::string& name) {
  const auto targets = targets_at_hand();
  const auto found = std::find_if(targets.begin(), targets.end(), [&](const auto& t) { return t.first == name; });
  if (found == targets.end() && !name.empty()) {
    throw CommandError("{}", unknown_name("SIMD target", name, simd_targets()));
  }
  hwy::SetSupportedTargetsForTest(name.empty() ? 0 : found->second);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace omma
