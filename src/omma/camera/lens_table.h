// What there is to know of each lens, as the documentation and the command line show it.
#pragma once

#include <string>

namespace omma {

/// Markdown: a table of all lenses, then the parameters of each that has its own, then those common to all.
/// docs/cameras.md holds it.
std::string lens_table_markdown();

/// The same for a terminal.
std::string lens_table_text();

}  // namespace omma
