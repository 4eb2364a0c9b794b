// Warp meshes over a flat base: what each triangle shows is a perspective picture.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "omma/base/error.h"
#include "omma/camera/deformation/warp.h"
#include "omma/camera/pieces/flat_pieces.h"

namespace omma {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// The linear map from a perspective camera's image to its rays; nothing for another camera, or where it does not fill
// its image.
std::optional<glm::dmat3> flat_rays(const Camera& base) {
  if (!base.lens() || std::string_view(base.kind()) != "perspective") return {};
  const double width = base.size().width, height = base.size().height;
  const std::array<glm::dvec2, 4> corners = {glm::dvec2(0.0), glm::dvec2(width, 0.0), glm::dvec2(width, height),
                                             glm::dvec2(0.0, height)};
  std::array<glm::dvec3, 4> rays;
  for (size_t i = 0; i < 4; ++i) {
    const auto ray = base.unproject(corners[i]);
    if (!ray) return {};
    rays[i] = ray->direction;
  }
  const auto lengths = quad_lengths(corners, rays);
  if (!lengths) return {};
  return ray_from_image({corners[0], corners[1], corners[3]},
                        {rays[0], (*lengths)[1] * rays[1], (*lengths)[3] * rays[3]});
}

bool is_finite(const WarpNode& node) {
  return std::isfinite(node.screen.x + node.screen.y) && std::isfinite(node.source.x + node.source.y);
}

}  // namespace

std::optional<PieceSet> warped_pieces(const WarpMesh& mesh, const Camera& base, const ImageSize& size,
                                      const std::string& source) {
  const std::optional<glm::dmat3> shown = flat_rays(base);
  if (!shown || mesh.triangles.size() > static_cast<size_t>(size.width) * size.height / 2) return {};
  const glm::dvec2 image(size.width, size.height), base_image(base.size().width, base.size().height);
  const double beside = PieceSet::bin_side;  // pieces are asked for rays this far beside the image
  std::vector<Piece> upright, mirrored;
  for (const auto& numbers : mesh.triangles) {
    std::array<glm::dvec2, 3> screen;
    std::array<glm::dvec2, 3> sources;
    bool finite = true;
    for (size_t i = 0; i < 3; ++i) {
      const WarpNode& node = mesh.nodes[numbers[i]];
      finite = finite && is_finite(node);
      screen[i] = node.screen * image;
      sources[i] = node.source;
    }
    if (!finite) continue;
    const glm::dvec2 low = glm::min(screen[0], glm::min(screen[1], screen[2]));
    const glm::dvec2 high = glm::max(screen[0], glm::max(screen[1], screen[2]));
    if (!(low.x < image.x + beside && low.y < image.y + beside && high.x > -beside && high.y > -beside)) continue;
    const double furthest = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
    if (furthest > max_piece_corner) return {};
    constexpr double slack = 1e-9;
    for (const glm::dvec2& point : sources) {
      if (std::min(point.x, point.y) < -slack || std::max(point.x, point.y) > 1.0 + slack) return {};
    }
    std::array places = {on_piece_grid(screen[0]), on_piece_grid(screen[1]), on_piece_grid(screen[2])};
    const double area = cross(glm::dvec2(places[1] - places[0]), glm::dvec2(places[2] - places[0]));
    const double source_area = cross(sources[1] - sources[0], sources[2] - sources[0]);
    if (area < 0.0) {
      std::swap(places[1], places[2]);
      std::swap(sources[1], sources[2]);
    }
    std::array<glm::dvec2, 3> corners;
    std::array<glm::dvec3, 3> rays;
    for (size_t i = 0; i < 3; ++i) {
      corners[i] = glm::dvec2(places[i]) / static_cast<double>(piece_grid);
      rays[i] = *shown * glm::dvec3(sources[i] * base_image, 1.0);
    }
    if (area == 0.0 || source_area == 0.0) continue;
    const auto piece = flat_piece(places, ray_from_image(corners, rays));
    if (piece) ((area < 0.0) == (source_area < 0.0) ? upright : mirrored).push_back(*piece);
  }
  if (upright.size() < mirrored.size()) std::swap(upright, mirrored);
  upright.insert(upright.end(), mirrored.begin(), mirrored.end());
  if (upright.empty()) throw CommandError("{}: the camera sees nothing: no pixel has a ray", source);
  Camera camera(PieceSet(size, std::move(upright), source));
  if (camera.pixels_per_radian() == 0.0) throw CommandError("{}: the camera sees nothing: no pixel has a ray", source);
  return *camera.pieces();
}

}  // namespace omma
