// GLSL's types and functions as C++, of sixteen fragments at a time: what shaders/shading/language.glsl promises.
// Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_SOFTWARE_GLSL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_SOFTWARE_GLSL_INL_H_
#undef OMMA_SOFTWARE_GLSL_INL_H_
#else
#define OMMA_SOFTWARE_GLSL_INL_H_
#endif

#include <glm/glm.hpp>

#include <hwy/contrib/math/math-inl.h>

#include "omma/visibility/simd16-inl.h"

#define OUT(type) type&
#define SHADING HWY_INLINE

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

using IntTag = hn::RebindToSigned<FloatTag>;

/// Sixteen floats that a number turns into.
struct real : Floats {
  HWY_INLINE real() = default;
  HWY_INLINE real(const Floats& values) : Floats(values) {}
  HWY_INLINE real(int value) : Floats(all(float(value))) {}
  HWY_INLINE real(float value) : Floats(all(value)) {}
  HWY_INLINE real(double value) : Floats(all(float(value))) {}
};
using truth = Mask;

#define OMMA_OPERATORS(type, other)                                          \
  HWY_INLINE type& operator+=(type& a, const other& b) { return a = a + b; } \
  HWY_INLINE type& operator-=(type& a, const other& b) { return a = a - b; } \
  HWY_INLINE type& operator*=(type& a, const other& b) { return a = a * b; } \
  HWY_INLINE type& operator/=(type& a, const other& b) { return a = a / b; }
#define OMMA_BINARY(name, function)                                                \
  HWY_INLINE real name(const real& a, const real& b) {                             \
    return function(static_cast<const Floats&>(a), static_cast<const Floats&>(b)); \
  }
OMMA_BINARY(operator+, HWY_NAMESPACE::operator+)
OMMA_BINARY(operator-, HWY_NAMESPACE::operator-)
OMMA_BINARY(operator*, HWY_NAMESPACE::operator*)
OMMA_BINARY(operator/, HWY_NAMESPACE::operator/)
OMMA_BINARY(min, HWY_NAMESPACE::min)
OMMA_BINARY(max, HWY_NAMESPACE::max)
#undef OMMA_BINARY
HWY_INLINE real operator-(const real& a) { return real(0.0f) - a; }
OMMA_OPERATORS(real, real)

#define OMMA_COMPARE(name)                                                                    \
  HWY_INLINE truth name(const real& a, const real& b) {                                       \
    return HWY_NAMESPACE::name(static_cast<const Floats&>(a), static_cast<const Floats&>(b)); \
  }
OMMA_COMPARE(operator<)
OMMA_COMPARE(operator<=)
OMMA_COMPARE(operator>)
OMMA_COMPARE(operator>=)
OMMA_COMPARE(operator==)
#undef OMMA_COMPARE

#define OMMA_UNARY(name, ...)                                        \
  HWY_INLINE real name(const real& a) {                              \
    [[maybe_unused]] const FloatTag d;                               \
    real r;                                                          \
    for (size_t k = 0; k < registers; ++k) r.v[k] = hn::__VA_ARGS__; \
    return r;                                                        \
  }
OMMA_UNARY(abs, Abs(a.v[k]))
OMMA_UNARY(floor, Floor(a.v[k]))
OMMA_UNARY(ceil, Ceil(a.v[k]))
OMMA_UNARY(sqrt, Sqrt(a.v[k]))
OMMA_UNARY(log2, Log2(d, a.v[k]))
OMMA_UNARY(sin, Sin(d, a.v[k]))
OMMA_UNARY(cos, Cos(d, a.v[k]))
/// e to the power of; silent where it is too small for a float.
OMMA_UNARY(exp, Exp(d, hn::Max(a.v[k], hn::Set(d, -87.0f))))
#undef OMMA_UNARY

