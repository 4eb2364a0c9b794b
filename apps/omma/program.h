// What the programs share: from the words of a command line to an exit code.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace omma::tool {

/// An option's value as it was typed; empty when it was not given.
using Text = std::optional<std::string>;

/// What CLI::App has as templates and inline functions, compiled once instead of in every file.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description);
CLI::Option* add_option(CLI::App& command, const std::string& names, std::string& value,
                        const std::string& description);
CLI::Option* add_option(CLI::App& command, const std::string& names, Text& value, const std::string& description);
CLI::Option* add_option(CLI::App& command, const std::string& names, std::vector<std::string>& value,
                        const std::string& description);
CLI::Option* add_flag(CLI::App& command, const std::string& names, bool& value, const std::string& description);

/// Ends the program with this code, everything worth saying having been said.
struct ExitCode {
  int code;
};

/// Parses the words and calls what they ask for; what goes wrong is said on standard error. Returns the exit code.
int run_program(CLI::App& program, int argc, char** argv);

}  // namespace omma::tool
