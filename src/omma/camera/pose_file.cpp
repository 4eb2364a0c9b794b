#include "omma/camera/pose_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string_view>

#include "omma/base/error.h"
#include "omma/base/file.h"

namespace omma {
namespace {

constexpr size_t tum_fields = 8;     // time, position, quaternion
constexpr size_t colmap_fields = 9;  // id, quaternion, translation, camera; then the name

struct Line {
  std::string_view text;
  size_t number = 0;
};

constexpr std::string_view blanks = " \t\v\f\r";

/// Calls `visit` for each word.
template <typename Visit>
void for_each_word(std::string_view text, const Visit& visit) {
  for (size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    visit(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  for_each_word(text, [&](std::string_view word) { result.emplace_back(word); });
  return result;
}

std::optional<double> number(std::string_view word) {
  double value = 0.0;
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return {};
  return value;
}

class PoseReader {
 public:
  PoseReader(const std::filesystem::path& path, const Limits& limits)
      : path_(path.string()), text_(read_file(path, limits)), limits_(limits) {
    next();
  }

  std::vector<NamedPose> read() {
    skip_blank();
    if (at_end_) throw InputError("{}: holds no pose", path_);
    const size_t fields = pose_words().size();
    if (fields != tum_fields && fields <= colmap_fields) {
      fail(line_, fmt::format("{} fields; a TUM trajectory has the 8 fields 'time tx ty tz qx qy qz qw', COLMAP's "
                              "images.txt the 10 fields 'id qw qx qy qz tx ty tz camera name'",
                              fields));
    }
    std::vector<NamedPose> poses;
    for (; !at_end_; skip_blank()) {
      if (poses.size() == limits_.poses) {
        fail(line_, fmt::format("more than {} poses: {}", limits_.poses, limit_text(limits_, &Limits::poses)));
      }
      poses.push_back(fields == tum_fields ? read_tum(line_) : read_colmap(line_));
      next();
      if (fields != tum_fields) skip_points();
    }
    return poses;
  }

 private:
  [[noreturn]] void fail(const Line& line, const std::string& why) const {
    throw InputError("{}:{}: {}", path_, line.number, why);
  }

  /// The next line that is no comment.
  void next() {
    do {
      at_end_ = begin_ >= text_.size();
      if (at_end_) return;
      const size_t end = std::min(text_.find('\n', begin_), text_.size());
      line_ = {std::string_view(text_).substr(begin_, end - begin_), line_.number + 1};
      begin_ = end + 1;
    } while (line_.text.starts_with('#'));
  }

  void skip_blank() {
    while (!at_end_ && line_.text.find_first_not_of(blanks) == std::string_view::npos) next();
  }

  /// The words of a line that should be a pose.
  std::vector<std::string> pose_words() const {
    constexpr size_t longest = 65536;
    if (line_.text.size() > longest) {
      fail(line_, fmt::format("has {} characters, {} are accepted", line_.text.size(), longest));
    }
    return words(line_.text);
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
    const std::vector<std::string> all = pose_words();
    if (all.size() != tum_fields) {
      fail(line, fmt::format("{} fields, the 8 fields 'time tx ty tz qx qy qz qw' are expected", all.size()));
    }
    const std::vector<double> v = numbers(line, all, tum_fields);
    return {.name = all[0],
            .worldFromCamera = worldFromCamera(rotation(line, v[7], v[4], v[5], v[6]), {v[1], v[2], v[3]}),
            .time = v[0]};
  }

  NamedPose read_colmap(const Line& line) const {
    const std::vector<std::string> all = pose_words();
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
    if (at_end_) return;
    size_t count = 0;
    std::string_view last;
    for_each_word(line_.text, [&](std::string_view word) {
      ++count;
      last = word;
    });
    if (count % 3 != 0 || (count > 0 && !number(last))) {
      fail(line_, "the points 'x y point …' of the image above are expected, or an empty line");
    }
    next();
  }

  std::string path_;
  std::string text_;
  const Limits& limits_;
  size_t begin_ = 0;  ///< of the line after this one
  Line line_;
  bool at_end_ = false;
};

}  // namespace

std::vector<NamedPose> load_poses(const std::filesystem::path& path, const Limits& limits) {
  return PoseReader(path, limits).read();
}

}  // namespace omma
