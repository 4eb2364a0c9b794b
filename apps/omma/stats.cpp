#include "stats.h"

#include <nlohmann/json.hpp>

#include "omma/base/file.h"

namespace omma::tool {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const FrameStats& frame) {
  const RenderStats& render = frame.render;
  Json stages = Json::object();
  for (const auto& [stage, milliseconds] : render.stage_ms) stages[stage] = milliseconds;
  // JSON has no number for "not counted" but null.
  const Json fragments = render.fragments_shaded ? Json(*render.fragments_shaded) : Json(nullptr);
  return {
      {"frame", frame.frame},
      {"files", frame.files},
      {"technique", render.technique},
      {"renderer", render.renderer},
      {"triangles", render.triangles},
      {"triangles_drawn", render.triangles_drawn},
      {"replication", render.triangles ? double(render.triangles_drawn) / double(render.triangles) : 0.0},
      {"fragments_shaded", fragments},
      {"samples_kept", render.samples_kept},
      {"fragments_touched", render.bound_fragments ? Json(render.bound_fragments->touched) : Json(nullptr)},
      {"fragments_kept", render.bound_fragments ? Json(render.bound_fragments->kept) : Json(nullptr)},
      {"buffer_bytes", render.buffer_bytes},
      {"pieces", render.pieces},
      {"piece_error_px", render.piece_error_px},
      {"tiles", render.tiles},
      {"passes", render.passes},
      {"render_ms", frame.render_ms},
      {"write_ms", frame.write_ms},
      {"stages_ms", stages},
  };
}

}  // namespace

void write_stats(const std::filesystem::path& path, const JobStats& stats) {
  Json frames = Json::array();
  for (const FrameStats& frame : stats.frames) frames.push_back(to_json(frame));
  const Json json{
      {"omma", OMMA_VERSION},        {"scene", stats.scene},        {"camera", stats.camera},
      {"width", stats.size.width},   {"height", stats.size.height}, {"samples", stats.samples},
      {"load_ms", stats.load_ms},    {"setup_ms", stats.setup_ms},  {"frames_skipped", stats.skipped},
      {"frames", std::move(frames)},
  };
  // Paths may hold any bytes.
  write_text(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace omma::tool
