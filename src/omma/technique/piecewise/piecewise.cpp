#include "omma/technique/piecewise/piecewise.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "omma/camera/pieces/approximate.h"
#include "omma/technique/piecewise/piece_drawer.h"

namespace omma {
namespace {

struct Variant {
  const char* name;
  const char* description;
  std::unique_ptr<PieceDrawer> (*make)(DrawTools&);
};

constexpr Variant variants[] = {
    {"compute", "counts, prefix sums and indirect draws in compute shaders", make_compute_drawer},
    {"naive", "a draw for each piece, with culling", make_naive_drawer},
    {"feedback", "three passes: count, replicate last frame's list, draw", make_feedback_drawer},
    {"tessellator", "one pass: the tessellation unit makes the replicas", make_tessellator_drawer},
};

class Piecewise : public Technique {
 public:
  Piecewise(DrawTools& tools, std::unique_ptr<PieceDrawer> drawer) : tools_(tools), drawer_(std::move(drawer)) {}
  bool multisamples() const override { return true; }
  void scene_changed() override { drawer_->scene_changed(); }
  size_t buffer_bytes() const override { return pieces_.bytes() + drawer_->buffer_bytes(); }

  void draw(const View& view, const Target& target) override {
    tools_.timer.mark("pieces");
    choose_pieces(view);
    pieces_.set(*pieces_camera_, view);
    tools_.multisampled(view, target, [&](const Target& image) {
      image.begin();
      tools_.timer.mark("background");
      tools_.draw_background(view);
      tools_.timer.mark("draw");
      drawer_->draw(view, pieces_);
    });
  }

  const Camera* pieces() const override { return pieces_camera_ ? &*pieces_camera_ : nullptr; }

  void report(RenderStats& stats) const override {
    stats.pieces = pieces_camera_->pieces()->pieces().size();
    stats.piece_error_px = error_.max_px;
  }

 private:
  void choose_pieces(const View& view) {
    if (camera_ == view.camera && options_ == view.pieces) return;
    Approximation approximation = approximate(view.camera, view.pieces);
    pieces_camera_.emplace(std::move(approximation.pieces));
    error_ = approximation.error;
    camera_ = view.camera;
    options_ = view.pieces;
  }

  DrawTools& tools_;
  std::unique_ptr<PieceDrawer> drawer_;
  GpuPieces pieces_;
  PieceError error_;
  std::optional<Camera> camera_;         ///< that was asked for
  std::optional<Camera> pieces_camera_;  ///< that stands for it
  PieceOptions options_;
};

std::vector<VariantInfo> variant_infos() {
  std::vector<VariantInfo> infos;
  for (const Variant& variant : variants) infos.push_back({variant.name, variant.description});
  return infos;
}

}  // namespace

const TechniqueEntry piecewise_technique{
    {.name = "piecewise",
     .description = "triangles replicated into perspective pieces of the image; exact for its pieces",
     .exact = false,
     .needs_project = false,
     .variants = variant_infos()},
    [](DrawTools& tools, const std::string& name) -> std::unique_ptr<Technique> {
      const Variant& variant = *std::find_if(std::begin(variants), std::end(variants),
                                             [&](const Variant& entry) { return entry.name == name; });
      return std::make_unique<Piecewise>(tools, variant.make(tools));
    }};

}  // namespace omma
