// omma cameras: every lens with its formula and parameters.
#include <fmt/core.h>

#include <memory>

#include "commands.h"
#include "omma/camera/deformation/deformation.h"
#include "omma/camera/lens_model.h"
#include "omma/camera/lens_table.h"

namespace omma::tool {
namespace {

/// Their parameters take a page of their own.
std::string deformation_text() {
  std::string text = "\nNo lens, but drawn as ray maps (docs/deformations.md):\n";
  for (const DeformationInfo& info : deformations()) {
    text += fmt::format("  {:<15} {}\n  {:<15} omma camera '{}'\n", info.name, info.description, "", info.example);
  }
  return text;
}

}  // namespace

void add_cameras(const Command& tool) {
  const Command command = tool.add_command("cameras", "List the lenses and their parameters");
  auto markdown = std::make_shared<bool>(false);
  auto examples = std::make_shared<bool>(false);
  command.add_flag("--markdown", *markdown, "Print the tables of docs/cameras.md");
  command.add_flag("--examples", *examples, "Print NAME CAMERA for each lens: its example").excludes("--markdown");
  command.footer(
      "A camera is written NAME:KEY=VALUE,KEY=VALUE or is the name of a ray map, a .npy file with H x W x 3 "
      "directions.\n"
      "Examples:\n"
      "  omma cameras\n"
      "  omma camera equidistant:fov_deg=180,fit=diagonal    what one camera comes to");
  command.callback([markdown, examples] {
    if (*examples) {
      for (const LensModel& model : lens_models()) fmt::print("{} {}\n", model.info.name, model.info.example);
      return;
    }
    fmt::print("{}", *markdown ? omma::lens_table_markdown() : omma::lens_table_text() + deformation_text());
  });
}

}  // namespace omma::tool
