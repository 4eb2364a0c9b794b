#include "program.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <new>

#include "command_line.h"
#include "omma/base/error.h"

namespace omma::tool {
namespace {

int fail(int code, const std::string& message) {
  fmt::print(stderr, "error: {}\n", message);
  return code;
}

}  // namespace

CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& description) {
  return program.add_subcommand(name, description);
}
CLI::Option* add_option(CLI::App& command, const std::string& names, std::string& value,
                        const std::string& description) {
  return command.add_option(names, value, description);
}
CLI::Option* add_option(CLI::App& command, const std::string& names, Text& value, const std::string& description) {
  return command.add_option(names, value, description);
}
CLI::Option* add_option(CLI::App& command, const std::string& names, std::vector<std::string>& value,
                        const std::string& description) {
  return command.add_option(names, value, description);
}
CLI::Option* add_flag(CLI::App& command, const std::string& names, bool& value, const std::string& description) {
  return command.add_flag(names, value, description);
}

int run_program(CLI::App& program, int argc, char** argv) {
  constexpr int wrong_command = static_cast<int>(ErrorKind::command);
  constexpr int wrong_machine = static_cast<int>(ErrorKind::machine);
  try {
    std::vector<std::string> arguments = checked_arguments(program, {argv + 1, argv + argc});
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    program.parse(arguments);
    return 0;
  } catch (const CLI::Success& success) {  // --help, --version
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return fail(wrong_command, error.what());
  } catch (const ExitCode& exit) {
    return exit.code;
  } catch (const Error& error) {
    return fail(error.exit_code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(wrong_machine, "not enough memory; a smaller --size or scene needs less");
  } catch (const std::exception& error) {
    return fail(wrong_machine, error.what());
  }
}

}  // namespace omma::tool
