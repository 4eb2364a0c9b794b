// A picture warped by a mesh of triangles: each point of the screen shows a point of a base camera's image.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "omma/camera/camera.h"
#include "omma/camera/deformation/deformed_image.h"
#include "omma/image/image.h"

namespace omma {

/// Both in units of their image's width and height, from its top left corner, y down. What is not finite is not shown,
/// nor any triangle with it.
struct WarpNode {
  glm::dvec2 screen;
  glm::dvec2 source;
};

struct WarpMesh {
  std::vector<WarpNode> nodes;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// Joins `columns` x `rows` nodes, given row by row, to triangles: two for each cell, as Lorenz and Döllner 2009
/// (section 3.2) split their camera textures. `closed`: the last column is joined to the first.
void add_grid_triangles(WarpMesh& mesh, int columns, int rows, bool closed);

/// A grid of nodes at the centres of `texels`; the outermost lie on the image's edges, so that it covers the image.
/// `node` makes one from its place in the image and the texel, whose own centre is the third argument.
WarpMesh texture_mesh(
    const ImageSize& texels,
    const std::function<WarpNode(const glm::dvec2& place, const glm::ivec2& texel, const glm::dvec2& centre)>& node);

/// For each pixel's centre (rows from the top) the point of the base image that it shows; NaN where there is none.
/// Where triangles overlap, one that is turned over (against most others) yields to one that is not, and then a later
/// one to an earlier one. `overlapping` counts those pixels. Throws InputError, beginning with `what`, for a mesh that
/// covers the image hundreds of times over.
std::vector<glm::dvec2> warp_sources(const WarpMesh& mesh, const ImageSize& size, const std::string& what,
                                     size_t& overlapping);

/// The camera that sees in each pixel what `base` sees at the point that the mesh says: in the pieces form where
/// warped_pieces makes one, else a ray map. Throws InputError as warp_sources does, CommandError when no pixel has a
/// ray, and for more pixels than the limit.
Camera warped_camera(const WarpMesh& mesh, const Camera& base, const ImageSize& size, const std::string& file,
                     const std::string& source, const Limits& limits);

/// The same as pieces, one for each triangle that has an area and meets the image; those that are turned over come
/// last. Nothing where pieces would not show the same: the base is not perspective or does not fill its image, the mesh
/// shows points beyond the base's image, or has corners too far away for pieces; nor where triangles are smaller than
/// pixels.
std::optional<PieceSet> warped_pieces(const WarpMesh& mesh, const Camera& base, const ImageSize& size,
                                      const std::string& source);

/// The camera of `base=` with every value that is none of `own_keys`.
Camera base_camera(const DeformationText& text, std::span<const char* const> own_keys,
                   std::optional<ImageSize> own_size, std::optional<ImageSize> size);

/// Of Paul Bourke's `.data`, Wavefront `.obj`, `.pfm` or `.exr` (R, G: u, v). `aspect` is width / height of the screen.
/// Throws CommandError for another extension, InputError for what is in the file, and for more nodes than the limit.
WarpMesh read_warp_mesh(const std::filesystem::path& path, double aspect, const Limits& limits = {});

/// An image of two or three floats a pixel, with no more pixels than the limit's warp_nodes. Throws InputError for any
/// other.
FloatImage read_vectors(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace omma
