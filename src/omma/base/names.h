// Names that people type: finding the one they meant, reading `name:key=value,key=value`.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace omma {

/// The choice closest to `name` by edit distance, or nothing when none is close.
std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> choices);

/// "unknown camera 'equidistnt'; did you mean 'equidistant'? (one of: a, b, c)"
std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string> choices);

/// A name with named values, the text form of cameras and built-in scenes: `equidistant:fov_deg=180,fit=full`.
struct Spec {
  std::string name;
  std::map<std::string, std::string> values;
};

/// A comma within parentheses belongs to its value. Throws CommandError for an empty name, a value without `=`, a key
/// given twice.
Spec parse_spec(std::string_view text);

/// The text that parse_spec takes apart to this.
std::string spec_text(const Spec& spec);

/// The whole of `text` as a finite number; throws CommandError naming `what` otherwise.
double parse_number(std::string_view what, std::string_view text);

/// The whole of `text` as a whole number; throws CommandError naming `what` otherwise.
long parse_integer(std::string_view what, std::string_view text);

/// `text` cut at every `separator`; an empty text has no parts.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace omma
