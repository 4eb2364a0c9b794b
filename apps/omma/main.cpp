// omma: renders 3D scenes through any camera with one centre.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>

#include "command_line.h"
#include "commands.h"
#include "omma/base/error.h"

namespace {

int fail(int code, const std::string& message) {
  fmt::print(stderr, "error: {}\n", message);
  return code;
}

int run(CLI::App& tool, int argc, char** argv) {
  constexpr int wrong_command = static_cast<int>(omma::ErrorKind::command);
  constexpr int wrong_machine = static_cast<int>(omma::ErrorKind::machine);
  if (argc < 2) {
    fmt::print(stderr, "{}", tool.help());
    return wrong_command;
  }
  try {
    std::vector<std::string> arguments = omma::tool::checked_arguments(tool, {argv + 1, argv + argc});
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    tool.parse(arguments);
    return 0;
  } catch (const CLI::Success& success) {  // --help, --version
    return tool.exit(success);
  } catch (const CLI::ParseError& error) {
    return fail(wrong_command, error.what());
  } catch (const omma::tool::ExitCode& exit) {
    return exit.code;
  } catch (const omma::Error& error) {
    return fail(error.exit_code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(wrong_machine, "not enough memory; a smaller --size or scene needs less");
  } catch (const std::exception& error) {
    return fail(wrong_machine, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App tool("Renders 3D scenes through any camera that has one centre: fisheyes, panoramas, calibrated lenses.",
                "omma");
  tool.set_version_flag("--version", "omma " OMMA_VERSION);
  tool.footer(
      "Examples:\n"
      "  omma render city --camera equidistant:fov_deg=180 -o city.png\n"
      "  omma render model.glb --camera equirectangular --from 0,2,5 --to 0,1,0 -o pano.jpg\n"
      "  omma compare city.png reference.png --max-mean 0.01\n"
      "'omma COMMAND --help' says more.\n"
      "Exit codes: 0 done, 1 a comparison failed, 2 the command is wrong, 3 the input is wrong,\n"
      "4 this machine cannot do it.");
  tool.require_subcommand(1);
  omma::tool::add_render(tool);
  omma::tool::add_probe(tool);
  omma::tool::add_compare(tool);
  omma::tool::add_camera(tool);
  omma::tool::add_cameras(tool);
  omma::tool::add_scenes(tool);
  omma::tool::add_techniques(tool);
  omma::tool::add_effects(tool);
  omma::tool::add_doctor(tool);
  omma::tool::add_bench(tool);
  return run(tool, argc, argv);
}
