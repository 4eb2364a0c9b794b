#include "omma/camera/deformation/warp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/image/read.h"

namespace omma {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// A triangle laid over the screen's pixels.
struct ScreenTriangle {
  std::array<glm::dvec2, 3> screen;  // pixels
  std::array<glm::dvec2, 3> source;
  double area = 0.0;  // twice, signed
  bool mirrored = false;
  PixelRect pixels;

  ScreenTriangle(const WarpMesh& mesh, const std::array<uint32_t, 3>& corners, const ImageSize& size) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (size_t i = 0; i < 3; ++i) {
      screen[i] = mesh.nodes[corners[i]].screen * glm::dvec2(size.width, size.height);
      source[i] = mesh.nodes[corners[i]].source;
      low = glm::min(low, screen[i]);
      high = glm::max(high, screen[i]);
    }
    area = cross(screen[1] - screen[0], screen[2] - screen[0]);
    const double source_area = cross(source[1] - source[0], source[2] - source[0]);
    if (!std::isfinite(area + source_area) || area == 0.0) return;
    mirrored = (area < 0.0) != (source_area < 0.0);
    // One more pixel than the centres within, for those on the edge.
    const auto first = [](double x, int end) {
      return static_cast<int>(std::clamp(std::floor(x - 0.5), 0.0, 1.0 * end));
    };
    const auto last = [](double x, int end) {
      return static_cast<int>(std::clamp(std::ceil(x + 0.5), 0.0, 1.0 * end));
    };
    pixels = {first(low.x, size.width), first(low.y, size.height), last(high.x, size.width), last(high.y, size.height)};
  }

  glm::dvec3 weights(const glm::dvec2& point) const {
    const double first = cross(screen[1] - point, screen[2] - point) / area;
    const double second = cross(screen[2] - point, screen[0] - point) / area;
    return {first, second, 1.0 - first - second};
  }
};

}  // namespace

void add_grid_triangles(WarpMesh& mesh, int columns, int rows, bool closed) {
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + (closed ? 0 : 1) < columns; ++column) {
      const int next = (column + 1) % columns;
      const auto node = [&](int x, int y) { return static_cast<uint32_t>(y * columns + x); };
      mesh.triangles.push_back({node(column, row), node(next, row), node(next, row + 1)});
      mesh.triangles.push_back({node(column, row), node(next, row + 1), node(column, row + 1)});
    }
  }
}

WarpMesh texture_mesh(const ImageSize& texels,
                      const std::function<WarpNode(const glm::dvec2&, const glm::ivec2&, const glm::dvec2&)>& node) {
  const glm::dvec2 size(texels.width, texels.height);
  const int columns = std::max(2, texels.width), rows = std::max(2, texels.height);
  const auto place_of = [](int number, int nodes, int count) {
    return number == 0 ? 0.0 : number == nodes - 1 ? 1.0 : (number + 0.5) / count;
  };
  WarpMesh mesh;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const glm::ivec2 texel(std::min(column, texels.width - 1), std::min(row, texels.height - 1));
      const glm::dvec2 centre = (glm::dvec2(texel) + 0.5) / size;
      const glm::dvec2 place(place_of(column, columns, texels.width), place_of(row, rows, texels.height));
      mesh.nodes.push_back(node(place, texel, centre));
    }
  }
  add_grid_triangles(mesh, columns, rows, false);
  return mesh;
}

