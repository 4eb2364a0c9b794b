#include "bench/measure_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <optional>

namespace omma::bench {
namespace {

constexpr double step = 0.25;  // pixels between samples of a profile

/// The pixel of a direction, also for cameras that have rays but no formula to project with.
class PixelFinder {
 public:
  explicit PixelFinder(const Camera& camera) : camera_(camera) {
    if (camera.lens() != nullptr) return;
    for (int y = spacing / 2; y < camera.size().height; y += spacing) {
      for (int x = spacing / 2; x < camera.size().width; x += spacing) {
        if (const auto ray = camera.unproject({x, y})) seeds_.push_back({glm::dvec2(x, y), ray->direction});
      }
    }
  }

  std::optional<glm::dvec2> find(const glm::dvec3& point) const {
    if (camera_.lens() != nullptr) return camera_.project(point);
    const glm::dvec3 direction = glm::normalize(point);
    const auto nearest = std::max_element(seeds_.begin(), seeds_.end(), [&](const Seed& a, const Seed& b) {
      return glm::dot(a.direction, direction) < glm::dot(b.direction, direction);
    });
    if (nearest == seeds_.end()) return std::nullopt;
    // Newton's method on the two components of the ray that lie across the direction.
    const glm::dvec3 side =
        glm::normalize(glm::cross(direction, std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 up = glm::cross(side, direction);
    glm::dvec2 pixel = nearest->pixel;
    for (int i = 0; i < 12; ++i) {
      const auto here = camera_.unproject(pixel), right = camera_.unproject(pixel + glm::dvec2(0.5, 0.0)),
                 below = camera_.unproject(pixel + glm::dvec2(0.0, 0.5));
      if (!here || !right || !below) return std::nullopt;
      const auto across = [&](const glm::dvec3& d) { return glm::dvec2(glm::dot(d, side), glm::dot(d, up)); };
      const glm::dvec2 off = across(here->direction);
      if (glm::length(off) < 1e-7 && glm::dot(here->direction, direction) > 0.0) return pixel;
      const glm::dmat2 change = 2.0 * glm::dmat2(across(right->direction) - off, across(below->direction) - off);
      if (glm::determinant(change) == 0.0) return std::nullopt;
      pixel -= glm::inverse(change) * off;
    }
    return std::nullopt;
  }

 private:
  static constexpr int spacing = 8;  // pixels
  struct Seed {
    glm::dvec2 pixel;
    glm::dvec3 direction;
  };
  const Camera& camera_;
  std::vector<Seed> seeds_;
};

/// Bilinear between pixel centres; nothing beyond them.
std::optional<double> read(const FloatImage& image, const glm::dvec2& pixel, int component) {
  const glm::dvec2 corner = pixel - 0.5;
  const int x = int(std::floor(corner.x)), y = int(std::floor(corner.y));
  if (x < 0 || y < 0 || x + 1 >= image.size.width || y + 1 >= image.size.height) return std::nullopt;
  const glm::dvec2 part = corner - glm::dvec2(x, y);
  const auto at = [&](int i, int j) { return double(image.at(x + i, y + j)[component]); };
  return glm::mix(glm::mix(at(0, 0), at(1, 0), part.x), glm::mix(at(0, 1), at(1, 1), part.x), part.y);
}

/// Ink at every step from `half` pixels before to `half` pixels behind a place; empty where the picture ends.
std::vector<double> ink_profile(const FloatImage& picture, const glm::dvec2& centre, const glm::dvec2& direction,
                                double half) {
  std::vector<double> ink;
  for (double s = -half; s <= half; s += step) {
    const auto value = read(picture, centre + s * direction, 0);
    if (!value) return {};
    ink.push_back(1.0 - *value);
  }
  return ink;
}

/// A triangle's edge with the third corners of the triangles on it, in the camera frame.
struct Edge {
  glm::dvec3 from, to;
  std::vector<glm::dvec3> corners;
};

std::vector<Edge> edges_of(const Mesh& mesh, const glm::dmat4& cameraFromMesh) {
  const auto point = [&](uint32_t i) { return glm::dvec3(cameraFromMesh * glm::dvec4(mesh.positions[i], 1.0)); };
  std::map<std::pair<uint32_t, uint32_t>, Edge> edges;
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      const auto ends = std::minmax(triangle[c], triangle[(c + 1) % 3]);
      Edge& edge = edges.try_emplace(ends, Edge{point(ends.first), point(ends.second), {}}).first->second;
      edge.corners.push_back(point(triangle[(c + 2) % 3]));
    }
  }
  std::vector<Edge> list;
  for (auto& [ends, edge] : edges) list.push_back(std::move(edge));
  return list;
}

/// The ink across an edge's middle; nothing where another edge, a seam or the picture's end is near.
std::optional<double> width_across(const FloatImage& picture, const Camera& camera, const PixelFinder& pixels,
                                   const Edge& edge) {
  constexpr double half = 7.0;        // pixels of profile on either side
  constexpr double clearance = 16.0;  // pixels to any other edge
  constexpr double piece = 0.04;      // of the edge, around its middle
  const glm::dvec3 middle = 0.5 * (edge.from + edge.to), part = 0.5 * piece * (edge.to - edge.from);
  const auto pixel = pixels.find(middle), before = pixels.find(middle - part), after = pixels.find(middle + part);
  if (!pixel || !before || !after) return std::nullopt;
  const double length = glm::length(*after - *before) / piece;
  if (length < 2.0 * clearance || length > 0.5 * picture.size.width) return std::nullopt;
  const glm::dvec2 along = glm::normalize(*after - *before), normal(-along.y, along.x);
  for (const glm::dvec3& point : edge.corners) {
    const auto corner = pixels.find(point);
    if (!corner) return std::nullopt;
    // Where the normal through the middle meets the triangle's other edges, were they straight.
    const double height = std::abs(glm::dot(*corner - *pixel, normal));
    const double foot = std::abs(glm::dot(*corner - *pixel, along)) / length;
    if (height * 0.5 / (foot + 0.5) < clearance) return std::nullopt;
  }
  const auto one_side = camera.unproject(*pixel + half * normal), other_side = camera.unproject(*pixel - half * normal);
  if (!one_side || !other_side || glm::dot(one_side->direction, other_side->direction) < 0.9) return std::nullopt;
  const std::vector<double> ink = ink_profile(picture, *pixel, normal, half);
  if (ink.empty()) return std::nullopt;
  double sum = 0.0;
  for (double value : ink) sum += value * step;
  return sum;
}

struct Stroke {
  double centre, ink;  // pixels
};

std::vector<Stroke> strokes_in(const std::vector<double>& ink) {
  constexpr double least = 0.03;
  std::vector<Stroke> strokes;
  for (size_t i = 0; i < ink.size();) {
    if (ink[i] < least) {
      ++i;
      continue;
    }
    Stroke stroke{0.0, 0.0};
    const bool cut = i == 0;
    for (; i < ink.size() && ink[i] >= least; ++i) {
      stroke.ink += ink[i] * step;
      stroke.centre += ink[i] * step * (double(i) * step);
    }
    stroke.centre /= stroke.ink;
    if (!cut && i < ink.size()) strokes.push_back(stroke);
  }
  return strokes;
}

}  // namespace

Scene make_measuring_ball(float grey) {
  constexpr int around = 36, down = 18;
  constexpr float radius = 5.0f;
  Scene scene;
  scene.name = "measuring ball";
  Material material;
  material.base_color = glm::vec4(glm::vec3(grey), 1.0f);
  material.unlit = true;
  material.double_sided = true;
  scene.materials.push_back(material);
  Mesh mesh;
  for (int j = 0; j <= down; ++j) {
    for (int i = 0; i <= around; ++i) {
      const float u = float(i) / around, v = float(j) / down;
      const float longitude = 2.0f * glm::pi<float>() * u, colatitude = glm::pi<float>() * v;
      const glm::vec3 normal(std::sin(colatitude) * std::sin(longitude), std::cos(colatitude),
                             std::sin(colatitude) * std::cos(longitude));
      mesh.positions.push_back(radius * normal);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(u, v);
    }
  }
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < around; ++i) {
      const auto corner = uint32_t(j * (around + 1) + i), below = corner + around + 1;
      if (j > 0) mesh.triangles.emplace_back(corner, below, corner + 1);
      if (j + 1 < down) mesh.triangles.emplace_back(corner + 1, below, below + 1);
    }
  }
  scene.meshes.push_back(mesh);
  scene.nodes.emplace_back();
  scene.instances.emplace_back();
  finish_scene(scene);
  return scene;
}

