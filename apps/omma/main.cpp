// omma: renders 3D scenes through any camera with one centre.
#include "commands.h"

int main(int argc, char** argv) {
  omma::tool::Program tool(
      "omma", "Renders 3D scenes through any camera that has one centre: fisheyes, panoramas, calibrated lenses.");
  tool.set_version("omma " OMMA_VERSION);
  tool.footer(
      "Examples:\n"
      "  omma render city --camera equidistant:fov_deg=180 -o city.png\n"
      "  omma render model.glb --camera equirectangular --from 0,2,5 --to 0,1,0 -o pano.jpg\n"
      "  omma compare city.png reference.png --max-mean 0.01\n"
      "'omma COMMAND --help' says more.\n"
      "Exit codes: 0 done, 1 a comparison failed, 2 the command is wrong, 3 the input is wrong,\n"
      "4 this machine cannot do it.");
  tool.require_command();
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
  return tool.run(argc, argv);
}
