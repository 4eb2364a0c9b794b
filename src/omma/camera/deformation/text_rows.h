// Text files of numbers: rows of words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace omma {

struct TextRow {
  std::string place;               ///< file and line, as messages begin
  std::vector<std::string> words;  ///< one at least

  /// A finite number. Throws InputError when the word is missing or none.
  double number(size_t word) const;
  long integer(size_t word) const;
};

/// The rows that hold anything. Spaces, tabs, commas and semicolons separate words; '#' begins a comment.
std::vector<TextRow> read_rows(const std::filesystem::path& path);

}  // namespace omma
