#include "omma/technique/subdivision/subdivision.h"

#include <algorithm>
#include <memory>

#include "omma/base/error.h"
#include "omma/technique/mesh_pass.h"
#include "omma/technique/subdivision/sorted_splitter.h"
#include "omma/technique/subdivision/splitter.h"

namespace omma {
namespace {

double checked_tolerance(const View& view) {
  const double tolerance_px = view.pieces.tolerance_px.value_or(default_tolerance_px);
  if (!(tolerance_px >= 0.01 && tolerance_px <= 100.0)) {
    throw CommandError("a tolerance of {} px; 0.01 to 100 is accepted", tolerance_px);
  }
  return tolerance_px;
}

struct Variant {
  const char* name;
  const char* description;
  SplitForm form;
};

constexpr Variant variants[] = {
    {"feedback", "all splitting by passes of transform feedback", SplitForm::all},
    {"tessellator", "edges halved by the tessellation unit, after such passes where it takes too much or too uneven",
     SplitForm::to_even},
};

class Subdivision : public Technique {
 public:
  Subdivision(DrawTools& tools, SplitForm form)
      : tools_(tools), form_(form), pixels_(tools), splitter_(tools, pixels_, form), sorted_(tools, pixels_, form) {}
  bool multisamples() const override { return true; }
  void scene_changed(const SceneChanges&) override { splitter_.scene_changed(); }
  size_t buffer_bytes() const override { return pixels_.bytes() + splitter_.bytes() + sorted_.bytes(); }

  void draw(const View& view, const Target& target) override {
    const double tolerance_px = checked_tolerance(view);
    if (!field_ || field_camera_ != view.camera) {
      field_ = field_of(view.camera);
      field_camera_ = view.camera;
    }
    const bool draws_blended = !view.labels() && tools_.scene.has_blending();
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());  // capturing wants a complete one, too
    tools_.timer.mark("project");
    pixels_.project(view, *field_);
    tools_.timer.mark("split");
    splitter_.split(view, *field_, tolerance_px, view.labels());
    if (draws_blended) sorted_.split(view, *field_, tolerance_px);
    tools_.multisampled(view, target, [&](const Target& image) {
      image.begin();
      tools_.timer.mark("background");
      tools_.draw_background(view);
      tools_.timer.mark("draw");
      draw_solid(view, tolerance_px);
      if (draws_blended) draw_blended(view, tolerance_px);
    });
  }

 private:
  MeshPass mesh_pass(const View& view, double tolerance_px, std::vector<gl::Stage> stages) {
    return {.stages = std::move(stages),
            .defines = subdivision_defines(*field_, view),
            .set_uniforms = [this, &view, tolerance_px](
                                const gl::Program& program) { set_field(program, *field_, view, tolerance_px); },
            .may_be_seen = [](const Bounds&) { return true; },
            .culls = false};
  }

  void draw_solid(const View& view, double tolerance_px) {
    const SurfaceState state(tools_, false);
    tools_.scene.bind_vertex_textures();
    pixels_.bind();
    const MeshPass plain = mesh_pass(view, tolerance_px, {{GL_VERTEX_SHADER, "technique/subdivision/plain.vert"}});
    const GLuint scene_array = tools_.scene.vertex_array().id();
    glVertexArrayElementBuffer(scene_array, splitter_.plain_indices().id());
    for (size_t group = 0; group < splitter_.groups().size(); ++group) {
      const SplitGroup& of = splitter_.groups()[group];
      if (of.blended && !view.labels()) continue;
      use_material(tools_, plain, view, of.material, of.mirrored);
      splitter_.draw_plain(group);
    }
    glVertexArrayElementBuffer(scene_array, tools_.scene.indices().id());
    draw_parts(view, tolerance_px);
    draw_records(view, border_pass(view, tolerance_px), GL_TRIANGLES, splitter_.border());
  }

