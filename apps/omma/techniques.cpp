// omma techniques: the ways of drawing and their variants.
#include <fmt/core.h>

#include "commands.h"
#include "omma/render/prepared_scene.h"

namespace omma::tool {

void add_techniques(const Command& tool) {
  const Command command = tool.add_command("techniques", "List the ways of drawing and their variants");
  command.footer(
      "Written NAME or NAME:VARIANT; the first variant is the default. An exact technique draws what 'raycast' draws,\n"
      "but for rounding at edges.\n"
      "Examples:\n"
      "  omma techniques\n"
      "  omma render city --camera equidistant:fov_deg=180 --technique visibility -o city.png");
  command.callback([] {
    for (const TechniqueInfo& technique : techniques()) {
      fmt::print("{} ({}{})\n    {}\n", technique.name, technique.exact ? "exact" : "approximate",
                 technique.needs_project ? ", not for ray maps" : "", technique.description);
      for (const VariantInfo& variant : technique.variants) {
        fmt::print("    :{:<12}{}\n", variant.name, variant.description);
      }
    }
  });
}

}  // namespace omma::tool
