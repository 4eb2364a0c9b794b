// How long the GPU took for each stage of a frame.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <utility>
#include <vector>

#include "omma/gl/objects.h"

namespace omma::gl {

/// Marks moments in the GPU's own time; the stage named at one mark lasts until the next.
class StageTimer {
 public:
  /// Starts a stage; an empty name ends the last one.
  void mark(std::string name) {
    marks_.emplace_back(std::move(name), create_query(GL_TIMESTAMP));
    glQueryCounter(marks_.back().second.id(), GL_TIMESTAMP);
  }

  /// Waits for the GPU. Milliseconds of each stage, stages of one name added up, in order of their first mark.
  std::vector<std::pair<std::string, double>> finish() {
    mark("");
    std::vector<std::pair<std::string, double>> stages;
    GLuint64 previous = 0;
    for (size_t i = 0; i < marks_.size(); ++i) {
      GLuint64 now = 0;
      glGetQueryObjectui64v(marks_[i].second.id(), GL_QUERY_RESULT, &now);
      if (i > 0 && !marks_[i - 1].first.empty()) add(stages, marks_[i - 1].first, double(now - previous) * 1e-6);
      previous = now;
    }
    marks_.clear();
    return stages;
  }

  static void add(std::vector<std::pair<std::string, double>>& stages, const std::string& name, double ms) {
    for (auto& stage : stages) {
      if (stage.first == name) {
        stage.second += ms;
        return;
      }
    }
    stages.emplace_back(name, ms);
  }

 private:
  std::vector<std::pair<std::string, Query>> marks_;
};

}  // namespace omma::gl
