// Cameras of every lens in lens_models(), for tests that hold for all of them.
#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

#include "omma/camera/camera.h"
#include "tests/proof.h"

namespace omma {

struct SampleCamera {
  std::string text;
  Camera camera;
};

/// The text of the lens's own example under another of its names.
inline std::string example_as(const LensModel& model, const std::string& name) {
  const std::string example = model.info.example;
  return name + example.substr(std::min(example.find(':'), example.size()));
}

/// The widest field of view that a lens is sure to have with its default parameters.
inline double widest_fov_deg(const LensInfo& info) {
  const double formula_deg = lens_parameters(info).max_angle * 360.0 / 3.14159265358979323846;
  if (formula_deg < info.max_fov_deg - 1e-3) return 0.98 * formula_deg;
  return info.max_fov_inclusive ? info.max_fov_deg : 0.98 * info.max_fov_deg;
}

/// The lens's own example, and narrow, widest, off-centre, turned and full-frame cameras, in images that are not
/// square.
inline std::vector<SampleCamera> sample_cameras(const LensModel& model) {
  const LensInfo& info = model.info;
  std::vector<std::string> texts = {
      info.example,
      fmt::format("{}:fx=90,fy=110,cx=150,cy=121,width=321,height=240", info.name),
      fmt::format("{}:f=100,width=240,height=200,yaw_deg=130,pitch_deg=-35,roll_deg=70", info.name),
  };
  if (info.max_fov_deg == 0) {
    texts.push_back(fmt::format("{}:width=320,height=240", info.name));
    texts.push_back(fmt::format("{}:width=240,height=321", info.name));
  } else {
    for (const std::string& text : {
             fmt::format("{}:fov_deg=40,width=321,height=240", info.name),
             fmt::format("{}:fov_deg={},width=240,height=321", info.name, widest_fov_deg(info)),
             fmt::format("{}:fov_deg=100,cx=120.25,cy=130.5,width=321,height=240", info.name),
         }) {
      texts.push_back(text);
    }
  }
  if (info.radial) texts.push_back(fmt::format("{}:fov_deg=150,fit=full,width=321,height=240", info.name));
  std::vector<SampleCamera> samples;
  for (const std::string& text : texts) samples.push_back({text, make_camera(text)});
  return samples;
}

/// One of them, or all in the full proof.
inline std::vector<SampleCamera> sample_cameras_of_today(const LensModel& model) {
  const std::vector<SampleCamera> all = sample_cameras(model);
  std::vector<SampleCamera> of_today;
  for (size_t i = 0; i < all.size(); ++i) {
    if (is_proved_today(size_t(&model - lens_models().data()), i, all.size())) of_today.push_back(all[i]);
  }
  return of_today;
}

}  // namespace omma