std::vector<glm::dvec2> warp_sources(const WarpMesh& mesh, const ImageSize& size, const std::string& what,
                                     size_t& overlapping) {
  constexpr double slack = 1e-9;   // so that no pixel falls between two triangles that share an edge
  constexpr double within = 1e-6;  // and none on one counts as an overlap
  constexpr int64_t most_covers = 300;
  const int64_t pixel_count = int64_t{size.width} * size.height;
  std::vector<ScreenTriangle> triangles;
  int64_t work = 0, mirrored = 0;
  for (const auto& corners : mesh.triangles) {
    const ScreenTriangle triangle(mesh, corners, size);
    if (triangle.pixels.empty()) continue;
    work += int64_t{triangle.pixels.width()} * triangle.pixels.height();
    // A mesh finer than the pixels still touches a few pixels with each triangle.
    if (work > most_covers * pixel_count + 16 * static_cast<int64_t>(mesh.triangles.size())) {
      throw InputError("{}: the mesh covers the image more than {} times over", what, most_covers);
    }
    mirrored += triangle.mirrored ? 1 : -1;
    triangles.push_back(triangle);
  }
  const bool usual = mirrored > 0;

  enum class Shown : uint8_t { nothing, edge, turned, upright };
  std::vector<glm::dvec2> sources(static_cast<size_t>(pixel_count), glm::dvec2(nan));
  std::vector<Shown> shown(sources.size(), Shown::nothing);
  std::vector<bool> twice(sources.size(), false);
  for (const ScreenTriangle& triangle : triangles) {
    for (int y = triangle.pixels.y0; y < triangle.pixels.y1; ++y) {
      for (int x = triangle.pixels.x0; x < triangle.pixels.x1; ++x) {
        const glm::dvec3 weights = triangle.weights({x + 0.5, y + 0.5});
        const double least = std::min({weights.x, weights.y, weights.z});
        if (!(least >= -slack)) continue;
        const size_t i = static_cast<size_t>(y) * size.width + x;
        const Shown kind = triangle.mirrored != usual ? Shown::turned : least > within ? Shown::upright : Shown::edge;
        if (kind != Shown::edge && shown[i] > Shown::edge && least > within) twice[i] = true;
        const bool better = shown[i] == Shown::nothing || (shown[i] == Shown::turned && kind != Shown::turned);
        if (better) {
          sources[i] = weights.x * triangle.source[0] + weights.y * triangle.source[1] + weights.z * triangle.source[2];
          shown[i] = kind;
        } else if (shown[i] == Shown::edge && kind == Shown::upright) {
          shown[i] = kind;
        }
      }
    }
  }
  overlapping = static_cast<size_t>(std::ranges::count(twice, true));
  return sources;
}

Camera warped_camera(const WarpMesh& mesh, const Camera& base, const ImageSize& size, const std::string& file,
                     const std::string& source, const Limits& limits) {
  if (auto pieces = warped_pieces(mesh, base, size, source)) {
    const std::vector<Piece>& all = pieces->pieces();
    size_t under = 0;
    for (uint32_t i = 0; i < all.size(); ++i) under += pieces->contested(i);
    if (under > 0) {
      warn(
          fmt::format("{}: folded: {} of {} triangles lie under others, of which the first that is not turned over is "
                      "seen",
                      file, under, all.size()));
    }
    return Camera(std::move(*pieces));
  }
  check_deformed_size(size, source, limits);
  size_t overlapping = 0;
  const std::vector<glm::dvec2> sources = warp_sources(mesh, size, file, overlapping);
  if (overlapping > 0) {
    warn(fmt::format("{}: folded: triangles overlap in {} of {} pixels, which show the first that is not turned over",
                     file, overlapping, sources.size()));
  }
  const glm::dvec2 base_size(base.size().width, base.size().height);
  constexpr double slack = 1e-9;
  return deformed_camera(size, source, limits, [&](const glm::dvec2& pixel) -> std::optional<glm::dvec3> {
    const glm::dvec2 point = sources[static_cast<size_t>(pixel.y) * size.width + static_cast<size_t>(pixel.x)];
    const bool inside = std::min(point.x, point.y) >= -slack && std::max(point.x, point.y) <= 1.0 + slack;
    if (!inside) return {};
    const auto ray = base.unproject(glm::clamp(point, 0.0, 1.0) * base_size);
    if (!ray) return {};
    return ray->direction;
  });
}

Camera base_camera(const DeformationText& text, std::span<const char* const> own_keys,
                   std::optional<ImageSize> own_size, std::optional<ImageSize> size) {
  std::string base = text.value("base");
  Spec spec{base, text.spec().values};
  for (const char* key : own_keys) spec.values.erase(key);
  if (own_size) {
    spec.values["width"] = std::to_string(own_size->width);
    spec.values["height"] = std::to_string(own_size->height);
  }
  return make_camera(spec_text(spec), size, text.limits());
}

FloatImage read_vectors(const std::filesystem::path& path, const Limits& limits) {
  const std::string name = path.string();
  const Image image = read_image(path, limits);
  const auto* vectors = std::get_if<FloatImage>(&image);
  if (!vectors || vectors->components < 2) {
    throw InputError("{}: {} component{} of {} a pixel; two are expected in R and G", name, image_components(image),
                     image_components(image) == 1 ? "" : "s", vectors ? "floats" : "whole numbers");
  }
  const size_t pixels = static_cast<size_t>(vectors->size.width) * static_cast<size_t>(vectors->size.height);
  if (pixels > limits.warp_nodes) {
    throw InputError("{}: {} x {} pixels make a mesh: {}", name, vectors->size.width, vectors->size.height,
                     limit_text(limits, &Limits::warp_nodes));
  }
  return *vectors;
}

}  // namespace omma
