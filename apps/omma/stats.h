// --stats: what a rendering took, as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "omma/render/prepared_scene.h"

namespace omma::tool {

struct FrameStats {
  int frame = 0;
  std::vector<std::string> files;
  RenderStats render;
  double render_ms = 0.0;  ///< wall clock, from the scene in memory to the image in memory
  double write_ms = 0.0;   ///< wall clock, all files
};

struct JobStats {
  std::string scene, camera;
  ImageSize size;
  int samples = 0;
  double load_ms = 0.0;   ///< wall clock: reading the scene
  double setup_ms = 0.0;  ///< wall clock: opening a GL context, handing the scene over, with the first frames
  int skipped = 0;        ///< frames whose files were there already
  std::vector<FrameStats> frames;
};

void write_stats(const std::filesystem::path& path, const JobStats& stats);

}  // namespace omma::tool
