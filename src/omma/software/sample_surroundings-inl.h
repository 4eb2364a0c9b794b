// Sixteen samples of what surrounds an object, trilinear. Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_SOFTWARE_SAMPLE_SURROUNDINGS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_SOFTWARE_SAMPLE_SURROUNDINGS_INL_H_
#undef OMMA_SOFTWARE_SAMPLE_SURROUNDINGS_INL_H_
#else
#define OMMA_SOFTWARE_SAMPLE_SURROUNDINGS_INL_H_
#endif

#include "omma/software/sample_texture-inl.h"
#include "omma/software/surroundings.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

struct Radiance {
  FloatV channel[3];
};

HWY_INLINE Radiance mix(const Radiance& a, const Radiance& b, FloatV part) {
  Radiance result;
  for (int c = 0; c < 3; ++c) {
    result.channel[c] = hn::MulAdd(part, hn::Sub(b.channel[c], a.channel[c]), a.channel[c]);
  }
  return result;
}

HWY_INLINE Radiance sample_level(const Surroundings& of, int side, FloatV u, FloatV v, IntV level) {
  const FloatTag d;
  const IntTag di;
  const IntV width = hn::Shr(hn::Set(di, of.size), level);
  const Neighbours x = neighbours(u, width, false), y = neighbours(v, width, false);
  const IntV first = hn::GatherIndex(di, of.first.data(), level);
  const float* texels = of.texels[size_t(side)].data();
  const auto texel = [&](IntV column, IntV row) HWY_ATTR {
    const IntV at = hn::Mul(hn::Add(first, hn::Add(hn::Mul(row, width), column)), hn::Set(di, 3));
    return Radiance{
        {hn::GatherIndex(d, texels, at), hn::GatherIndex(d, texels + 1, at), hn::GatherIndex(d, texels + 2, at)}};
  };
  return mix(mix(texel(x.first, y.first), texel(x.second, y.first), x.part),
             mix(texel(x.first, y.second), texel(x.second, y.second), x.part), y.part);
}

/// Linear radiance in one of the two maps; `at` goes from 0 to 1 to the right and down, level 0 is the finest.
HWY_INLINE vec3 sample_surroundings(const Surroundings& of, int side, const vec2& at, const real& level) {
  const FloatTag d;
  const IntTag di;
  const FloatV last = hn::Set(d, float(of.levels - 1));
  vec3 result;
  for (size_t k = 0; k < registers; ++k) {
    const FloatV u = wrapped(Texture::Wrap::clamp, at.x.v[k]), v = wrapped(Texture::Wrap::clamp, at.y.v[k]);
    const FloatV exact = hn::Min(hn::Max(level.v[k], hn::Zero(d)), last), low = hn::Floor(exact);
    const IntV finer = hn::ConvertTo(di, low);
    const IntV coarser = hn::Min(hn::Add(finer, hn::Set(di, 1)), hn::Set(di, of.levels - 1));
    const Radiance seen =
        mix(sample_level(of, side, u, v, finer), sample_level(of, side, u, v, coarser), hn::Sub(exact, low));
    result.x.v[k] = seen.channel[0];
    result.y.v[k] = seen.channel[1];
    result.z.v[k] = seen.channel[2];
  }
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
