// What all deformed cameras share: their text taken apart, the image's size, and filling a ray map.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "omma/base/limits.h"
#include "omma/base/names.h"
#include "omma/camera/camera.h"

namespace omma {

/// A text's values, with messages that say whose they are.
class DeformationText {
 public:
  DeformationText(Spec spec, const Limits& limits) : spec_(std::move(spec)), limits_(limits) {}

  /// Throws CommandError when there is a key that is none of these.
  void accept_only(std::span<const char* const> keys) const;

  bool has(const std::string& key) const { return spec_.values.contains(key); }
  /// Throws CommandError when it is missing, with an example of what is expected.
  const std::string& value(const std::string& key) const;
  std::string label(std::string_view key) const { return spec_.name + ": " + std::string(key); }
  /// Throws CommandError outside of low to high.
  std::optional<double> number_within(const std::string& key, double low, double high) const;
  /// `width` and `height`, the image that pixel values are for; or those keys after a prefix.
  std::optional<ImageSize> own_size(const std::string& prefix = "") const;

  const Spec& spec() const { return spec_; }
  const Limits& limits() const { return limits_; }

 private:
  Spec spec_;
  Limits limits_;
};

/// The text from which make_camera makes the same camera for an image of `size`, `scale` times as large as the one that
/// the values are for.
std::string source_text(const Spec& spec, const ImageSize& size, const glm::dvec2& scale);

/// Throws CommandError when there are more pixels than a ray is kept for.
void check_deformed_size(const ImageSize& size, const std::string& source, const Limits& limits);

/// A ray map of the directions at the pixels' centres (camera frame, any length; nothing: no ray). Runs `direction` on
/// all cores. Throws CommandError when no pixel has a ray, and for more pixels than the limit.
Camera deformed_camera(const ImageSize& size, const std::string& source, const Limits& limits,
                       const std::function<std::optional<glm::dvec3>(const glm::dvec2& pixel)>& direction);

}  // namespace omma
