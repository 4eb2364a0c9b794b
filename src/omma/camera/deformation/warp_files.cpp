// Warp meshes from files. u and v run from the lower left corner of the base image, as those who made them have it.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/camera/deformation/text_rows.h"
#include "omma/camera/deformation/warp.h"

namespace omma {
namespace {

constexpr WarpNode not_shown = {glm::dvec2(std::numeric_limits<double>::quiet_NaN()), glm::dvec2(0.0)};

glm::dvec2 source_of(double u, double v) { return {u, 1.0 - v}; }

// http://paulbourke.net/dataformats/meshwarp/: the mesh's type (2 rectangular, 1 polar), its two dimensions, and for
// each node x, y (1 at the image's top, as wide as it is), u, v, and an intensity, negative where nothing is drawn.
class BourkeReader {
 public:
  BourkeReader(const std::string& path, double aspect, const Limits& limits)
      : path_(path), aspect_(aspect), limits_(limits) {}

  WarpMesh read() {
    for_each_row(path_, limits_, [&](const TextRow& row) {
      if (rows_ == 0) {
        read_type(row);
      } else if (rows_ == 1) {
        read_dimensions(row);
      } else {
        read_node(row);
      }
      ++rows_;
      place_ = row.place;
    });
    if (rows_ < 2) {
      throw InputError("{}: two lines of a header are expected: the mesh's type, its dimensions", path_);
    }
    if (rows_ - 2 != count()) {
      throw InputError("{}: {} lines of nodes; {} x {} are expected", place_, rows_ - 2, columns_, lines_);
    }
    if (shaded_) {
      warn(fmt::format("{}: its intensities are for blending projectors; rays have none, the picture is not shaded",
                       path_));
    }
    add_grid_triangles(mesh_, static_cast<int>(columns_), static_cast<int>(lines_), type_ == 1);
    return std::move(mesh_);
  }

 private:
  size_t count() const { return static_cast<size_t>(columns_) * static_cast<size_t>(lines_); }

  void read_type(const TextRow& row) {
    type_ = row.integer(0);
    if (row.words.size() != 1 || (type_ != 1 && type_ != 2)) {
      throw InputError("{}: mesh type '{}'; 2 (rectangular) or 1 (polar) is accepted", row.place, row.words[0]);
    }
  }

  void read_dimensions(const TextRow& row) {
    columns_ = row.integer(0);
    lines_ = row.integer(1);
    const long most = static_cast<long>(limits_.warp_nodes);
    if (row.words.size() != 2 || columns_ < 2 || lines_ < 2) {
      throw InputError("{}: a mesh of {} x {} nodes; 2 a side or more are accepted", row.place, columns_, lines_);
    }
    if (columns_ > most || lines_ > most / columns_) {
      throw InputError("{}: a mesh of {} x {} nodes: {}", row.place, columns_, lines_,
                       limit_text(limits_, &Limits::warp_nodes));
    }
  }

  void read_node(const TextRow& row) {
    if (row.words.size() != 5) {
      throw InputError("{}: {} values; five are expected: x y u v intensity", row.place, row.words.size());
    }
    const double x = row.number(0), y = row.number(1), intensity = row.number(4);
    const WarpNode node{{0.5 + 0.5 * x / aspect_, 0.5 - 0.5 * y}, source_of(row.number(2), row.number(3))};
    // Those beyond the last are only counted.
    if (mesh_.nodes.size() < count()) mesh_.nodes.push_back(intensity < 0.0 ? not_shown : node);
    shaded_ = shaded_ || (intensity >= 0.0 && intensity != 1.0);
  }

  const std::string& path_;
  double aspect_;
  const Limits& limits_;
  WarpMesh mesh_;
  size_t rows_ = 0;
  std::string place_;  ///< of the last row
  long type_ = 0, columns_ = 0, lines_ = 0;
  bool shaded_ = false;
};

// The entry that a word of a face names, counted from 1, or from the end when negative.
size_t entry_of(const TextRow& row, const std::string& word, size_t count, const char* what) {
  long number = 0;
  try {
    number = parse_integer(row.place, word);
  } catch (const CommandError& error) {
    throw InputError("{}", error.what());
  }
  const long total = static_cast<long>(count);
  const long index = number < 0 ? total + number : number - 1;
  if (index < 0 || index >= total) {
    throw InputError("{}: there is no {} {}; {} came before", row.place, what, number, count);
  }
  return static_cast<size_t>(index);
}

// Wavefront OBJ as SGCT uses it: x and y from -1 to 1 over the image, y up.
WarpMesh read_obj(const std::string& path, const Limits& limits) {
  WarpMesh mesh;
  std::vector<glm::dvec2> places, sources;
  bool deep = false;
  for_each_row(path, limits, [&](const TextRow& row) {
    const std::string& kind = row.words[0];
    if (kind == "v") {
      places.emplace_back(0.5 + 0.5 * row.number(1), 0.5 - 0.5 * row.number(2));
      deep = deep || (row.words.size() > 3 && row.number(3) != 0.0);
    } else if (kind == "vt") {
      sources.push_back(source_of(row.number(1), row.number(2)));
    } else if (kind == "f") {
      if (row.words.size() < 4) throw InputError("{}: a face of {} corners", row.place, row.words.size() - 1);
      const auto first = static_cast<uint32_t>(mesh.nodes.size());
      for (size_t i = 1; i < row.words.size(); ++i) {
        const std::vector<std::string> parts = split(row.words[i], '/');
        const size_t place = entry_of(row, parts[0], places.size(), "vertex");
        // Without one of its own, a vertex has the texture coordinates of the same number.
        const bool own = parts.size() > 1 && !parts[1].empty();
        const size_t source = entry_of(row, own ? parts[1] : parts[0], sources.size(), "texture coordinate");
        mesh.nodes.push_back({places[place], sources[source]});
        if (i > 2) {
          const auto last = static_cast<uint32_t>(mesh.nodes.size() - 1);
          mesh.triangles.push_back({first, last - 1, last});
        }
      }
    }
    if (std::max({mesh.nodes.size(), places.size(), sources.size()}) > limits.warp_nodes) {
      throw InputError("{}: more than {} corners: {}", row.place, limits.warp_nodes,
                       limit_text(limits, &Limits::warp_nodes));
    }
  });
  if (mesh.triangles.empty()) throw InputError("{}: no face (a line such as 'f 1/1 2/2 3/3')", path);
  if (deep) warn(fmt::format("{}: a warp mesh is flat, its z is not used", path));
  return mesh;
}

// As MPCDI has it: R and G hold u and v, for as many points as there are pixels; NaN where nothing is shown.
WarpMesh read_uv_image(const std::string& path, const Limits& limits) {
  const FloatImage image = read_vectors(path, limits);
  return texture_mesh(image.size, [&](const glm::dvec2& place, const glm::ivec2& texel, const glm::dvec2& centre) {
    const float* uv = image.at(texel.x, texel.y);
    return WarpNode{place, source_of(uv[0], uv[1]) + (place - centre)};
  });
}

}  // namespace

WarpMesh read_warp_mesh(const std::filesystem::path& path, double aspect, const Limits& limits) {
  const std::string name = path.string(), extension = path.extension().string();
  if (extension == ".data") return BourkeReader(name, aspect, limits).read();
  if (extension == ".obj") return read_obj(name, limits);
  if (extension == ".pfm" || extension == ".exr") return read_uv_image(name, limits);
  throw CommandError("{}: '{}' is no warp mesh; .data, .obj, .pfm and .exr are", name, extension);
}

}  // namespace omma
