// Warp meshes from files. u and v run from the lower left corner of the base image, as those who made them have it.
#include <array>
#include <cmath>
#include <limits>

#include "omma/base/error.h"
#include "omma/base/names.h"
#include "omma/camera/deformation/text_rows.h"
#include "omma/camera/deformation/warp.h"

namespace omma {
namespace {

constexpr size_t max_nodes = size_t{1} << 24;
constexpr WarpNode not_shown = {glm::dvec2(std::numeric_limits<double>::quiet_NaN()), glm::dvec2(0.0)};

glm::dvec2 source_of(double u, double v) { return {u, 1.0 - v}; }

// http://paulbourke.net/dataformats/meshwarp/: the mesh's type (2 rectangular, 1 polar), its two dimensions, and for
// each node x, y (1 at the image's top, as wide as it is), u, v, and an intensity, negative where nothing is drawn.
WarpMesh read_bourke(const std::string& path, double aspect) {
  const std::vector<TextRow> rows = read_rows(path);
  if (rows.size() < 2)
    throw InputError("{}: two lines of a header are expected: the mesh's type, its dimensions", path);
  const long type = rows[0].integer(0);
  if (rows[0].words.size() != 1 || (type != 1 && type != 2)) {
    throw InputError("{}: mesh type '{}'; 2 (rectangular) or 1 (polar) is accepted", rows[0].place, rows[0].words[0]);
  }
  const long columns = rows[1].integer(0), lines = rows[1].integer(1);
  const long most = static_cast<long>(max_nodes);
  if (rows[1].words.size() != 2 || columns < 2 || lines < 2 || columns > most || lines > most / columns) {
    throw InputError("{}: a mesh of {} x {} nodes; 2 a side or more, {} in all are accepted", rows[1].place, columns,
                     lines, most);
  }
  const size_t count = static_cast<size_t>(columns) * static_cast<size_t>(lines);
  if (rows.size() - 2 != count) {
    throw InputError("{}: {} lines of nodes; {} x {} are expected", rows.back().place, rows.size() - 2, columns, lines);
  }
  WarpMesh mesh;
  bool shaded = false;
  for (size_t i = 2; i < rows.size(); ++i) {
    const TextRow& row = rows[i];
    if (row.words.size() != 5) {
      throw InputError("{}: {} values; five are expected: x y u v intensity", row.place, row.words.size());
    }
    const double x = row.number(0), y = row.number(1), intensity = row.number(4);
    const WarpNode node{{0.5 + 0.5 * x / aspect, 0.5 - 0.5 * y}, source_of(row.number(2), row.number(3))};
    mesh.nodes.push_back(intensity < 0.0 ? not_shown : node);
    shaded = shaded || (intensity >= 0.0 && intensity != 1.0);
  }
  if (shaded) {
    warn(fmt::format("{}: its intensities are for blending projectors; rays have none, the picture is not shaded",
                     path));
  }
  add_grid_triangles(mesh, static_cast<int>(columns), static_cast<int>(lines), type == 1);
  return mesh;
}

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
WarpMesh read_obj(const std::string& path) {
  WarpMesh mesh;
  std::vector<glm::dvec2> places, sources;
  bool deep = false;
  for (const TextRow& row : read_rows(path)) {
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
      if (mesh.nodes.size() > max_nodes) throw InputError("{}: more than {} corners", row.place, max_nodes);
    }
  }
  if (mesh.triangles.empty()) throw InputError("{}: no face (a line such as 'f 1/1 2/2 3/3')", path);
  if (deep) warn(fmt::format("{}: a warp mesh is flat, its z is not used", path));
  return mesh;
}

// As MPCDI has it: R and G hold u and v, for as many points as there are pixels; NaN where nothing is shown.
WarpMesh read_uv_image(const std::string& path) {
  const FloatImage image = read_vectors(path);
  return texture_mesh(image.size, [&](const glm::dvec2& place, const glm::ivec2& texel, const glm::dvec2& centre) {
    const float* uv = image.at(texel.x, texel.y);
    return WarpNode{place, source_of(uv[0], uv[1]) + (place - centre)};
  });
}

}  // namespace

WarpMesh read_warp_mesh(const std::filesystem::path& path, double aspect) {
  const std::string name = path.string(), extension = path.extension().string();
  if (extension == ".data") return read_bourke(name, aspect);
  if (extension == ".obj") return read_obj(name);
  if (extension == ".pfm" || extension == ".exr") return read_uv_image(name);
  throw CommandError("{}: '{}' is no warp mesh; .data, .obj, .pfm and .exr are", name, extension);
}

}  // namespace omma
