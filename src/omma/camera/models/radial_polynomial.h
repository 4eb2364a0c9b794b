// Polynomials without a constant term, p(x) = x (c0 + c1 y + … + c7 y⁷) with y = x, or y = x² where only odd powers
// occur, and where they take a value: what polynomial lenses of either direction, radius from angle or angle from
// radius, are made of.

// The value and the slope at x.
LENS_FUNCTION vec2 radial_polynomial(real c[8], bool odd, real x) {
  real y = odd ? x * x : x;
  real q = real(0.0);
  real slope = real(0.0);
  for (int i = 7; i >= 0; --i) {
    slope = slope * y + q;
    q = q * y + c[i];
  }
  return vec2(x * q, q + (odd ? real(2.0) : real(1.0)) * y * slope);
}

// The x in [0, high] before which p is less than the value and after which it is more; an end where there is none.
// Newton's method inside a bracket: a step that would leave it, or is not half of the one before, is a bisection
// instead, so that a flat end of the polynomial costs steps but never the answer.
LENS_FUNCTION real radial_polynomial_inverse(real c[8], bool odd, real value, real start, real high) {
  real low = real(0.0);
  real x = start >= real(0.0) && start <= high ? start : high;
  real last = high;
  for (int i = 0; i < 64; ++i) {
    vec2 p = radial_polynomial(c, odd, x);
    if (p.x > value) {
      high = x;
    } else {
      low = x;
    }
    real next = x + (value - p.x) / p.y;
    if (!(next >= low && next <= high) || abs(next - x) > real(0.5) * last) next = real(0.5) * (low + high);
    last = abs(next - x);
    x = next;
    if (last <= real(2.0) * lens_epsilon * x) break;
  }
  return x;
}
