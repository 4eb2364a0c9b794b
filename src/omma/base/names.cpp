#include "omma/base/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "omma/base/error.h"

namespace omma {
namespace {

/// Insertions, deletions, substitutions and swaps of neighbours (optimal string alignment).
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1), above, two_above;
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    two_above = std::exchange(above, row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({substitution, above[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
  }
  return row[b.size()];
}

template <typename T>
std::optional<T> parse_whole(std::string_view text) {
  T value{};
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Cut at the commas outside parentheses: those within belong to a formula.
std::vector<std::string> split_values(std::string_view text) {
  std::vector<std::string> parts;
  int depth = 0;
  size_t begin = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') depth = std::max(0, depth - 1);
    if (text[i] != ',' || depth > 0) continue;
    parts.emplace_back(text.substr(begin, i - begin));
    begin = i + 1;
  }
  if (!text.empty()) parts.emplace_back(text.substr(begin));
  return parts;
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> choices) {
  std::optional<std::string> best;
  size_t best_distance = 1 + std::max<size_t>(1, name.size() / 3);
  for (const std::string& choice : choices) {
    const size_t distance = edit_distance(name, choice);
    if (distance < best_distance) {
      best_distance = distance;
      best = choice;
    }
  }
  return best;
}

std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string> choices) {
  std::string message = fmt::format("unknown {} '{}'", what, name);
  if (const auto nearest = nearest_name(name, choices)) {
    message += fmt::format("; did you mean '{}'?", *nearest);
  }
  if (!choices.empty()) message += fmt::format(" (one of: {})", fmt::join(choices, ", "));
  return message;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const size_t end = text.find(separator);
    parts.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
    if (text.empty()) parts.emplace_back();
  }
  return parts;
}

Spec parse_spec(std::string_view text) {
  Spec spec;
  const size_t colon = text.find(':');
  spec.name = text.substr(0, colon);
  if (spec.name.empty()) throw CommandError("'{}': a name is expected before ':'", text);
  if (colon == std::string_view::npos) return spec;
  for (const std::string& part : split_values(text.substr(colon + 1))) {
    const size_t equals = part.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw CommandError("'{}': '{}' is not key=value", text, part);
    }
    const std::string key = part.substr(0, equals);
    if (!spec.values.emplace(key, part.substr(equals + 1)).second) {
      throw CommandError("'{}': '{}' is given twice", text, key);
    }
  }
  return spec;
}

std::string spec_text(const Spec& spec) {
  std::string text = spec.name;
  for (const auto& [key, value] : spec.values) {
    text += fmt::format("{}{}={}", text.size() == spec.name.size() ? ':' : ',', key, value);
  }
  return text;
}

double parse_number(std::string_view what, std::string_view text) {
  const auto value = parse_whole<double>(text);
  if (!value || !std::isfinite(*value)) {
    throw CommandError("{}: '{}' is not a finite number", what, text);
  }
  return *value;
}

long parse_integer(std::string_view what, std::string_view text) {
  const auto value = parse_whole<long>(text);
  if (!value) throw CommandError("{}: '{}' is not a whole number", what, text);
  return *value;
}

}  // namespace omma
