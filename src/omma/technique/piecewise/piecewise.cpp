#include "omma/technique/piecewise/piecewise.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

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
  void scene_changed(const SceneChanges& changes) override { drawer_->scene_changed(changes); }
  size_t buffer_bytes() const override { return pieces_.bytes() + drawer_->buffer_bytes(); }

  void draw(const View& view, const Target& target) override {
    tools_.timer.mark("pieces");
    last_ = &approximated(view);
    pieces_.set(last_->pieces, view);
    tools_.multisampled(view, target, [&](const Target& image) {
      image.begin();
      tools_.timer.mark("background");
      tools_.draw_background(view);
      tools_.timer.mark("draw");
      drawer_->draw(view, pieces_);
    });
  }

  const Camera* pieces() const override { return last_ ? &last_->pieces : nullptr; }

  void report(RenderStats& stats) const override {
    stats.pieces = last_->pieces.pieces()->pieces().size();
    stats.piece_error_px = last_->error.max_px;
  }

 private:
  /// A camera, and the pieces that stand for it.
  struct Approximated {
    Camera camera;
    PieceOptions options;
    Camera pieces;
    PieceError error;
  };

  /// Choosing pieces takes longer than a frame, and people go to and fro between a few cameras.
  const Approximated& approximated(const View& view) {
    constexpr size_t kept = 8;
    const auto found = std::find_if(approximated_.begin(), approximated_.end(), [&](const auto& entry) {
      return entry->camera == view.camera && entry->options == view.pieces;
    });
    if (found != approximated_.end()) return **found;
    Approximation approximation = approximate(view.camera, view.pieces);
    if (approximated_.size() == kept) approximated_.erase(approximated_.begin());
    approximated_.push_back(std::make_unique<Approximated>(
        Approximated{view.camera, view.pieces, Camera(std::move(approximation.pieces)), approximation.error}));
    return *approximated_.back();
  }

  DrawTools& tools_;
  std::unique_ptr<PieceDrawer> drawer_;
  GpuPieces pieces_;
  std::vector<std::unique_ptr<Approximated>> approximated_;  ///< the oldest first
  const Approximated* last_ = nullptr;
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
