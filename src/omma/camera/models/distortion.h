// The distortion of OpenCV and all who follow it: radial (a polynomial of r², or a quotient of two), tangential and
// thin prism terms on a plane, their derivatives, and the way back.

struct Distortion {
  real numerator[6];    // of r², r⁴, … r¹²
  real denominator[3];  // of r², r⁴, r⁶
  vec2 tangential;      // p1, p2 in OpenCV's order: p1 goes with r² + 2 y²
  vec4 prism;           // s1, s2 on x and s3, s4 on y, of r² and r⁴
};

// The distorted point, and its derivatives: x by x, x by y, y by x, y by y.
LENS_FUNCTION void distort(Distortion d, vec2 u, OUT(vec2) distorted, OUT(vec4) slope) {
  real s = dot(u, u);
  real top = real(0.0);
  real top_slope = real(0.0);
  for (int i = 5; i >= 0; --i) {
    top = (top + d.numerator[i]) * s;
    top_slope = top_slope * s + real(i + 1) * d.numerator[i];
  }
  real bottom = real(0.0);
  real bottom_slope = real(0.0);
  for (int i = 2; i >= 0; --i) {
    bottom = (bottom + d.denominator[i]) * s;
    bottom_slope = bottom_slope * s + real(i + 1) * d.denominator[i];
  }
  real scale = (real(1.0) + top) / (real(1.0) + bottom);
  real scale_slope = (top_slope - scale * bottom_slope) / (real(1.0) + bottom);

  real p1 = d.tangential.x;
  real p2 = d.tangential.y;
  distorted = vec2(
      u.x * scale + real(2.0) * p1 * u.x * u.y + p2 * (s + real(2.0) * u.x * u.x) + s * (d.prism.x + s * d.prism.y),
      u.y * scale + real(2.0) * p2 * u.x * u.y + p1 * (s + real(2.0) * u.y * u.y) + s * (d.prism.z + s * d.prism.w));
  // ∂s/∂x = 2x, ∂s/∂y = 2y.
  real cross = real(2.0) * (u.x * u.y * scale_slope + p1 * u.x + p2 * u.y);
  real prism_x = real(2.0) * (d.prism.x + real(2.0) * s * d.prism.y);
  real prism_y = real(2.0) * (d.prism.z + real(2.0) * s * d.prism.w);
  slope =
      vec4(scale + real(2.0) * u.x * u.x * scale_slope + real(2.0) * p1 * u.y + real(6.0) * p2 * u.x + prism_x * u.x,
           cross + prism_x * u.y, cross + prism_y * u.x,
           scale + real(2.0) * u.y * u.y * scale_slope + real(2.0) * p2 * u.x + real(6.0) * p1 * u.y + prism_y * u.y);
}

// The point within `limit` of the centre that is distorted to the target; false when there is none. Newton's method; a
// step that does not bring it nearer is halved.
LENS_FUNCTION bool undistort(Distortion d, vec2 target, real limit, OUT(vec2) u) {
  u = vec2(real(0.0));
  if (!(length(target) < real(1e8))) return false;  // its square must not overflow
  real tolerance = real(64.0) * lens_epsilon * (real(1.0) + length(target));
  real inside = limit * (real(1.0) + real(8.0) * lens_epsilon);
  u = target * min(real(1.0), real(0.9) * limit / max(length(target), lens_epsilon));
  vec2 distorted;
  vec4 slope;
  distort(d, u, distorted, slope);
  vec2 error = target - distorted;
  vec2 step = vec2(real(0.0));
  real part = real(0.0);  // of the step that is tried; 0: a new one is due
  for (int i = 0; i < 96; ++i) {
    if (part == real(0.0)) {
      real det = slope.x * slope.w - slope.y * slope.z;
      if (det == real(0.0)) break;
      step = vec2(slope.w * error.x - slope.y * error.y, slope.x * error.y - slope.z * error.x) / det;
      real size = length(step);
      if (size <= lens_epsilon * length(u)) break;
      part = min(real(1.0), real(0.5) * limit / size);
    }
    vec2 next = u + part * step;
    next = next * min(real(1.0), inside / max(length(next), lens_epsilon));
    vec2 next_distorted;
    vec4 next_slope;
    distort(d, next, next_distorted, next_slope);
    vec2 next_error = target - next_distorted;
    if (length(next_error) < length(error)) {
      u = next;
      slope = next_slope;
      error = next_error;
      part = real(0.0);
    } else {
      part *= real(0.5);
      if (length(error) <= tolerance && part < real(0.2)) break;
    }
  }
  return length(error) <= tolerance;
}

#ifdef __cplusplus
// The radius, `limit` at most, within which no two points are distorted to the same one: throughout that disc the
// symmetric part of the derivative is positive definite. The radial part alone is to rise up to `limit`. Looked for
// along 64 directions in steps of a few percent.
inline double invertible_radius(const Distortion& d, double limit) {
  const auto unique = [&](const glm::dvec2& direction, double r) {
    vec2 distorted;
    vec4 slope;
    distort(d, vec2(direction * r), distorted, slope);
    const double shear = 0.5 * (slope.y + slope.z);
    return slope.x > 0 && slope.w > 0 && slope.x * slope.w > shear * shear;
  };
  if (d.tangential == vec2(real(0)) && d.prism == vec4(real(0))) return limit;
  for (int i = 0; i < 64; ++i) {
    const glm::dvec2 direction(std::cos(i * pi / 32), std::sin(i * pi / 32));
    constexpr int steps = 512;
    const double growth = std::pow((1 + limit) / 1e-3, 1.0 / steps);
    double inside = 0, outside = limit, r = limit * 1e-3 / (1 + limit);
    for (int step = 1; step <= steps && outside == limit; ++step) {
      r = step == steps ? limit : r * growth;
      (unique(direction, r) ? inside : outside) = r;
    }
    if (inside >= outside) continue;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (inside + outside);
      (unique(direction, middle) ? inside : outside) = middle;
    }
    limit = inside;
  }
  return limit;
}
#endif
