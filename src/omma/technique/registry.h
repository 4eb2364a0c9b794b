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
  bool draws_without_gl() const;  ///< what SoftwareRenderer does
};

/// What `auto` goes by.
struct Occasion {
  bool shaded = true;  ///< colour is asked for
  bool plain = true;   ///< nothing is shown over the picture that needs OpenGL: pieces, overdraw
  bool gpu = false;    ///< OpenGL is at hand, and not by software
};

/// The technique of a text, `auto` included. Throws CommandError with the nearest name, or when the technique cannot
/// draw the camera.
ChosenTechnique choose_technique(std::string_view text, const Camera& camera, const Occasion& occasion = {});

/// What draws the same by OpenGL.
ChosenTechnique with_gl(const ChosenTechnique& chosen);

/// What can be drawn where there is no OpenGL, as a sentence.
std::string what_works_without_gl();

/// What draws the depth alone that a camera sees.
ChosenTechnique choose_depth_technique(const Camera& camera);

/// Throws CommandError when the technique has not what `show` asks for.
void check_show(const std::set<Show>& show, const ChosenTechnique& chosen);

}  // namespace omma
