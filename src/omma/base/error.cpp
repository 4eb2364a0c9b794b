#include "omma/base/error.h"

#include <cstdio>

namespace omma {

void warn(const std::string& message) { fmt::print(stderr, "warning: {}\n", message); }

}  // namespace omma
