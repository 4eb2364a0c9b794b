#include "omma/image/ssim.h"

#include <array>
#include <cmath>

namespace omma {
namespace {

/// Sums of weighted values over a window: means, second moments and the mixed moment.
struct Moments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(double weight, const Moments& other) {
    a += weight * other.a;
    b += weight * other.b;
    aa += weight * other.aa;
    bb += weight * other.bb;
    ab += weight * other.ab;
  }
};

std::array<double, ssim_window> gaussian() {
  constexpr double sigma = 1.5;
  std::array<double, ssim_window> weights{};
  double sum = 0.0;
  for (int i = 0; i < ssim_window; ++i) {
    const double x = i - ssim_window / 2;
    sum += weights[i] = std::exp(-x * x / (2.0 * sigma * sigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

double structural_similarity(const FloatImage& a, const FloatImage& b, double peak) {
  const std::array<double, ssim_window> weights = gaussian();
  const double c1 = std::pow(0.01 * peak, 2), c2 = std::pow(0.03 * peak, 2);
  const int columns = a.size.width, rows = a.size.height - ssim_window + 1;

  double sum = 0.0;
  std::vector<Moments> column(columns);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      column[x] = {};
      for (int i = 0; i < ssim_window; ++i) {
        const double va = *a.at(x, y + i), vb = *b.at(x, y + i);
        column[x].add(weights[i], {va, vb, va * va, vb * vb, va * vb});
      }
    }
    for (int x = 0; x + ssim_window <= columns; ++x) {
      Moments m;
      for (int i = 0; i < ssim_window; ++i) m.add(weights[i], column[x + i]);
      const double variances = (m.aa - m.a * m.a) + (m.bb - m.b * m.b);
      const double covariance = m.ab - m.a * m.b;
      const double similarity = (2.0 * m.a * m.b + c1) * (2.0 * covariance + c2);
      sum += similarity / ((m.a * m.a + m.b * m.b + c1) * (variances + c2));
    }
  }
  return sum / (double(rows) * (columns - ssim_window + 1));
}

}  // namespace omma
