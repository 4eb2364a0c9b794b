#include "omma/technique/picture.h"

#include <algorithm>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {

const std::vector<ShowInfo>& shows() {
  static const std::vector<ShowInfo> infos{
      {Show::edges, "edges", "the edges of all triangles, thick and white"},
      {Show::pieces, "pieces", "the borders of the pieces that piecewise draws, thin and black"},
      {Show::overdraw, "overdraw", "what nonlinear rasterizes, red and green where it is kept, blue where not"},
  };
  return infos;
}

Show show_from_name(const std::string& name) {
  std::vector<std::string> names;
  for (const ShowInfo& info : shows()) {
    if (info.name == name) return info.show;
    names.emplace_back(info.name);
  }
  throw CommandError("{}", unknown_name("thing to show", name, names));
}

std::vector<int> refinement(int samples) {
  std::vector<int> counts;
  for (int count = 1; count < samples; count *= 4) counts.push_back(count);
  counts.push_back(samples);
  return counts;
}

std::vector<Effect> effects_of(const RenderOptions& options) {
  std::vector<Effect> effects = options.effects;
  if (options.show.contains(Show::edges)) effects.push_back(make_effect("wireframe:width_px=2.5,color=white"));
  check_effects(effects);
  return effects;
}

}  // namespace omma
