// COLMAP's cameras.txt: CAMERA_ID MODEL WIDTH HEIGHT PARAMS[], a line a camera.
//
// The top left corner is (0, 0), as in Omma; x right, y down, z forward. Each model has its own order of parameters,
// below; simple models have one focal length. FOV's omega is in radians.
#include <fmt/format.h>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

struct Model {
  const char* name;
  const char* lens;
  int focals;         ///< 1: f, 2: fx fy; then cx cy
  size_t parameters;  ///< after cx cy, in the order of the lens
};

constexpr Model models[] = {
    {"SIMPLE_PINHOLE", "perspective", 1, 0},
    {"PINHOLE", "perspective", 2, 0},
    {"SIMPLE_RADIAL", "opencv", 1, 1},
    {"RADIAL", "opencv", 1, 2},
    {"OPENCV", "opencv", 2, 4},
    {"FULL_OPENCV", "opencv", 2, 8},
    {"SIMPLE_FISHEYE", "equidistant", 1, 0},
    {"FISHEYE", "equidistant", 2, 0},
    {"SIMPLE_RADIAL_FISHEYE", "opencv_fisheye", 1, 1},
    {"RADIAL_FISHEYE", "opencv_fisheye", 1, 2},
    {"OPENCV_FISHEYE", "opencv_fisheye", 2, 4},
    {"THIN_PRISM_FISHEYE", "thin_prism_fisheye", 2, 8},
    {"RAD_TAN_THIN_PRISM_FISHEYE", "fisheye624", 2, 12},
    {"FOV", "fov", 2, 1},
    {"SIMPLE_DIVISION", "division", 1, 1},
    {"DIVISION", "division", 2, 1},
    {"EUCM", "eucm", 2, 2},
};

constexpr std::string_view panorama = "EQUIRECTANGULAR";

bool is_capital(char c) { return (c >= 'A' && c <= 'Z') || c == '_'; }

bool recognises(const Document& document) {
  if (document.syntax != Syntax::lines) return false;
  const std::vector<std::string>& words = document.lines.front().words;
  return words.size() >= 2 && is_capital(words[1].front());
}

// The text of a line's word as a number; "FX" names it in messages.
double number(const Place& place, const std::vector<std::string>& words, size_t i, const char* key) {
  Place named = place;
  named.key = key;
  return number_at(named, words[i]);
}

ImageSize size_of(const Place& place, const std::string& width, const std::string& height, const char* key) {
  Place named = place;
  named.key = key;
  return image_size(named, static_cast<double>(integer_at(named, width)),
                    static_cast<double>(integer_at(named, height)));
}

Camera read_camera(const Place& place, const std::vector<std::string>& words) {
  const ImageSize size = size_of(place, words[2], words[3], "WIDTH HEIGHT");
  if (words[1] == panorama) {
    if (words.size() > 4) {
      const size_t given = words.size() - 4;
      if (given != 2) place.fail("{} has {} parameters; width and height are expected", words[1], given);
      const ImageSize again = size_of(place, words[4], words[5], "PARAMS");
      if (again != size) place.fail("the parameters say {} x {}", again.width, again.height);
    }
    return to_equirectangular(place, size);
  }
  const Model* model = nullptr;
  std::vector<std::string> known = {std::string(panorama)};
  for (const Model& candidate : models) {
    known.emplace_back(candidate.name);
    if (words[1] == candidate.name) model = &candidate;
  }
  if (!model) {
    place.fail("a camera model of COLMAP is expected, and '{}' is none (one of: {})", words[1].substr(0, 40),
               fmt::join(known, ", "));
  }
  const size_t first = 4 + static_cast<size_t>(model->focals);
  if (words.size() != first + 2 + model->parameters) {
    place.fail("{} has {} parameters; {} are expected", model->name, words.size() - 4,
               static_cast<size_t>(model->focals) + 2 + model->parameters);
  }
  Calibration calibration{.model = model->lens, .size = size, .parameters = {}};
  calibration.focal.x = number(place, words, 4, "PARAMS");
  calibration.focal.y = number(place, words, first - 1, "PARAMS");
  calibration.centre = {number(place, words, first, "PARAMS"), number(place, words, first + 1, "PARAMS")};
  for (size_t i = first + 2; i < words.size(); ++i) {
    calibration.parameters.push_back(number(place, words, i, "PARAMS"));
  }
  return to_camera(place, calibration);
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  std::vector<CameraFile::Entry> entries;
  for (const Line& line : document->lines) {
    const Place place = document->place(line.number);
    if (line.words.size() < 4) place.fail("CAMERA_ID MODEL WIDTH HEIGHT PARAMS[] is expected");
    integer_at(document->place(line.number, "CAMERA_ID"), line.words[0]);
    entries.push_back({line.words[0], [place, words = line.words] { return read_camera(place, words); }});
  }
  return entries;
}

std::string write_line(const NamedCamera& camera) {
  const Lens& lens = lens_to_write(camera, colmap_format.name);
  const std::string size = fmt::format("{} {}", lens.size.width, lens.size.height);
  if (is_whole_panorama(lens)) return fmt::format("{} {} {}", panorama, size, size);
  for (const Model& model : models) {
    if (model.focals == 1 && lens.focal.x != lens.focal.y) continue;
    const auto parameters = lens.model->info.name == std::string_view(model.lens)
                                ? parameters_as(lens, model.lens, model.parameters)
                                : std::nullopt;
    if (!parameters) continue;
    std::string line = fmt::format("{} {} {}", model.name, size, lens.focal.x);
    if (model.focals == 2) line += fmt::format(" {}", lens.focal.y);
    line += fmt::format(" {} {}", lens.centre.x, lens.centre.y);
    for (const double parameter : *parameters) line += fmt::format(" {}", parameter);
    return line;
  }
  refuse_lens(camera, colmap_format.name,
              "perspective, opencv with up to eight coefficients, equidistant, opencv_fisheye, thin_prism_fisheye, "
              "fisheye624, fov, division, eucm and equirectangular");
}

std::string write(std::span<const NamedCamera> cameras) {
  std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (size_t i = 0; i < cameras.size(); ++i) text += fmt::format("{} {}\n", i + 1, write_line(cameras[i]));
  return text;
}

}  // namespace

const CameraFormat colmap_format = {
    .name = "colmap",
    .what = "COLMAP cameras.txt",
    .recognised = "lines `CAMERA_ID MODEL WIDTH HEIGHT …`",
    .models = "all of COLMAP's: SIMPLE_PINHOLE … RAD_TAN_THIN_PRISM_FISHEYE, FOV, DIVISION, EUCM, EQUIRECTANGULAR",
    .convention = "image's corner at (0, 0), as Omma's; f or fx fy, then cx cy, then coefficients",
    .recognises = recognises,
    .read = read,
    .extension = ".txt",
    .write = write,
};

}  // namespace omma
