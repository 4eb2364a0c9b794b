// Cameras of every lens in lens_models(), for tests that hold for all of them.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "omma/camera/camera.h"

namespace omma {

struct SampleCamera {
  std::string text;
  Camera camera;
};

/// The lens's own example, and narrow, widest, off-centre and full-frame cameras, in images that are not square.
inline std::vector<SampleCamera> sample_cameras(const LensModel& model) {
  const LensInfo& info = model.info;
  const double widest = info.max_fov_inclusive ? info.max_fov_deg : 0.98 * info.max_fov_deg;
  std::vector<std::string> texts = {
      info.example,
      fmt::format("{}:fov_deg=40,width=321,height=240", info.name),
      fmt::format("{}:fov_deg={},width=240,height=321", info.name, widest),
      fmt::format("{}:fov_deg=100,cx=120.25,cy=130.5,width=321,height=240", info.name),
      fmt::format("{}:fx=90,fy=110,cx=150,cy=121,width=321,height=240", info.name),
  };
  if (info.radial) texts.push_back(fmt::format("{}:fov_deg=150,fit=full,width=321,height=240", info.name));
  std::vector<SampleCamera> samples;
  for (const std::string& text : texts) samples.push_back({text, make_camera(text)});
  return samples;
}

}  // namespace omma
