// How far one picture is moved against another, to hundredths of a pixel.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "omma/image/compare.h"

namespace omma {

/// The offset in pixels (x to the right, y down) by which `a` has to be moved to look most like `b`: the least squares
/// fit over all components (Lucas and Kanade 1981), with both pictures moved by half of it, so that neither is blurred
/// more than the other. Found from coarse to fine; reliable up to a few pixels. Values that are not finite, and what
/// lies next to them, are left out. Nothing for whole numbers, and for pictures without structure in both directions.
/// Throws InputError as require_comparable does.
std::optional<glm::dvec2> image_shift(const Image& a, const Image& b, Scale scale);

}  // namespace omma
