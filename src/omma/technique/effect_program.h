// Effects in programs of the GPU.
#pragma once

#include <span>

#include "omma/gl/program.h"
#include "omma/shading/effects.h"

namespace omma {

/// Symbols that make a program draw the effects one after another; none without effects.
gl::Defines effect_defines(std::span<const Effect> chain);
/// Their parameters, for a program with those symbols.
void set_effects(const gl::Program& program, std::span<const Effect> chain);

}  // namespace omma
