#include "omma/scene/builtin/builtin.h"

namespace omma {

const std::vector<BuiltinScene>& builtin_scenes() {
  static const std::vector<BuiltinScene> scenes = {
      {"city",
       "a town of houses, flats, towers and parks in 14 materials, from the street; about 1,000 "
       "triangles a block: 37,000 with blocks=6, 0.26 million with 16, 0.9 with 30, 3.3 with 57",
       {{"blocks", 6, 1, 64, "blocks along each side of the town"}, {"seed", 1, 0, 1e6, "another town"}},
       builtin::make_city},
      {"temple", "a Doric temple of fluted columns: about 4,000 long, thin triangles", {}, builtin::make_temple},
      {"facade",
       "a narrow street between house fronts: 600, 2,800 or 4,900 triangles",
       {{"detail", 1, 0, 2, "0 flat fronts, 1 windows set back, 2 frames and sills too"}},
       builtin::make_facade},
      {"room",
       "a closed room of few, huge triangles around the camera, with two lamps and a few dense "
       "objects",
       {},
       builtin::make_room},
      {"terrain",
       "mountains: a fractal height field; named sizes are 120,000, 500,000 and 2,000,000",
       {{"triangles", 120000, 1000, 4e6, "about how many"}, {"seed", 1, 0, 1e6, "other mountains"}},
       builtin::make_terrain},
  };
  return scenes;
}

}  // namespace omma
