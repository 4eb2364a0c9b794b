#include "omma/camera/pose_file.h"

#include <charconv>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

#include "omma/base/error.h"
#include "omma/base/file.h"

namespace omma {
namespace {

constexpr size_t tum_fields = 8;     // time, position, quaternion
constexpr size_t colmap_fields = 9;  // id, quaternion, translation, camera; then the name

struct Line {
  std::string text;
  size_t number = 0;
};

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

std::optional<double> number(const std::string& word) {
  double value = 0.0;
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return {};
  return value;
}

class PoseReader {
 public:
  explicit PoseReader(const std::filesystem::path& path) : path_(path.string()) {
    std::istringstream stream(read_file(path));
    size_t line_number = 0;
    for (std::string text; std::getline(stream, text);) {
      ++line_number;
      if (text.ends_with('\r')) text.pop_back();
      if (!text.starts_with('#')) lines_.push_back({text, line_number});
    }
  }

  std::vector<NamedPose> read() {
    skip_blank();
    if (at_ == lines_.size()) throw InputError("{}: holds no pose", path_);
    const size_t fields = words(lines_[at_].text).size();
    if (fields != tum_fields && fields <= colmap_fields) {
      fail(lines_[at_],
           fmt::format("{} fields; a TUM trajectory has the 8 fields 'time tx ty tz qx qy qz qw', COLMAP's "
                       "images.txt the 10 fields 'id qw qx qy qz tx ty tz camera name'",
                       fields));
    }
    std::vector<NamedPose> poses;
    for (; at_ < lines_.size(); skip_blank()) {
      poses.push_back(fields == tum_fields ? read_tum(lines_[at_]) : read_colmap(lines_[at_]));
      ++at_;
      if (fields != tum_fields) skip_points();
    }
    return poses;
  }

 private:
  [[noreturn]] void fail(const Line& line, const std::string& why) const {
    throw InputError("{}:{}: {}", path_, line.number, why);
  }

  void skip_blank() {
    while (at_ < lines_.size() && words(lines_[at_].text).empty()) ++at_;
  }

  // The first `count` words as numbers.
  std::vector<double> numbers(const Line& line, const std::vector<std::string>& all, size_t count) const {
    std::vector<double> values;
    for (size_t i = 0; i < count; ++i) {
      const auto value = number(all[i]);
      if (!value) fail(line, fmt::format("field {} is '{}', a finite number is expected", i + 1, all[i]));
      values.push_back(*value);
    }
    return values;
  }

  glm::dmat3 rotation(const Line& line, double w, double x, double y, double z) const {
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    if (!(std::abs(length - 1.0) <= 0.01)) {
      fail(line, fmt::format("the quaternion has length {:.6g}, 1 is expected", length));
    }
    return glm::mat3_cast(glm::normalize(glm::dquat(w, x, y, z)));
  }

  // A camera of the optical frame, turned into Omma's.
  static glm::dmat4 worldFromCamera(const glm::dmat3& worldFromOptical, const glm::dvec3& position) {
    return {glm::dvec4(worldFromOptical[0], 0.0), glm::dvec4(-worldFromOptical[1], 0.0),
            glm::dvec4(-worldFromOptical[2], 0.0), glm::dvec4(position, 1.0)};
  }

  NamedPose read_tum(const Line& line) const {
    const std::vector<std::string> all = words(line.text);
    if (all.size() != tum_fields) {
      fail(line, fmt::format("{} fields, the 8 fields 'time tx ty tz qx qy qz qw' are expected", all.size()));
    }
    const std::vector<double> v = numbers(line, all, tum_fields);
    return {.name = all[0],
            .worldFromCamera = worldFromCamera(rotation(line, v[7], v[4], v[5], v[6]), {v[1], v[2], v[3]}),
            .time = v[0]};
  }

  NamedPose read_colmap(const Line& line) const {
    const std::vector<std::string> all = words(line.text);
    if (all.size() <= colmap_fields) {
      fail(line, fmt::format("{} fields, the 10 fields 'id qw qx qy qz tx ty tz camera name' are expected; each image "
                             "takes two lines, the second one, its points, may be empty",
                             all.size()));
    }
    const std::vector<double> v = numbers(line, all, colmap_fields);
    const glm::dmat3 worldFromOptical = glm::transpose(rotation(line, v[1], v[2], v[3], v[4]));
    std::string name = all[colmap_fields];
    for (size_t i = colmap_fields + 1; i < all.size(); ++i) name += ' ' + all[i];
    return {.name = name,
            .worldFromCamera = worldFromCamera(worldFromOptical, -(worldFromOptical * glm::dvec3(v[5], v[6], v[7]))),
            .time = {}};
  }

  // The line after an image's own: `x y point` again and again, or nothing.
  void skip_points() {
    if (at_ == lines_.size()) return;
    const std::vector<std::string> all = words(lines_[at_].text);
    if (all.size() % 3 != 0 || (!all.empty() && !number(all.back()))) {
      fail(lines_[at_], "the points 'x y point …' of the image above are expected, or an empty line");
    }
    ++at_;
  }

  std::string path_;
  std::vector<Line> lines_;
  size_t at_ = 0;
};

}  // namespace

std::vector<NamedPose> load_poses(const std::filesystem::path& path) { return PoseReader(path).read(); }

}  // namespace omma
