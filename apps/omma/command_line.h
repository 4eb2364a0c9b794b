// What CLI11 leaves to be desired: negative numbers as words of their own, and the name that was meant.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace omma::tool {

/// The words of the command line, with a negative number after an option joined to it (`--from -3,1,2` becomes
/// `--from=-3,1,2`). Throws CommandError with the nearest name for an unknown subcommand or option.
std::vector<std::string> checked_arguments(const CLI::App& tool, const std::vector<std::string>& words);

}  // namespace omma::tool