  void draw_parts(const View& view, double tolerance_px) {
    const bool tessellates = form_ == SplitForm::to_even;
    MeshPass pass =
        mesh_pass(view, tolerance_px,
                  tessellates ? std::vector<gl::Stage>{{GL_VERTEX_SHADER, "technique/subdivision/patch.vert"},
                                                       {GL_TESS_CONTROL_SHADER, "technique/subdivision/patch.tesc"},
                                                       {GL_TESS_EVALUATION_SHADER, "technique/subdivision/patch.tese"}}
                              : std::vector<gl::Stage>{{GL_VERTEX_SHADER, "technique/subdivision/straight.vert"}});
    pass.defines["PULLED"] = "";
    glPatchParameteri(GL_PATCH_VERTICES, 3);
    draw_records(view, pass, tessellates ? GL_PATCHES : GL_TRIANGLES, splitter_.straight());
  }

  MeshPass border_pass(const View& view, double tolerance_px) {
    MeshPass pass = mesh_pass(view, tolerance_px,
                              {{GL_VERTEX_SHADER, "technique/subdivision/border.vert"},
                               {GL_GEOMETRY_SHADER, "technique/subdivision/border.geom"}});
    pass.defines["PULLED"] = "";
    return pass;
  }

  void draw_records(const View& view, const MeshPass& pass, GLenum mode, const RecordList& list) {
    list.bind(20);
    glBindVertexArray(tools_.no_vertices.id());
    for (size_t group = 0; group < splitter_.groups().size(); ++group) {
      const SplitGroup& of = splitter_.groups()[group];
      std::vector<GLint> firsts;
      std::vector<GLsizei> counts;
      for (const RecordList::Run& run : list.runs()) {
        if (run.group != group) continue;
        firsts.push_back(GLint(3 * run.first));
        counts.push_back(GLsizei(3 * run.count));
      }
      if (firsts.empty()) continue;
      use_material(tools_, pass, view, of.material, of.mirrored);
      glMultiDrawArrays(mode, firsts.data(), counts.data(), GLsizei(firsts.size()));
    }
  }

  void draw_blended(const View& view, double tolerance_px) {
    const SurfaceState state(tools_, true);
    tools_.scene.bind_vertex_textures();
    const MeshPass pass = border_pass(view, tolerance_px);
    sorted_.list().bind(20);
    glBindVertexArray(tools_.no_vertices.id());
    for (const RecordList::Run& run : sorted_.list().runs()) {
      const Part& part = tools_.scene.parts()[run.group];
      use_material(tools_, pass, view, part.material, part.mirrored);
      glDrawArrays(GL_TRIANGLES, GLint(3 * run.first), GLsizei(3 * run.count));
    }
  }

  DrawTools& tools_;
  SplitForm form_;
  ScenePixels pixels_;
  Splitter splitter_;
  SortedSplitter sorted_;
  std::optional<LensField> field_;
  std::optional<Camera> field_camera_;
};

std::vector<VariantInfo> variant_infos() {
  std::vector<VariantInfo> infos;
  for (const Variant& variant : variants) infos.push_back({variant.name, variant.description});
  return infos;
}

}  // namespace

const TechniqueEntry subdivision_technique{
    {.name = "subdivision",
     .description = "triangles split until straight edges are within the tolerance of the lens's; no cracks",
     .exact = false,
     .needs_project = true,
     .variants = variant_infos()},
    [](DrawTools& tools, const std::string& name) -> std::unique_ptr<Technique> {
      const Variant& variant = *std::find_if(std::begin(variants), std::end(variants),
                                             [&](const Variant& entry) { return entry.name == name; });
      return std::make_unique<Subdivision>(tools, variant.form);
    },
    [](const Camera& camera) -> std::optional<std::string> {
      if (!shows_rays_twice(*camera.lens())) return {};
      return "draws a ray at one place, and this camera shows some twice; use visibility, piecewise or image-based";
    }};

}  // namespace omma
