// The only list of techniques.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "omma/technique/technique.h"

namespace omma {

std::span<const TechniqueEntry* const> technique_entries();

struct ChosenTechnique {
  const TechniqueEntry* entry;
  std::string variant;  ///< empty when the technique has none
  std::string name() const { return variant.empty() ? entry->info.name : entry->info.name + ":" + variant; }
  bool needs_project() const;     ///< cannot draw a ray map
  bool draws_without_gl() const;  ///< every channel but color
};

/// The technique of a text, `auto` included, for pictures with or without colour. Throws CommandError with the nearest
/// name, or when the technique cannot draw the camera.
ChosenTechnique choose_technique(std::string_view text, const Camera& camera, bool colored = true);

/// What can be drawn where there is no OpenGL, as a sentence.
std::string what_works_without_gl();

/// What draws the depth alone that a camera sees.
ChosenTechnique choose_depth_technique(const Camera& camera);

/// Throws CommandError when the technique has not what `show` asks for.
void check_show(const std::set<Show>& show, const ChosenTechnique& chosen);

}  // namespace omma
