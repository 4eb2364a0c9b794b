// The squares of an image as the GPU sees them. For a lens they know as well how straight the edges of triangles are.
#pragma once

#include "omma/base/recent_cache.h"
#include "omma/technique/nonlinear/image_squares.h"
#include "omma/technique/replication/cone_tree.h"
#include "omma/technique/view.h"

namespace omma {

/// How triangles are drawn: all exactly, or those that the lens leaves straight apart.
enum class Forms { all_exact, straight, all_but_straight };

class ImageTiles : public ConeTree {
 public:
  /// The view must outlive what is drawn with it.
  void set(const View& view);

  void bind() const override;
  void set_uniforms(const gl::Program& program) const override;
  gl::Defines coverage_defines() const override;
  /// PROJECTS and the camera's symbols, where triangles are given outlines of their own.
  gl::Defines outline_defines() const;
  /// Which triangles are looked for next; the others reach nothing.
  void look_for(Forms forms) { forms_ = forms; }
  size_t bytes() const;

 private:
  struct Key {
    Camera camera;
    PixelRect tile;
    bool shifted;  ///< passes may sample up to half a pixel beside
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Squares {
    int count = 0;
    gl::Texels nodes{GL_RGBA32UI}, linear_rays{GL_RGBA32F};
  };
  static Squares upload(const Key& key);
  static gl::Texels upload_curvature(const Lens& lens);

  const View* view_ = nullptr;
  Forms forms_ = Forms::all_exact;
  RecentCache<Key, Squares> cache_;
  RecentCache<Lens, gl::Texels> curvatures_;
  const Squares* squares_ = nullptr;
  const gl::Texels* curvature_ = nullptr;  ///< null where there is no lens
};

}  // namespace omma
