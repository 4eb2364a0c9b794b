#include "omma/technique/piecewise/gpu_pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "omma/technique/target.h"

namespace omma {
namespace {

/// Pixels by which pieces are enlarged before triangles are clipped to them: far more than rounding moves an edge.
constexpr double margin = 0.25;

/// Texels, as in shaders/technique/piecewise/pieces.glsl.
struct PieceRecord {
  glm::vec4 clipFromCamera[3];
  glm::vec4 plane[4];
  glm::vec4 ray[4];
};

/// Texels, as in shaders/technique/piecewise/owner.glsl.
struct PolygonRecord {
  glm::ivec4 corners[2];
  glm::ivec4 sides[2];
  glm::ivec4 flags;
};
enum : int { mirrored_flag = 1, wide_flag = 2, contested_flag = 4 };

constexpr size_t children = 4;

struct Frame {
  glm::dvec2 corner;  ///< of the tile as the pass samples it, image pixels
  glm::dvec2 size;
};

int corner_at(const Piece& piece, int k) { return std::min(k, piece.corner_count - 1); }

/// A side's line in the image: positive on the piece's side, in pixels.
glm::dvec3 side_line(const Piece& piece, int k) {
  const glm::dvec2 from = piece.corners[size_t(k)];
  const glm::dvec2 side = piece.corners[size_t((k + 1) % piece.corner_count)] - from;
  return glm::dvec3(-side.y, side.x, side.y * from.x - side.x * from.y) / glm::length(side);
}

/// A corner of the enlarged piece; at sharp ones no farther out than eight margins.
glm::dvec2 enlarged_corner(const Piece& piece, int k) {
  const glm::dvec2 before(side_line(piece, (k + piece.corner_count - 1) % piece.corner_count));
  const glm::dvec2 after(side_line(piece, k));
  const glm::dvec2 outward = -(before + after);
  // Along the bisector the lines, moved by the margin, meet where its component along their normals is the margin.
  const double along = glm::dot(outward, -after);
  if (along < 1e-9) return piece.corners[size_t(k)];
  const double length = margin / along;
  return piece.corners[size_t(k)] + outward * std::min(length, 8.0 * margin / glm::length(outward));
}

PieceRecord make_record(const PieceSet& set, uint32_t number, const Frame& frame, std::array<glm::dvec3, 4>& planes) {
  const Piece& piece = set.pieces()[number];
  PieceRecord record{};
  const glm::dmat3 rows = glm::transpose(piece.imageFromRay);
  record.clipFromCamera[0] = glm::vec4((2.0 * (rows[0] - frame.corner.x * rows[2]) / frame.size.x) - rows[2], 0.0);
  record.clipFromCamera[1] = glm::vec4((2.0 * (rows[1] - frame.corner.y * rows[2]) / frame.size.y) - rows[2], 0.0);
  record.clipFromCamera[2] = glm::vec4(rows[2], 0.0);
  for (int k = 0; k < 4; ++k) {
    const int at = corner_at(piece, k);
    glm::dvec3 line = side_line(piece, at);
    line.z += margin;
    planes[size_t(k)] = glm::normalize(rows * line);
    record.plane[k] = glm::vec4(planes[size_t(k)], 0.0);
    const glm::dvec3 ray = set.rayFromImage(number) * glm::dvec3(enlarged_corner(piece, at), 1.0);
    record.ray[k] = glm::vec4(glm::normalize(ray), 0.0);
  }
  return record;
}

PolygonRecord make_polygon(const PieceSet& set, uint32_t number, const Frame& frame) {
  const Piece& piece = set.pieces()[number];
  std::array<glm::ivec2, 4> corners, sides;
  for (int k = 0; k < 4; ++k) {
    corners[size_t(k)] = on_piece_grid(piece.corners[size_t(corner_at(piece, k))] - frame.corner);
  }
  int64_t longest = 0, reach = 0;
  for (int k = 0; k < 4; ++k) {
    const glm::ivec2 side = corners[size_t((k + 1) % 4)] - corners[size_t(k)];
    const int common = std::max(1, std::gcd(side.x, side.y));
    sides[size_t(k)] = side / common;
    longest = std::max<int64_t>({longest, std::abs(sides[size_t(k)].x), std::abs(sides[size_t(k)].y)});
    // A fragment may be as far from this corner as the other corners are, and a little farther.
    const glm::ivec2 diagonal = corners[size_t((k + 2) % 4)] - corners[size_t(k)];
    reach = std::max<int64_t>({reach, std::abs(side.x), std::abs(side.y), std::abs(diagonal.x), std::abs(diagonal.y)});
  }
  PolygonRecord record{};
  for (int pair = 0; pair < 2; ++pair) {
    record.corners[pair] = glm::ivec4(corners[size_t(2 * pair)], corners[size_t(2 * pair + 1)]);
    record.sides[pair] = glm::ivec4(sides[size_t(2 * pair)], sides[size_t(2 * pair + 1)]);
  }
  // Positive as for the perspective camera, whose picture has y down where its frame has y up and looks along -z.
  record.flags.x = (glm::determinant(piece.imageFromRay) > 0.0 ? 0 : mirrored_flag) |
                   (longest * (reach + 4 * piece_grid) < (int64_t(1) << 28) ? 0 : wide_flag) |
                   (set.contested(number) ? contested_flag : 0);
  return record;
}

uint64_t interleaved(uint32_t value) {
  uint64_t bits = 0;
  for (int i = 0; i < 17; ++i) bits |= uint64_t(value >> i & 1u) << (2 * i);
  return bits;
}

/// Pieces near each other in the image come one after another.
uint64_t morton(const Piece& piece) {
  glm::dvec2 sum(0.0);
  for (int k = 0; k < piece.corner_count; ++k) sum += piece.corners[size_t(k)];
  const glm::uvec2 place(glm::clamp(sum / double(piece.corner_count) + 1024.0, 0.0, 131071.0));
  return interleaved(place.x) | interleaved(place.y) << 1;
}

/// The node over pieces `first` to `last`, and all below it.
void add_node(std::vector<ConeNode>& nodes, const std::vector<PieceRecord>& pieces, size_t first, size_t last) {
  glm::dvec3 axis(0.0);
  for (size_t p = first; p < last; ++p) {
    for (const glm::vec4& ray : pieces[p].ray) axis += glm::dvec3(ray);
  }
  axis = glm::length(axis) > 1e-9 ? glm::normalize(axis) : glm::dvec3(0, 0, -1);
  double cosine = 1.0;
  for (size_t p = first; p < last; ++p) {
    for (const glm::vec4& ray : pieces[p].ray) cosine = std::min(cosine, glm::dot(axis, glm::dvec3(ray)));
  }
  const size_t number = nodes.size();
  nodes.emplace_back(axis, std::acos(std::min(cosine, 1.0)), last - first == 1 ? uint32_t(first) : ConeNode::no_piece);
  if (last - first > 1) {
    const size_t step = (last - first + children - 1) / children;
    for (size_t begin = first; begin < last; begin += step) {
      add_node(nodes, pieces, begin, std::min(begin + step, last));
    }
  }
  nodes[number].link.x = uint32_t(nodes.size());
}

}  // namespace

void GpuPieces::set(const Camera& pieces, const View& view) {
  sample_places_ = view.sample_places;
  if (camera_ == pieces && tile_ == view.tile && shift_ == view.shift) return;
  camera_ = pieces;
  set_ = camera_->pieces();
  tile_ = view.tile;
  shift_ = view.shift;

  std::vector<std::pair<uint64_t, uint32_t>> keys;
  for (uint32_t i = 0; i < set_->pieces().size(); ++i) {
    const Piece& piece = set_->pieces()[i];
    glm::dvec2 low = piece.corners[0], high = low;
    for (int k = 1; k < piece.corner_count; ++k) {
      low = glm::min(low, piece.corners[size_t(k)]);
      high = glm::max(high, piece.corners[size_t(k)]);
    }
    const bool reaches = high.x > tile_.x0 - 1 && low.x < tile_.x1 + 1 && high.y > tile_.y0 - 1 && low.y < tile_.y1 + 1;
    if (reaches) keys.emplace_back(morton(piece), i);
  }
  std::sort(keys.begin(), keys.end());

  const Frame frame{glm::dvec2(tile_.x0, tile_.y0) + shift_, glm::dvec2(tile_.width(), tile_.height())};
  std::vector<PieceRecord> records;
  std::vector<PolygonRecord> polygons;
  std::vector<uint32_t> order;
  planes_.assign(keys.size(), {});
  mirrored_.clear();
  overlapping_ = false;
  for (const auto& [key, number] : keys) {
    records.push_back(make_record(*set_, number, frame, planes_[records.size()]));
    polygons.push_back(make_polygon(*set_, number, frame));
    order.push_back(number);
    mirrored_.push_back((polygons.back().flags.x & mirrored_flag) != 0);
    overlapping_ |= (polygons.back().flags.x & contested_flag) != 0;
  }
  any_mirrored_ = std::find(mirrored_.begin(), mirrored_.end(), true) != mirrored_.end();
  all_mirrored_ = std::find(mirrored_.begin(), mirrored_.end(), false) == mirrored_.end();
  std::vector<ConeNode> nodes;
  if (!records.empty()) add_node(nodes, records, 0, records.size());
  node_count_ = int(nodes.size());
  records_.write(std::span<const PieceRecord>(records));
  polygons_.write(std::span<const PolygonRecord>(polygons));
  nodes_.write(std::span<const ConeNode>(nodes));
  if (overlapping_) fill_bins(order);
}

void GpuPieces::fill_bins(const std::vector<uint32_t>& order) {
  std::vector<uint32_t> place(set_->pieces().size(), ConeNode::no_piece);
  for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<uint32_t> first, pieces;
  for (size_t bin = 0; bin + 1 < set_->bin_first().size(); ++bin) {
    first.push_back(uint32_t(pieces.size()));
    for (uint32_t i = set_->bin_first()[bin]; i < set_->bin_first()[bin + 1]; ++i) {
      if (const uint32_t at = place[set_->bin_pieces()[i]]; at != ConeNode::no_piece) pieces.push_back(at);
    }
  }
  first.push_back(uint32_t(pieces.size()));
  bin_first_.write(std::span<const uint32_t>(first));
  bin_pieces_.write(std::span<const uint32_t>(pieces));
}

void GpuPieces::bind() const {
  records_.bind(16);
  polygons_.bind(17);
  nodes_.bind(18);
  if (!overlapping_) return;
  bin_first_.bind(10);
  bin_pieces_.bind(11);
}

gl::Defines GpuPieces::coverage_defines() const { return {{"COVERAGE", "technique/piecewise/coverage.glsl"}}; }

gl::Defines GpuPieces::defines() const {
  gl::Defines defines{{"PIECES", "1"}, {"SAMPLES", std::to_string(sample_places_.size())}};
  if (overlapping_) defines["OVERLAPPING_PIECES"] = "1";
  return defines;
}

void GpuPieces::set_uniforms(const gl::Program& program) const {
  program.set("near_depth", near_depth);
  program.set("node_count", node_count_);
  program.set("sample_places", sample_places_);
  if (!overlapping_) return;
  const glm::dvec2 corner = glm::dvec2(tile_.x0, tile_.y0) + shift_;
  program.set("bin_origin", glm::ivec2(on_piece_grid(corner + double(PieceSet::bin_side))));
  program.set("bin_counts", set_->bin_counts());
  program.set("bin_side", PieceSet::bin_side * piece_grid);
}

bool GpuPieces::may_show(size_t piece, const glm::dmat4& cameraFromWorld, const Bounds& world) const {
  int beyond = 15;
  for (int corner = 0; corner < 8 && beyond != 0; ++corner) {
    const glm::dvec3 point(corner & 1 ? world.max.x : world.min.x, corner & 2 ? world.max.y : world.min.y,
                           corner & 4 ? world.max.z : world.min.z);
    const glm::dvec3 seen(cameraFromWorld * glm::dvec4(point, 1.0));
    for (int k = 0; k < 4; ++k) {
      if (glm::dot(planes_[piece][size_t(k)], seen) >= 0.0) beyond &= ~(1 << k);
    }
  }
  return beyond == 0;
}

}  // namespace omma
