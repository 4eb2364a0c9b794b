// The parameters of an effect as the struct of its GLSL file. Included once for every SIMD target, by Highway's rules.
#if defined(OMMA_SOFTWARE_EFFECT_PARAMETERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMMA_SOFTWARE_EFFECT_PARAMETERS_INL_H_
#undef OMMA_SOFTWARE_EFFECT_PARAMETERS_INL_H_
#else
#define OMMA_SOFTWARE_EFFECT_PARAMETERS_INL_H_
#endif

#include <cstddef>
#include <utility>
#include <variant>

#include "omma/shading/effects.h"
#include "omma/software/glsl-inl.h"

HWY_BEFORE_NAMESPACE();
namespace omma {
namespace HWY_NAMESPACE {

/// One parameter, as whatever the struct's member is.
struct EffectValue {
  const std::variant<float, int, glm::vec3>* value = nullptr;
  operator float() const { return std::get<float>(*value); }
  operator int() const { return std::get<int>(*value); }
  operator vec3() const { return vec3(std::get<glm::vec3>(*value)); }
};

/// How many members a struct has that can be listed in braces.
template <typename Struct, typename... Values>
constexpr size_t member_count() {
  if constexpr (requires { Struct{Values()..., EffectValue()}; }) {
    return member_count<Struct, Values..., EffectValue>();
  } else {
    return sizeof...(Values);
  }
}

/// The struct's members are the effect's parameters, in their order.
template <typename Parameters>
Parameters parameters_of(const Effect& effect) {
  return [&]<size_t... I>(std::index_sequence<I...>) { return Parameters{EffectValue{&effect.values.at(I)}...}; }
  (std::make_index_sequence<member_count<Parameters>()>());
}

}  // namespace HWY_NAMESPACE
}  // namespace omma
HWY_AFTER_NAMESPACE();

#endif
