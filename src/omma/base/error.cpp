#include "omma/base/error.h"

#include <cstdio>
#include <mutex>
#include <utility>

namespace omma {

Error::Error(ErrorKind kind, fmt::string_view format, fmt::format_args values)
    : Error(kind, fmt::vformat(format, values)) {}

namespace {

std::recursive_mutex sink_mutex;  // a sink may warn
std::function<void(const std::string&)> warning_sink;

}  // namespace

void warn(const std::string& message) {
  const std::lock_guard lock(sink_mutex);
  if (warning_sink) return warning_sink(message);
  fmt::print(stderr, "warning: {}\n", message);
}

void set_warning_sink(std::function<void(const std::string&)> sink) {
  const std::lock_guard lock(sink_mutex);
  warning_sink = std::move(sink);
}

}  // namespace omma
