// Sixteen floats at a time, whatever a register holds. Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_VISIBILITY_SIMD16_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_VISIBILITY_SIMD16_INL_H_
#undef OMMA_VISIBILITY_SIMD16_INL_H_
#else
#define OMMA_VISIBILITY_SIMD16_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using BitsTag = hn::RebindToUnsigned<FloatTag>;
constexpr size_t lanes = hn::MaxLanes(FloatTag());
constexpr size_t registers = 16 / lanes;

/// A member for every register, and what is done, is done to each.
struct Floats {
  hn::Vec<FloatTag> v[registers];
};
struct Mask {
  hn::Mask<FloatTag> m[registers];
};

HWY_INLINE Floats load(const float* from) {
  Floats r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::Load(FloatTag(), from + k * lanes);
  return r;
}
HWY_INLINE void store(const Floats& a, float* to) {
  for (size_t k = 0; k < registers; ++k) hn::Store(a.v[k], FloatTag(), to + k * lanes);
}
HWY_INLINE Floats all(float value) {
  Floats r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::Set(FloatTag(), value);
  return r;
}

#define OMMA_BINARY(name, function)                                               \
  HWY_INLINE Floats name(const Floats& a, const Floats& b) {                      \
    Floats r;                                                                     \
    for (size_t k = 0; k < registers; ++k) r.v[k] = hn::function(a.v[k], b.v[k]); \
    return r;                                                                     \
  }
OMMA_BINARY(operator+, Add)
OMMA_BINARY(operator-, Sub)
OMMA_BINARY(operator*, Mul)
OMMA_BINARY(operator/, Div)
OMMA_BINARY(min, Min)
OMMA_BINARY(max, Max)
#undef OMMA_BINARY

#define OMMA_UNARY(name, function)                                        \
  HWY_INLINE Floats name(const Floats& a) {                               \
    Floats r;                                                             \
    for (size_t k = 0; k < registers; ++k) r.v[k] = hn::function(a.v[k]); \
    return r;                                                             \
  }
OMMA_UNARY(abs, Abs)
OMMA_UNARY(ceil, Ceil)
OMMA_UNARY(floor, Floor)
OMMA_UNARY(sqrt, Sqrt)
OMMA_UNARY(rough_inverse_sqrt, ApproximateReciprocalSqrt)
#undef OMMA_UNARY

#define OMMA_COMPARE(name, function)                                              \
  HWY_INLINE Mask name(const Floats& a, const Floats& b) {                        \
    Mask r;                                                                       \
    for (size_t k = 0; k < registers; ++k) r.m[k] = hn::function(a.v[k], b.v[k]); \
    return r;                                                                     \
  }
OMMA_COMPARE(operator<, Lt)
OMMA_COMPARE(operator<=, Le)
OMMA_COMPARE(operator>, Gt)
OMMA_COMPARE(operator>=, Ge)
OMMA_COMPARE(operator==, Eq)
#undef OMMA_COMPARE

HWY_INLINE Mask operator&(const Mask& a, const Mask& b) {
  Mask r;
  for (size_t k = 0; k < registers; ++k) r.m[k] = hn::And(a.m[k], b.m[k]);
  return r;
}
HWY_INLINE Mask operator|(const Mask& a, const Mask& b) {
  Mask r;
  for (size_t k = 0; k < registers; ++k) r.m[k] = hn::Or(a.m[k], b.m[k]);
  return r;
}
/// a * b + c, rounded once where the processor can.
HWY_INLINE Floats mul_add(const Floats& a, const Floats& b, const Floats& c) {
  Floats r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::MulAdd(a.v[k], b.v[k], c.v[k]);
  return r;
}
/// c - a * b
HWY_INLINE Floats neg_mul_add(const Floats& a, const Floats& b, const Floats& c) {
  Floats r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::NegMulAdd(a.v[k], b.v[k], c.v[k]);
  return r;
}
HWY_INLINE Floats choose(const Mask& mask, const Floats& yes, const Floats& no) {
  Floats r;
  for (size_t k = 0; k < registers; ++k) r.v[k] = hn::IfThenElse(mask.m[k], yes.v[k], no.v[k]);
  return r;
}
/// `a` with the sign of `sign` multiplied in.
HWY_INLINE Floats times_sign(const Floats& a, const Floats& sign) {
  Floats r;
  for (size_t k = 0; k < registers; ++k) {
    r.v[k] = hn::Xor(a.v[k], hn::And(sign.v[k], hn::SignBit(FloatTag())));
  }
  return r;
}
/// Bit i is lane i.
HWY_INLINE uint32_t bits(const Mask& mask) {
  uint32_t all_bits = 0;
  for (size_t k = 0; k < registers; ++k) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(FloatTag(), mask.m[k], bytes);
    all_bits |= (uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8) << (k * lanes);
  }
  return all_bits;
}
HWY_INLINE Mask from_bits(uint32_t value) {
  Mask r;
  for (size_t k = 0; k < registers; ++k) {
    const uint32_t part = value >> (k * lanes);
    uint8_t bytes[8] = {uint8_t(part), uint8_t(part >> 8)};
    r.m[k] = hn::LoadMaskBits(FloatTag(), bytes);
  }
  return r;
}
HWY_INLINE void store_where(const Mask& mask, const Floats& a, float* to) {
  for (size_t k = 0; k < registers; ++k) hn::BlendedStore(a.v[k], mask.m[k], FloatTag(), to + k * lanes);
}
HWY_INLINE void store_where(const Mask& mask, uint32_t value, uint32_t* to) {
  for (size_t k = 0; k < registers; ++k) {
    hn::BlendedStore(hn::Set(BitsTag(), value), hn::RebindMask(BitsTag(), mask.m[k]), BitsTag(), to + k * lanes);
  }
}
/// Lanes whose number is larger than `value`.
HWY_INLINE Mask larger(const uint32_t* from, uint32_t value) {
  Mask r;
  for (size_t k = 0; k < registers; ++k) {
    const auto numbers = hn::Load(BitsTag(), from + k * lanes);
    r.m[k] = hn::RebindMask(FloatTag(), hn::Gt(numbers, hn::Set(BitsTag(), value)));
  }
  return r;
}
HWY_INLINE float least(const Floats& a) {
  auto low = a.v[0];
  for (size_t k = 1; k < registers; ++k) low = hn::Min(low, a.v[k]);
  return hn::GetLane(hn::MinOfLanes(FloatTag(), low));
}

/// Sixteen vectors.
struct Vectors {
  Floats x, y, z;
};
HWY_INLINE Vectors all(float x, float y, float z) { return {all(x), all(y), all(z)}; }
HWY_INLINE Vectors operator+(const Vectors& a, const Vectors& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE Vectors operator*(const Vectors& a, const Floats& b) { return {a.x * b, a.y * b, a.z * b}; }
HWY_INLINE Vectors choose(const Mask& mask, const Vectors& yes, const Vectors& no) {
  return {choose(mask, yes.x, no.x), choose(mask, yes.y, no.y), choose(mask, yes.z, no.z)};
}
HWY_INLINE Vectors abs(const Vectors& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
HWY_INLINE Floats dot(const Vectors& a, const Vectors& b) { return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z)); }
/// Without contraction: a vector times itself is zero, and turning one round turns the result round, to the bit.
HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
