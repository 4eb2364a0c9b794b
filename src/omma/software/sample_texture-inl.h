// Sixteen samples of a texture, trilinear. Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_SOFTWARE_SAMPLE_TEXTURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_SOFTWARE_SAMPLE_TEXTURE_INL_H_
#undef OMMA_SOFTWARE_SAMPLE_TEXTURE_INL_H_
#else
#define OMMA_SOFTWARE_SAMPLE_TEXTURE_INL_H_
#endif

#include "omma/software/glsl-inl.h"
#include "omma/software/mip_texture.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// One register's worth.
using FloatV = hn::Vec<FloatTag>;
using IntV = hn::Vec<IntTag>;
struct Texels {
  FloatV channel[4];
};

/// Into 0 to 1.
HWY_INLINE FloatV wrapped(Texture::Wrap wrap, FloatV at) {
  const FloatTag d;
  const FloatV one = hn::Set(d, 1.0f);
  switch (wrap) {
    case Texture::Wrap::clamp:
      break;
    case Texture::Wrap::mirror: {
      const FloatV half = hn::Mul(at, hn::Set(d, 0.5f));
      const FloatV part = hn::Sub(half, hn::Floor(half));
      return hn::Sub(one, hn::Abs(hn::MulSub(hn::Set(d, 2.0f), part, one)));
    }
    case Texture::Wrap::repeat:
      return hn::Sub(at, hn::Floor(at));
  }
  return hn::Min(hn::Max(at, hn::Zero(d)), one);
}

/// The two texels around a place, and how much of the second there is.
struct Neighbours {
  IntV first, second;
  FloatV part;
};

HWY_INLINE Neighbours neighbours(FloatV at, IntV size, bool repeats) {
  const FloatTag d;
  const IntTag di;
  const IntV zero = hn::Zero(di), last = hn::Sub(size, hn::Set(di, 1));
  const FloatV texel = hn::MulSub(at, hn::ConvertTo(d, size), hn::Set(d, 0.5f));
  const FloatV low = hn::Floor(texel);
  IntV first = hn::ConvertTo(di, low), second = hn::Add(first, hn::Set(di, 1));
  if (repeats) {
    first = hn::IfThenElse(hn::Lt(first, zero), last, first);
    second = hn::IfThenElse(hn::Gt(second, last), zero, second);
  }
  // What is no number is some texel.
  return {hn::Min(hn::Max(first, zero), last), hn::Min(hn::Max(second, zero), last), hn::Sub(texel, low)};
}

HWY_INLINE Texels unpacked(IntV bits) {
  const FloatTag d;
  const IntV byte = hn::Set(IntTag(), 255);
  return {{hn::ConvertTo(d, hn::And(bits, byte)), hn::ConvertTo(d, hn::And(hn::ShiftRight<8>(bits), byte)),
           hn::ConvertTo(d, hn::And(hn::ShiftRight<16>(bits), byte)),
           hn::ConvertTo(d, hn::And(hn::ShiftRight<24>(bits), byte))}};
}

/// sRGB's transfer function from bytes to 255 times linear light: a polynomial, at most 0.06 of a byte off.
HWY_INLINE FloatV linear_from_byte(FloatV byte) {
  const FloatTag d;
  FloatV bright = hn::Set(d, -6.62566463e-9f);
  bright = hn::MulAdd(bright, byte, hn::Set(d, 7.93173095e-6f));
  bright = hn::MulAdd(bright, byte, hn::Set(d, 0.0022172618f));
  bright = hn::MulAdd(bright, byte, hn::Set(d, 0.0276206464f));
  bright = hn::MulAdd(bright, byte, hn::Set(d, 0.275252147f));
  return hn::IfThenElse(hn::Lt(byte, hn::Set(d, 10.5f)), hn::Mul(byte, hn::Set(d, 1.0f / 12.92f)), bright);
}

HWY_INLINE Texels sample_level(const MipTexture& texture, FloatV u, FloatV v, IntV level) {
  const FloatTag d;
  const IntTag di;
  const IntV one = hn::Set(di, 1);
  const IntV width = hn::Max(hn::Shr(hn::Set(di, texture.width), level), one);
  const IntV height = hn::Max(hn::Shr(hn::Set(di, texture.height), level), one);
  const Neighbours x = neighbours(u, width, texture.wrap_u == Texture::Wrap::repeat);
  const Neighbours y = neighbours(v, height, texture.wrap_v == Texture::Wrap::repeat);
  const IntV first = hn::GatherIndex(di, texture.first.data(), level);
  const auto* texels = reinterpret_cast<const int32_t*>(texture.texels.data());
  const IntV upper = hn::Add(first, hn::Mul(y.first, width)), lower = hn::Add(first, hn::Mul(y.second, width));
  Texels corner[4] = {unpacked(hn::GatherIndex(di, texels, hn::Add(upper, x.first))),
                      unpacked(hn::GatherIndex(di, texels, hn::Add(upper, x.second))),
                      unpacked(hn::GatherIndex(di, texels, hn::Add(lower, x.first))),
                      unpacked(hn::GatherIndex(di, texels, hn::Add(lower, x.second)))};
  Texels result;
  for (int c = 0; c < 4; ++c) {
    if (texture.srgb && c < 3) {
      for (Texels& texel : corner) texel.channel[c] = linear_from_byte(texel.channel[c]);
    }
    const FloatV up = hn::MulAdd(x.part, hn::Sub(corner[1].channel[c], corner[0].channel[c]), corner[0].channel[c]);
    const FloatV down = hn::MulAdd(x.part, hn::Sub(corner[3].channel[c], corner[2].channel[c]), corner[2].channel[c]);
    result.channel[c] = hn::Mul(hn::MulAdd(y.part, hn::Sub(down, up), up), hn::Set(d, 1.0f / 255.0f));
  }
  return result;
}

/// Linear colour and alpha, 0 to 1. Level 0 is the finest.
HWY_INLINE vec4 sample_texture(const MipTexture& texture, const vec2& uv, const real& lod) {
  const FloatTag d;
  const IntTag di;
  const FloatV last = hn::Set(d, float(texture.levels - 1));
  vec4 result;
  for (size_t k = 0; k < registers; ++k) {
    const FloatV u = wrapped(texture.wrap_u, uv.x.v[k]), v = wrapped(texture.wrap_v, uv.y.v[k]);
    const FloatV at = hn::Min(hn::Max(lod.v[k], hn::Zero(d)), last), low = hn::Floor(at), part = hn::Sub(at, low);
    const IntV level = hn::ConvertTo(di, low);
    Texels texels = sample_level(texture, u, v, level);
    if (!hn::AllFalse(d, hn::Gt(part, hn::Zero(d)))) {
      const IntV coarser = hn::Min(hn::Add(level, hn::Set(di, 1)), hn::Set(di, texture.levels - 1));
      const Texels more = sample_level(texture, u, v, coarser);
      for (int c = 0; c < 4; ++c) {
        texels.channel[c] = hn::MulAdd(part, hn::Sub(more.channel[c], texels.channel[c]), texels.channel[c]);
      }
    }
    result.x.v[k] = texels.channel[0];
    result.y.v[k] = texels.channel[1];
    result.z.v[k] = texels.channel[2];
    result.w.v[k] = texels.channel[3];
  }
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
