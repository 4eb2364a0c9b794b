#include "omma/technique/piecewise/piece_drawer.h"

namespace omma {
namespace {

class NaiveDrawer : public PieceDrawer {
 public:
  explicit NaiveDrawer(DrawTools& tools) : tools_(tools) {}

  void draw(const View& view, const GpuPieces& pieces) override {
    const glm::dmat4 cameraFromWorld = glm::inverse(view.worldFromCamera);
    const PieceClipping clipping;
    MeshDrawer drawer(tools_);
    pieces.bind();
    for (size_t piece = 0; piece < pieces.count(); ++piece) {
      drawer.draw({.stages = {{GL_VERTEX_SHADER, "technique/piecewise/naive.vert"}},
                   .defines = pieces.defines(),
                   .set_uniforms =
                       [&](const gl::Program& program) {
                         pieces.set_uniforms(program);
                         program.set("piece", unsigned(piece));
                       },
                   .may_be_seen = [&](const Bounds& world) { return pieces.may_show(piece, cameraFromWorld, world); },
                   .mirror_image = pieces.is_mirrored(piece)},
                  view);
    }
  }

 private:
  DrawTools& tools_;
};

}  // namespace

std::unique_ptr<PieceDrawer> make_naive_drawer(DrawTools& tools) { return std::make_unique<NaiveDrawer>(tools); }

MeshPass replica_pass(const GpuPieces& pieces, std::vector<gl::Stage> stages) {
  const bool mixed = pieces.any_mirrored() && !pieces.all_mirrored();
  gl::Defines defines = pieces.defines();
  defines["PULLED"] = "1";
  if (mixed) defines["MIXED_PIECES"] = "1";
  return {.stages = std::move(stages),
          .defines = std::move(defines),
          .set_uniforms = [&pieces](const gl::Program& program) { pieces.set_uniforms(program); },
          .may_be_seen = [](const Bounds&) { return true; },
          .mirror_image = pieces.all_mirrored(),
          .culls = !mixed};
}

}  // namespace omma
