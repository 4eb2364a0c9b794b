// omma effects: what can be painted on surfaces and drawn over them.
#include "omma/shading/effects.h"

#include <fmt/core.h>

#include <memory>

#include "commands.h"

namespace omma::tool {

void add_effects(const Command& tool) {
  const Command command = tool.add_command("effects", "List the effects on surfaces and their parameters");
  auto markdown = std::make_shared<bool>(false);
  command.add_flag("--markdown", *markdown, "Print the tables of docs/effects.md");
  command.footer(
      "Written NAME or NAME:KEY=VALUE,KEY=VALUE; every technique draws them. Colours are names (black, white, grey, "
      "red,\n"
      "green, blue, yellow) or six hexadecimal digits of sRGB.\n"
      "Examples:\n"
      "  omma effects\n"
      "  omma render city --camera cylinder:fov_deg=360 --effect hatching --background 1,1,1 -o ink.png\n"
      "  omma render city --camera equidistant --effect brick --effect wireframe:width_px=2,color=ff8000 -o wires.png");
  command.callback([markdown] { fmt::print("{}", effect_table(*markdown)); });
}

}  // namespace omma::tool
