#include "omma/technique/registry.h"

#include <algorithm>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/technique/image_based/image_based.h"
#include "omma/technique/nonlinear/nonlinear.h"
#include "omma/technique/piecewise/piecewise.h"
#include "omma/technique/planar/planar.h"
#include "omma/technique/raycast/raycast.h"
#include "omma/technique/subdivision/subdivision.h"
#include "omma/technique/vertex/vertex.h"
#include "omma/technique/visibility/visibility.h"

namespace omma {
namespace {

const TechniqueEntry* const entries[] = {
    &planar_technique,    &image_based_technique, &vertex_technique,     &subdivision_technique,
    &piecewise_technique, &nonlinear_technique,   &visibility_technique, &raycast_technique,
};

/// Throws CommandError for a name or variant that does not exist.
ChosenTechnique find(std::string_view text) {
  const size_t colon = text.find(':');
  const std::string name(text.substr(0, colon));
  std::vector<std::string> names{"auto"};
  for (const TechniqueEntry* entry : entries) {
    names.push_back(entry->info.name);
    if (entry->info.name != name) continue;
    std::vector<std::string> variants;
    for (const VariantInfo& variant : entry->info.variants) variants.push_back(variant.name);
    if (colon == std::string_view::npos) return {entry, variants.empty() ? "" : variants.front()};
    const std::string variant(text.substr(colon + 1));
    if (variants.empty()) throw CommandError("technique '{}' has no variants; leave ':{}' out", name, variant);
    if (std::find(variants.begin(), variants.end(), variant) == variants.end()) {
      throw CommandError("{}", unknown_name("variant of technique " + name, variant, variants));
    }
    return {entry, variant};
  }
  throw CommandError("{}", unknown_name("technique", name, names));
}

/// Null when it has none.
const VariantInfo* variant_info(const ChosenTechnique& chosen) {
  const std::vector<VariantInfo>& variants = chosen.entry->info.variants;
  const auto found = std::find_if(variants.begin(), variants.end(),
                                  [&](const VariantInfo& info) { return info.name == chosen.variant; });
  return found == variants.end() ? nullptr : &*found;
}

}  // namespace

bool ChosenTechnique::needs_project() const {
  const VariantInfo* info = variant_info(*this);
  return entry->info.needs_project || (info != nullptr && info->needs_project);
}

bool ChosenTechnique::draws_without_gl() const {
  const VariantInfo* info = variant_info(*this);
  return info != nullptr && info->without_gl;
}

std::span<const TechniqueEntry* const> technique_entries() { return entries; }

std::string what_works_without_gl() {
  std::string techniques;
  for (const TechniqueEntry* entry : entries) {
    for (const VariantInfo& variant : entry->info.variants) {
      if (variant.without_gl) techniques += fmt::format(" and {}:{}", entry->info.name, variant.name);
    }
  }
  return fmt::format("without OpenGL, technique auto{} draw everything but --show pieces and overdraw", techniques);
}

ChosenTechnique choose_technique(std::string_view text, const Camera& camera, const Occasion& occasion) {
  if (text == "auto") {
    const bool without_gl = !occasion.shaded || (occasion.plain && !occasion.gpu);
    if (without_gl) return find("visibility:cpu");
    // A flat camera's picture is what GPUs are made for.
    return find(planar_draws(camera) ? "planar" : "visibility:resolve");
  }
  const ChosenTechnique chosen = find(text);
  if (chosen.needs_project() && camera.lens() == nullptr) {
    throw CommandError("technique '{}' projects vertices, and {} has no formula for that; use visibility or nonlinear",
                       chosen.name(), camera.pieces() != nullptr ? "a camera of pieces" : "a ray map");
  }
  if (chosen.entry == &planar_technique && !planar_draws(camera)) {
    throw CommandError("technique 'planar' draws the perspective camera only; use auto, visibility or image-based");
  }
  if (chosen.entry->refusal != nullptr) {
    if (const auto why = chosen.entry->refusal(camera)) throw CommandError("technique '{}' {}", chosen.name(), *why);
  }
  return chosen;
}

ChosenTechnique with_gl(const ChosenTechnique& chosen) {
  const VariantInfo* info = variant_info(chosen);
  return info != nullptr && info->without_gl ? ChosenTechnique{chosen.entry, info->with_gl} : chosen;
}

ChosenTechnique choose_depth_technique(const Camera& camera) {
  return choose_technique(planar_draws(camera) ? "planar" : "nonlinear", camera);
}

void check_show(const std::set<Show>& show, const ChosenTechnique& chosen) {
  if (show.contains(Show::overdraw) && !chosen.entry->info.bounds) {
    throw CommandError("technique '{}' rasterizes no bounding shapes whose overdraw could be shown; nonlinear does",
                       chosen.name());
  }
}

const std::vector<TechniqueInfo>& techniques() {
  static const std::vector<TechniqueInfo> infos = [] {
    std::vector<TechniqueInfo> list;
    for (const TechniqueEntry* entry : entries) list.push_back(entry->info);
    return list;
  }();
  return infos;
}

void check_technique(std::string_view technique) {
  if (technique != "auto") find(technique);
}

}  // namespace omma