std::vector<double> edge_line_widths(const FloatImage& picture, const Scene& ball, const Camera& camera,
                                     const glm::dmat4& worldFromCamera) {
  const PixelFinder pixels(camera);
  std::vector<double> widths;
  for (const Edge& edge : edges_of(ball.meshes.front(), glm::inverse(worldFromCamera))) {
    const auto width = width_across(picture, camera, pixels, edge);
    if (width) widths.push_back(*width);
  }
  return widths;
}

Strokes measure_strokes(const FloatImage& picture, const FloatImage& uv) {
  constexpr double half = 45.0;  // pixels of profile on either side
  constexpr int places = 20;     // pixels from place to place
  Strokes result;
  for (int y = places; y < picture.size.height; y += places) {
    for (int x = places; x < picture.size.width; x += places) {
      const glm::dvec2 centre(x, y);
      const auto v = [&](const glm::dvec2& offset) { return read(uv, centre + offset, 1); };
      const auto right = v({2, 0}), left = v({-2, 0}), lower = v({0, 2}), upper = v({0, -2});
      if (!right || !left || !lower || !upper) continue;
      const glm::dvec2 gradient(0.25 * (*right - *left), 0.25 * (*lower - *upper));
      const double change = glm::length(gradient);
      if (!(change > 0.0)) continue;
      // Where v does not rise evenly along the profile, this is no one place: a pole, a seam, a bend.
      const glm::dvec2 direction = gradient / change;
      bool even = true;
      for (double s = -half; s <= half; s += 0.25 * half) {
        const auto here = v(s * direction), middle = v({0, 0});
        even = even && here && std::abs(*here - *middle - s * change) < 0.06 * half * change;
      }
      if (!even) continue;
      const std::vector<Stroke> strokes = strokes_in(ink_profile(picture, centre, direction, half));
      double most = 0.0;
      for (const Stroke& stroke : strokes) most = std::max(most, stroke.ink);
      std::vector<size_t> full;
      for (size_t i = 0; i < strokes.size(); ++i) {
        if (strokes[i].ink > 0.85 * most) full.push_back(i);
      }
      if (full.size() < 3) continue;
      double width = 0.0, ink = 0.0;
      for (size_t i : full) width += strokes[i].ink / double(full.size());
      for (size_t i = full.front() + 1; i <= full.back(); ++i) ink += std::min(strokes[i].ink, width);
      result.spacings.push_back((strokes[full.back()].centre - strokes[full.front()].centre) * width / ink);
      result.widths.push_back(width);
    }
  }
  return result;
}

Spread spread_of(std::span<const double> values) {
  if (values.empty()) return {};
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) { return sorted[size_t(std::lround(share * double(sorted.size() - 1)))]; };
  return {sorted.size(), at(0.05), at(0.5), at(0.95)};
}

}  // namespace omma::bench
