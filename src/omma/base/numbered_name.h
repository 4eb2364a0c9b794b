// File names that stand for a sequence: `frame_%04d.png`.
#pragma once

#include <string>

namespace omma {

/// Whether the name has a place for a number: `%d`, `%4d` or `%04d`. Throws CommandError for any other use of '%', and
/// for two places.
bool has_number_pattern(const std::string& name);

/// The name with the number in that place, or as it is when there is none.
std::string numbered_name(const std::string& name, int number);

}  // namespace omma