/// One step of Newton's after the processor's estimate. Infinite at zero, as the quotient is.
HWY_INLINE real inversesqrt(const real& a) {
  const real estimate = rough_inverse_sqrt(a);
  const real better = estimate * (real(1.5) - real(0.5) * a * estimate * estimate);
  return HWY_NAMESPACE::choose(a > real(1e-37), better, estimate);
}
HWY_INLINE real mix(const real& a, const real& b, const real& part) { return mul_add(part, b - a, a); }
HWY_INLINE real clamp(const real& a, const real& low, const real& high) { return min(max(a, low), high); }
HWY_INLINE real fract(const real& a) { return a - floor(a); }
/// Exact for whole numbers.
HWY_INLINE real exp2(const real& a) {
  const IntTag d;
  const real bounded = clamp(a, -126.0f, 127.0f), whole = floor(bounded);
  real power;
  for (size_t k = 0; k < registers; ++k) {
    const auto exponent = hn::Add(hn::ConvertTo(d, whole.v[k]), hn::Set(d, 127));
    power.v[k] = hn::BitCast(FloatTag(), hn::ShiftLeft<23>(exponent));
  }
  return exp((bounded - whole) * real(0.693147180559945)) * power;
}
/// Of what is not negative; zero at zero.
HWY_INLINE real pow(const real& a, const real& power) {
  return HWY_NAMESPACE::choose(a > real(1e-37), exp2(log2(max(a, real(1e-37))) * power), real(0.0f));
}
HWY_INLINE real radians(const real& degrees) { return degrees * real(0.0174532925199433); }
HWY_INLINE real smoothstep(const real& low, const real& high, const real& a) {
  const real t = clamp((a - low) / (high - low), 0.0f, 1.0f);
  return t * t * (real(3.0f) - real(2.0f) * t);
}
HWY_INLINE bool some(const truth& condition) { return bits(condition) != 0; }
HWY_INLINE real choose(const truth& condition, const real& yes, const real& no) {
  return HWY_NAMESPACE::choose(condition, static_cast<const Floats&>(yes), static_cast<const Floats&>(no));
}

struct vec2 {
  real x, y;
  HWY_INLINE vec2() = default;
  HWY_INLINE explicit vec2(const real& both) : x(both), y(both) {}
  HWY_INLINE vec2(const real& a, const real& b) : x(a), y(b) {}
};
struct vec3 {
  real x, y, z;
  HWY_INLINE vec3() = default;
  HWY_INLINE explicit vec3(const real& each) : x(each), y(each), z(each) {}
  HWY_INLINE vec3(const real& a, const real& b, const real& c) : x(a), y(b), z(c) {}
  HWY_INLINE vec3(const real& a, const vec2& b) : x(a), y(b.x), z(b.y) {}
  HWY_INLINE explicit vec3(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) {}
};
struct vec4 {
  real x, y, z, w;
  HWY_INLINE vec4() = default;
  HWY_INLINE explicit vec4(const real& each) : x(each), y(each), z(each), w(each) {}
  HWY_INLINE vec4(const real& a, const real& b, const real& c, const real& d) : x(a), y(b), z(c), w(d) {}
  HWY_INLINE vec4(const vec3& a, const real& b) : x(a.x), y(a.y), z(a.z), w(b) {}
  HWY_INLINE explicit vec4(const glm::vec4& v) : x(v.x), y(v.y), z(v.z), w(v.w) {}
};
HWY_INLINE vec3 xyz_of(const vec4& v) { return {v.x, v.y, v.z}; }

/// `each(component of a, component of b)`, by component.
template <typename Each>
HWY_INLINE vec2 by_component(const vec2& a, const vec2& b, const Each& each) {
  return {each(a.x, b.x), each(a.y, b.y)};
}
template <typename Each>
HWY_INLINE vec3 by_component(const vec3& a, const vec3& b, const Each& each) {
  return {each(a.x, b.x), each(a.y, b.y), each(a.z, b.z)};
}
template <typename Each>
HWY_INLINE vec4 by_component(const vec4& a, const vec4& b, const Each& each) {
  return {each(a.x, b.x), each(a.y, b.y), each(a.z, b.z), each(a.w, b.w)};
}

#define OMMA_BY_COMPONENT(name, vector, ...)                                                      \
  HWY_INLINE vector name(const vector& a, const vector& b) {                                      \
    return by_component(a, b, [](const real& p, const real& q) HWY_ATTR { return __VA_ARGS__; }); \
  }
