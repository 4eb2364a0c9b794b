// What the rasterizer was given and what it made of it.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "omma/gl/objects.h"

namespace omma::gl {

struct Counts {
  uint64_t primitives = 0;            ///< that reached the rasterizer
  std::optional<uint64_t> fragments;  ///< shaded; nothing where the driver does not count them
  uint64_t samples = 0;               ///< that passed depth test and discard
};

/// Adds up over everything drawn between begin and end, however often.
class Counters {
 public:
  void begin() {
    const bool statistics = epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_pipeline_statistics_query");
    std::array<Query, 3>& queries = rounds_.emplace_back();
    for (size_t i = 0; i < targets.size(); ++i) {
      if (targets[i] == GL_FRAGMENT_SHADER_INVOCATIONS && !statistics) continue;
      queries[i] = create_query();
      glBeginQuery(targets[i], queries[i].id());
    }
  }

  void end() {
    for (size_t i = 0; i < targets.size(); ++i) {
      if (rounds_.back()[i]) glEndQuery(targets[i]);
    }
  }

  /// Waits for the results and starts anew.
  Counts finish() {
    Counts counts;
    for (const std::array<Query, 3>& queries : rounds_) {
      counts.primitives += result(queries[0]);
      if (queries[1]) counts.fragments = counts.fragments.value_or(0) + result(queries[1]);
      counts.samples += result(queries[2]);
    }
    rounds_.clear();
    return counts;
  }

 private:
  static constexpr std::array<GLenum, 3> targets{GL_PRIMITIVES_GENERATED, GL_FRAGMENT_SHADER_INVOCATIONS,
                                                 GL_SAMPLES_PASSED};

  static uint64_t result(const Query& query) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &value);
    return value;
  }

  std::vector<std::array<Query, 3>> rounds_;
};

}  // namespace omma::gl
