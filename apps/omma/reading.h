// How files are read: --root and --limit.
#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "omma/base/limits.h"

namespace omma::tool {

/// As typed.
struct ReadingOptions {
  Text root;
  std::vector<std::string> limits;
};

/// Declares --limit, and --root for commands that read files which name others.
void add_limits(const Command& command, ReadingOptions& options);
void add_root(const Command& command, ReadingOptions& options);

/// Throws CommandError for a root that is no folder, and for a limit that is none.
ReadOptions read_options_of(const ReadingOptions& options);

}  // namespace omma::tool