#define OMMA_VECTOR(vector)                                                                                          \
  OMMA_BY_COMPONENT(operator+, vector, p + q)                                                                        \
  OMMA_BY_COMPONENT(operator-, vector, p - q)                                                                        \
  OMMA_BY_COMPONENT(operator*, vector, p* q)                                                                         \
  OMMA_BY_COMPONENT(operator/, vector, p / q)                                                                        \
  OMMA_BY_COMPONENT(min, vector, min(p, q))                                                                          \
  OMMA_BY_COMPONENT(max, vector, max(p, q))                                                                          \
  HWY_INLINE vector operator+(const vector& a, const real& b) { return a + vector(b); }                              \
  HWY_INLINE vector operator-(const vector& a, const real& b) { return a - vector(b); }                              \
  HWY_INLINE vector operator*(const vector& a, const real& b) { return a * vector(b); }                              \
  HWY_INLINE vector operator/(const vector& a, const real& b) { return a * vector(real(1.0f) / b); }                 \
  HWY_INLINE vector operator+(const real& a, const vector& b) { return vector(a) + b; }                              \
  HWY_INLINE vector operator-(const real& a, const vector& b) { return vector(a) - b; }                              \
  HWY_INLINE vector operator*(const real& a, const vector& b) { return vector(a) * b; }                              \
  HWY_INLINE vector operator/(const real& a, const vector& b) { return vector(a) / b; }                              \
  HWY_INLINE vector operator-(const vector& a) { return vector(real(0.0f)) - a; }                                    \
  OMMA_OPERATORS(vector, vector)                                                                                     \
  OMMA_OPERATORS(vector, real)                                                                                       \
  HWY_INLINE real length(const vector& a) { return sqrt(dot(a, a)); }                                                \
  HWY_INLINE vector normalize(const vector& a) { return a * inversesqrt(dot(a, a)); }                                \
  HWY_INLINE vector mix(const vector& a, const vector& b, const real& part) { return a + (b - a) * part; }           \
  HWY_INLINE vector clamp(const vector& a, const vector& low, const vector& high) { return min(max(a, low), high); } \
  HWY_INLINE vector choose(const truth& condition, const vector& yes, const vector& no) {                            \
    return by_component(yes, no, [&](const real& p, const real& q) HWY_ATTR { return choose(condition, p, q); });    \
  }
HWY_INLINE real dot(const vec2& a, const vec2& b) { return mul_add(a.x, b.x, a.y * b.y); }
HWY_INLINE real dot(const vec3& a, const vec3& b) { return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z)); }
HWY_INLINE real dot(const vec4& a, const vec4& b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, mul_add(a.z, b.z, a.w * b.w)));
}
OMMA_VECTOR(vec2)
OMMA_VECTOR(vec3)
OMMA_VECTOR(vec4)
#undef OMMA_VECTOR
#undef OMMA_BY_COMPONENT
#undef OMMA_OPERATORS

HWY_INLINE vec3 cross(const vec3& a, const vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE vec3 abs(const vec3& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
HWY_INLINE vec3 reflect(const vec3& a, const vec3& normal) { return a - normal * (real(2.0f) * dot(normal, a)); }

/// Sixteen places in an array.
struct Places {
  hn::Vec<IntTag> v[registers];
};
/// Of whole numbers from 0 to `last`; what is less, more or no number is one of those, too.
HWY_INLINE Places places_of(const real& number, int last) {
  const IntTag d;
  Places r;
  for (size_t k = 0; k < registers; ++k) {
    r.v[k] = hn::Min(hn::Max(hn::ConvertTo(d, number.v[k]), hn::Zero(d)), hn::Set(d, last));
  }
  return r;
}
/// a * stride + b.
HWY_INLINE Places in_rows(const Places& a, int stride, const Places& b) {
  const IntTag d;
  Places r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::Add(hn::Mul(a.v[k], hn::Set(d, stride)), b.v[k]);
  return r;
}
HWY_INLINE real gathered(const float* from, const Places& places) {
  real r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::GatherIndex(FloatTag(), from, places.v[k]);
  return r;
}

struct mat4 {
  vec4 column[4];
  HWY_INLINE mat4() = default;
  HWY_INLINE explicit mat4(const glm::mat4& m) : column{vec4(m[0]), vec4(m[1]), vec4(m[2]), vec4(m[3])} {}
};
struct mat3 {
  vec3 column[3];
  HWY_INLINE mat3(const vec3& a, const vec3& b, const vec3& c) : column{a, b, c} {}
  HWY_INLINE explicit mat3(const mat4& m) : column{xyz_of(m.column[0]), xyz_of(m.column[1]), xyz_of(m.column[2])} {}
  HWY_INLINE const vec3& operator[](int i) const { return column[i]; }
};
HWY_INLINE vec3 operator*(const mat3& m, const vec3& v) { return m[0] * v.x + m[1] * v.y + m[2] * v.z; }
HWY_INLINE vec4 operator*(const mat4& m, const vec4& v) {
  return m.column[0] * v.x + m.column[1] * v.y + m.column[2] * v.z + m.column[3] * v.w;
}
HWY_INLINE vec3 operator*(const vec3& v, const mat3& m) { return {dot(v, m[0]), dot(v, m[1]), dot(v, m[2])}; }
HWY_INLINE mat3 transpose(const mat3& m) {
  return {{m[0].x, m[1].x, m[2].x}, {m[0].y, m[1].y, m[2].y}, {m[0].z, m[1].z, m[2].z}};
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
