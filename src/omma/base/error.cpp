#include "omma/base/error.h"

#include <cstdio>

namespace omma {

Error::Error(ErrorKind kind, fmt::string_view format, fmt::format_args values)
    : Error(kind, fmt::vformat(format, values)) {}

void warn(const std::string& message) { fmt::print(stderr, "warning: {}\n", message); }

}  // namespace omma
