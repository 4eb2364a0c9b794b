// Text files line by line: a file of millions of rows takes no more memory than its text.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "omma/base/limits.h"

namespace omma {

struct TextRow {
  std::string place;               ///< file and line, as messages begin
  std::vector<std::string> words;  ///< one at least

  /// A finite number. Throws InputError when the word is missing or none.
  double number(size_t word) const;
  long integer(size_t word) const;
};

/// The lines of a file and their numbers, from 1, without comments, which '#' begins. Throws InputError as read_file
/// does.
void for_each_line(const std::filesystem::path& path, const Limits& limits,
                   const std::function<void(std::string_view line, size_t number)>& visit);

/// The rows that hold anything. Spaces, tabs, commas and semicolons separate words. Throws InputError as read_file
/// does, and for a row of more words than any that means something.
void for_each_row(const std::filesystem::path& path, const Limits& limits,
                  const std::function<void(const TextRow& row)>& visit);

}  // namespace omma
