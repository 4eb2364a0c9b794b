#include "omma/technique/subdivision/lens_field.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "omma/technique/camera_program.h"
#include "omma/technique/target.h"

namespace omma {
namespace {

/// Edges that are longer are split unseen: what samples at their quarters could miss is then small.
constexpr double longest_edge = 0.25;

/// Edges that are shorter are not split any more, pixels of the image's centre: no sample of a pixel is so near to a
/// pole or to the end of a seam.
constexpr double shortest_edge_px = 0.03;

/// The largest angle from the axis that the image shows, up to the lens's own, from no more than about `points` pixels.
double largest_angle(const Lens& lens, int points) {
  const glm::dvec3 axis = lens.cameraFromLens * glm::dvec3(0.0, 0.0, -1.0);
  const double step = std::max(1.0, std::sqrt(double(lens.size.width) * lens.size.height / points));
  const auto columns = int(std::ceil(lens.size.width / step)), rows = int(std::ceil(lens.size.height / step));
  double largest = 0.0;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const auto ray =
          lens.unproject({double(column) * lens.size.width / columns, double(row) * lens.size.height / rows});
      if (!ray) continue;
      largest = std::max(largest, std::atan2(glm::length(glm::cross(axis, *ray)), glm::dot(axis, *ray)));
    }
  }
  // Between those pixels there may be a little more, even at the border of a blind part of the image.
  constexpr double margin = 0.1;
  return std::min(largest + margin, lens.parameters.max_angle);
}

}  // namespace

bool shows_rays_twice(const Lens& lens) {
  const LensInfo& info = lens.model->info;
  if (info.parts == nullptr) return false;
  constexpr int points = 16;         // along each side of each part
  constexpr double inside = 0.99;    // of the way from a part's middle to its border
  constexpr double elsewhere = 2.0;  // pixels
  for (const PlanePolygon& part : info.parts(lens.parameters)) {
    const glm::dvec2 middle = std::accumulate(part.begin(), part.end(), glm::dvec2(0.0)) / double(part.size());
    for (size_t corner = 0; corner < part.size(); ++corner) {
      for (int i = 0; i < points; ++i) {
        const glm::dvec2 on_side = glm::mix(part[corner], part[(corner + 1) % part.size()], (i + 0.5) / points);
        const glm::dvec2 pixel = lens.centre + lens.focal * glm::mix(middle, on_side, inside);
        const auto ray = lens.unproject(pixel);
        const auto back = ray ? lens.project(*ray) : std::nullopt;
        if (back && glm::distance(*back, pixel) > elsewhere) return true;
      }
    }
  }
  return false;
}

LensField field_of(const Camera& camera) {
  const Lens& lens = *camera.lens();
  const double max_angle = lens.parameters.max_angle;
  LensField field;
  field.axis = glm::vec3(lens.cameraFromLens * glm::dvec3(0.0, 0.0, -1.0));
  field.angle = largest_angle(lens, 20000);
  field.longest_edge = std::min(longest_edge, field.angle / 4.0);
  // An edge that leaves the field is then seen from end to end.
  const double further = 1.2 * field.longest_edge;
  const LensInfo& info = lens.model->info;
  field.wide = info.widened != nullptr ? info.widened(lens.parameters, further) : lens.parameters;
  field.wide.max_angle = std::max(max_angle, std::min(info.max_angle(field.wide), max_angle + further));
  if (info.parts != nullptr) {
    for (const PlanePolygon& part : info.parts(lens.parameters)) {
      for (size_t i = 0; i < 4; ++i) {
        field.part_corners.emplace_back(lens.centre + lens.focal * part[std::min(i, part.size() - 1)]);
      }
    }
  }
  field.pixels_per_radian = camera.pixels_per_radian();
  return field;
}

gl::Defines subdivision_defines(const LensField& field, const View& view) {
  gl::Defines defines = camera_defines(view.camera);
  defines["NEAR"] = fmt::format("{:.9f}", near_depth);
  if (!field.part_corners.empty()) defines["PART_COUNT"] = std::to_string(field.part_corners.size() / 4);
  return defines;
}

void set_field(const gl::Program& program, const LensField& field, const View& view, double tolerance_px) {
  set_camera(program, view);
  program.set("lens_max_angle", float(field.wide.max_angle));
  std::array<float, LensParameters::max_count> k{};
  std::copy(field.wide.k.begin(), field.wide.k.end(), k.begin());
  program.set("lens_k", std::span<const float>(k));
  if (!field.part_corners.empty()) program.set("part_corners", std::span<const glm::vec2>(field.part_corners));
  const glm::vec2 size(view.size().width, view.size().height);
  program.set("tile_size", size);
  constexpr float outside = 1.0f;  // pixels: shifted samples lie that far out at most
  const glm::vec2 corner(view.tile.x0, view.tile.y0);
  program.set("tile_border", glm::vec4(corner - outside, corner + size + outside));
  program.set("tolerance", float(tolerance_px));
  const double shortest = shortest_edge_px / std::max(1.0, field.pixels_per_radian);
  program.set("edge_range", glm::vec2(2.0 * std::sin(field.longest_edge / 2.0), shortest));
  program.set("field_axis", field.axis);
  program.set("field_angle", glm::vec2(std::cos(field.angle), std::sin(field.angle)));
}

}  // namespace omma
