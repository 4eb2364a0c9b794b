// What is asked of a picture, what it took, and what a technique says of itself.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "omma/camera/pieces/approximate.h"
#include "omma/shading/effects.h"
#include "omma/shading/shadow_layers.h"

namespace omma {

enum class Filter { trilinear, anisotropic };

/// What is drawn over a picture to show how it is made.
enum class Show { edges, pieces, overdraw };

struct ShowInfo {
  Show show;
  const char* name;
  const char* description;
};

/// Everything that can be shown.
const std::vector<ShowInfo>& shows();
/// Throws CommandError with the nearest name when there is no such thing.
Show show_from_name(const std::string& name);

struct RenderOptions {
  std::string technique = "auto";  ///< `name` or `name:variant`, see techniques()
  int samples = 4;                 ///< colour samples per pixel, 1 to 1024
  Filter filter = Filter::anisotropic;
  int face_size = 0;              ///< image-based: texels along a cube face, 0: the camera's density at its centre
  PieceOptions pieces{};          ///< piecewise: how finely the camera is cut; its tolerance is subdivision's, too
  int tile = 0;                   ///< largest tile's side in pixels, 0: what the driver allows
  std::vector<Effect> effects{};  ///< on colour, one after another; up to max_effects, what is shown included
  std::set<Show> show{};          ///< over colour
  bool count_fragments = false;   ///< takes longer; see RenderStats::bound_fragments
  std::optional<glm::vec3> background{};  ///< linear RGB where a ray meets nothing; nothing: a sky
  Shadows shadows = Shadows::off;
  int shadow_size = 1024;        ///< texels along a shadow map, 16 or more
  std::optional<int> reflect{};  ///< the object whose surfaces show what surrounds it
  int reflection_size = 512;     ///< texels along each of its two maps, 16 or more
  /// When it is asked to stop, drawing ends by throwing Cancelled: between squares of pixels on the processor, between
  /// tiles and passes by OpenGL; maps of shadows and what else is kept for later pictures are finished first.
  std::stop_token stop{};
};

/// How many samples a pixel has in a picture that gets better while nothing moves: 1, 4, 16, …, `samples`. Each is the
/// picture that so many samples give. All together take a third longer than the last alone where that is a power of 4.
std::vector<int> refinement(int samples);

/// The effects asked for, then those that show something. Throws CommandError for a chain that check_effects refuses.
std::vector<Effect> effects_of(const RenderOptions& options);

/// Pixels of bounding shapes, summed over triangles whether hidden or not.
struct BoundFragments {
  uint64_t touched = 0;  ///< that the shapes cover
  uint64_t kept = 0;     ///< of those, the ones that see the triangle
};

/// What a picture took. Times are milliseconds, of the GPU's own clock where there is a GPU.
struct RenderStats {
  std::string technique;  ///< the one that drew, `name:variant`
  std::string renderer;   ///< the GL renderer, or the processor where there is none
  double setup_ms = 0.0;  ///< wall clock: opening a GL context, handing the scene over; 0 when that was done before
  size_t triangles = 0;   ///< in the scene
  size_t triangles_drawn = 0;                ///< primitives that reached the rasterizer for surfaces, over all passes
  std::optional<uint64_t> fragments_shaded;  ///< for surfaces; nothing where the driver does not count
  /// Of those, samples that passed the depth test and were no hole; where a resolve pass draws, triangles of pixels.
  uint64_t samples_kept = 0;
  std::optional<BoundFragments> bound_fragments;  ///< nonlinear, where RenderOptions asks for it
  size_t buffer_bytes = 0;                        ///< geometry, textures, targets, trees; on the GPU or beside it
  size_t pieces = 0;                              ///< piecewise: that make up the image
  double piece_error_px = 0.0;                    ///< piecewise: from the camera, at most
  int tiles = 0;
  int passes = 0;  ///< colour passes accumulated
  std::vector<std::pair<std::string, double>> stage_ms;
};

struct VariantInfo {
  std::string name;
  std::string description;
  bool needs_project = false;  ///< cannot draw a ray map, whatever its technique's other variants can
  bool without_gl = false;     ///< draws without OpenGL what SoftwareRenderer does, all else as the variant `with_gl`
  std::string with_gl{};
};

struct TechniqueInfo {
  std::string name;
  std::string description;
  bool exact;                         ///< equal to `raycast` but for rounding at edges
  bool needs_project;                 ///< cannot draw a ray map
  bool bounds = false;                ///< rasterizes bounding shapes, some of whose fragments are not kept
  std::vector<VariantInfo> variants;  ///< the first is the default; empty: none
};

/// Every technique, in the order of the registry.
const std::vector<TechniqueInfo>& techniques();

/// Throws CommandError with the nearest name for an unknown technique or variant.
void check_technique(std::string_view technique);

}  // namespace omma
