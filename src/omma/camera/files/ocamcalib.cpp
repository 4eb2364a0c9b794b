// OCamCalib's calib_results.txt: the polynomial from radius to ray, its inverse, the centre, the affine terms c, d, e
// and the image's size, a line each. The inverse polynomial is an approximation and is not used.
//
// Row before column everywhere, the centre of the first pixel at (0, 0). Coefficients a0 a1 … are of the radius in
// pixels, lowest first, a0 negative; at most seven.
#include <fmt/format.h>

#include <array>

#include "omma/camera/files/calibration.h"
#include "omma/camera/files/format.h"

namespace omma {
namespace {

constexpr std::array<const char*, 5> parts = {"polynomial", "inverse polynomial", "centre", "affine parameters",
                                              "image size"};

bool is_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

bool recognises(const Document& document) {
  return document.syntax == Syntax::lines && document.lines.front().words.size() >= 2 &&
         is_number(document.lines.front().words[1].front());
}

std::vector<double> numbers(const Document& document, size_t part, size_t count) {
  const Line& line = document.lines[part];
  const Place place = document.place(line.number, parts[part]);
  if (count > 0 && line.words.size() != count) {
    place.fail("has {} numbers; {} are expected", line.words.size(), count);
  }
  std::vector<double> values;
  for (const std::string& word : line.words) values.push_back(number_at(place, word));
  return values;
}

// A polynomial begins with the number of its coefficients.
std::vector<double> polynomial(const Document& document, size_t part) {
  std::vector<double> values = numbers(document, part, 0);
  if (values.front() != static_cast<double>(values.size() - 1)) {
    document.place(document.lines[part].number, parts[part])
        .fail("says {} coefficients and has {}", values.front(), values.size() - 1);
  }
  values.erase(values.begin());
  return values;
}

Camera read_camera(const Document& document) {
  if (document.lines.size() != parts.size()) {
    document.place().fail("has {} lines with numbers; {} are expected: {}", document.lines.size(), parts.size(),
                          fmt::join(parts, ", "));
  }
  std::vector<double> coefficients = polynomial(document, 0);
  polynomial(document, 1);
  const std::vector<double> centre = numbers(document, 2, 2), affine = numbers(document, 3, 3);
  const Place place = document.place(document.lines[0].number, parts[0]);
  if (coefficients.empty() || coefficients.size() > 7) {
    place.fail("has {} coefficients; 1 to 7 are accepted", coefficients.size());
  }
  coefficients.resize(7, 0.0);
  coefficients.insert(coefficients.end(), affine.begin(), affine.end());
  const Place size_place = document.place(document.lines[4].number, parts[4]);
  const std::vector<double> size = numbers(document, 4, 2);
  return to_camera(place, {.model = "ocam",
                           .size = image_size(size_place, size[1], size[0]),
                           .centre = glm::dvec2(centre[1], centre[0]) + centre_of_first_pixel,
                           .parameters = coefficients});
}

std::vector<CameraFile::Entry> read(const std::shared_ptr<const Document>& document) {
  return {{"camera", [document] { return read_camera(*document); }}};
}

}  // namespace

const CameraFormat ocamcalib_format = {
    .name = "ocamcalib",
    .what = "OCamCalib calib_results.txt (Scaramuzza)",
    .recognised = "five lines of numbers",
    .models = "the polynomial from radius to ray, up to a6, with c, d, e",
    .convention = "first pixel's centre at (0, 0); row before column; radius in pixels to ray; height before width",
    .recognises = recognises,
    .read = read,
};

}  // namespace omma
