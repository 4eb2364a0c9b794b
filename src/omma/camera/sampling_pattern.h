// Where the samples of a pixel lie.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace omma {

/// Offsets in pixels from the pixel's centre, inside the pixel, multiples of 1 / piece_grid: on the grid of pieces it
/// is decided in whole numbers whose a sample is. Their mean is the centre itself, for every number of samples, so that
/// a picture lies where its camera says. A set for each number: the first few of a longer sequence are off to one side.
///
/// The sets are lattices in which no two samples share a row or a column. Of those the one is taken whose share on
/// either side of a straight edge is nearest to the edge's area, on average over all edges: that average is the energy
/// distance of the samples from the whole pixel (Székely and Rizzo 2013, section 2).
///
/// The first call for a number takes up to 50 ms (a thousand samples). Any thread.
std::vector<glm::dvec2> sampling_pattern(int samples);

}  // namespace omma
