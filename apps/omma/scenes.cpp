// omma scenes: the built-in scenes and their parameters.
#include <fmt/core.h>

#include "commands.h"
#include "omma/scene/scene.h"

namespace omma::tool {

void add_scenes(const Command& tool) {
  const Command command = tool.add_command("scenes", "List the built-in scenes and their parameters");
  command.footer(
      "A scene is written NAME:KEY=VALUE,KEY=VALUE or is the name of a file that assimp reads (glTF, OBJ, PLY, STL,\n"
      "Collada, FBX and more).\n"
      "Examples:\n"
      "  omma scenes\n"
      "  omma render city:blocks=20,seed=3 --camera equirectangular -o city.png");
  command.callback([] {
    for (const BuiltinScene& scene : builtin_scenes()) {
      fmt::print("{}\n    {}\n", scene.name, scene.description);
      for (const BuiltinParameter& parameter : scene.parameters) {
        fmt::print("    {:<12}{} (default {:g}, {:g} to {:g})\n", parameter.name, parameter.description,
                   parameter.default_value, parameter.min, parameter.max);
      }
    }
  });
}

}  // namespace omma::tool
