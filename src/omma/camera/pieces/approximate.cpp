#include "omma/camera/pieces/approximate.h"
#include <cmath>
namespace omma {
Approximation approximate(const Camera& camera, const PieceOptions& options) {
  if (camera.pieces()) return {*camera.pieces(), {}, "own"};
  const ImageSize size = camera.size();
  std::vector<Piece> pieces;
  int n = options.count ? options.count : 160;
  auto snap = [](double v) { return std::round(v * 256) / 256; };
  int rows = 1;
  const bool strips = std::string(camera.lens()->model->info.name) == "cylinder";
  int cols = n;
  if (!strips) {
    cols = int(std::sqrt(n / 2.0 * size.width / size.height)) + 1;
    rows = cols * size.height / size.width;
  }
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < cols; ++c) {
      double x0 = snap(size.width * double(c) / cols), x1 = snap(size.width * double(c + 1) / cols),
             y0 = snap(size.height * double(r) / rows), y1 = snap(size.height * double(r + 1) / rows);
      auto ray = [&](double x, double y) {
        auto d = camera.unproject({x, y});
        glm::dvec3 v = d ? d->direction : glm::dvec3(0);
        if (strips) v /= std::hypot(v.x, v.z);
        return v;
      };
      auto tri = [&](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c2) {
        glm::dvec3 ra = ray(a.x, a.y), rb = ray(b.x, b.y), rc = ray(c2.x, c2.y);
        if (ra == glm::dvec3(0) || rb == glm::dvec3(0) || rc == glm::dvec3(0)) return glm::dmat3(0.0);
        glm::dmat3 R(ra, rb, rc), P(glm::dvec3(a, 1), glm::dvec3(b, 1), glm::dvec3(c2, 1));
        return P * glm::inverse(R);
      };
      if (strips) {
        Piece p;
        p.corner_count = 4;
        p.corners = {glm::dvec2(x0, y0), {x1, y0}, {x1, y1}, {x0, y1}};
        p.imageFromRay = tri({x0, y0}, {x1, y0}, {x1, y1});
        pieces.push_back(p);
      } else {
        Piece p;
        p.corner_count = 3;
        p.corners = {glm::dvec2(x0, y0), {x1, y0}, {x1, y1}, {}};
        p.imageFromRay = tri(p.corners[0], p.corners[1], p.corners[2]);
        if (p.imageFromRay != glm::dmat3(0.0)) pieces.push_back(p);
        p.corners = {glm::dvec2(x0, y0), {x1, y1}, {x0, y1}, {}};
        p.imageFromRay = tri(p.corners[0], p.corners[1], p.corners[2]);
        if (p.imageFromRay != glm::dmat3(0.0)) pieces.push_back(p);
      }
    }
  return {PieceSet(size, pieces, ""), {}, "scratch"};
}
}  // namespace omma
