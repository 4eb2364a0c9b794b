// How long each stage of a frame took.
#pragma once

#include <epoxy/gl.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "omma/gl/objects.h"

namespace omma::gl {

/// Milliseconds by name, in order of first mention.
using StageTimes = std::vector<std::pair<std::string, double>>;

/// Marks moments; the stage named at one mark lasts until the next. On a GPU the moments are those of its own clock. A
/// software rasterizer puts work off until somebody waits for it, which makes its timestamps meaningless: there every
/// mark waits and reads this machine's clock.
class StageTimer {
 public:
  explicit StageTimer(bool software) : software_(software) {}

  void mark(std::string name) {
    Mark mark{std::move(name), {}, {}};
    if (software_) {
      glFinish();
      mark.time = std::chrono::steady_clock::now();
    } else {
      mark.query = create_query();
      glQueryCounter(mark.query.id(), GL_TIMESTAMP);
    }
    marks_.push_back(std::move(mark));
  }

  /// Ends the last stage, waits, and starts anew. Stages of one name are added up.
  StageTimes finish() {
    mark("");
    StageTimes stages;
    for (size_t i = 0; i + 1 < marks_.size(); ++i) {
      if (!marks_[i].name.empty()) add(stages, marks_[i].name, milliseconds(marks_[i], marks_[i + 1]));
    }
    marks_.clear();
    return stages;
  }

 private:
  struct Mark {
    std::string name;
    Query query;
    std::chrono::steady_clock::time_point time;
  };

  double milliseconds(const Mark& begin, const Mark& end) const {
    if (software_) return std::chrono::duration<double, std::milli>(end.time - begin.time).count();
    GLuint64 first = 0, last = 0;
    glGetQueryObjectui64v(begin.query.id(), GL_QUERY_RESULT, &first);
    glGetQueryObjectui64v(end.query.id(), GL_QUERY_RESULT, &last);
    return double(last - first) * 1e-6;
  }

  static void add(StageTimes& stages, const std::string& name, double ms) {
    for (auto& stage : stages) {
      if (stage.first == name) {
        stage.second += ms;
        return;
      }
    }
    stages.emplace_back(name, ms);
  }

  bool software_;
  std::vector<Mark> marks_;
};

}  // namespace omma::gl
