#include "progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace omma::tool {
namespace {

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

Progress::Progress(std::string_view unit, int total)
    : unit_(unit), total_(total), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_ && done_ > 0) fmt::print(stderr, "\n");
}

void Progress::step() {
  ++done_;
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const double rate = done_ / std::max(seconds, 1e-9);
  const double seconds_left = (total_ - done_) / rate;
  if (terminal_) {
    draw_bar(rate, seconds_left);
    return;
  }
  const double since = std::chrono::duration<double>(now - said_).count();
  if (done_ < total_ && since < 5.0 && (done_ - said_done_) * 10 < total_) return;
  said_ = now;
  said_done_ = done_;
  fmt::print(stderr, "{} of {} {}, {:.2f} {}/s, {} left\n", done_, total_, unit_, rate, unit_,
             duration_text(seconds_left));
}

void Progress::draw_bar(double rate, double seconds_left) const {
  constexpr int width = 30;
  const int filled = int(int64_t{width} * done_ / total_);
  const std::string line = fmt::format("[{:#<{}}{:.<{}}] {} of {} {}, {:.2f} {}/s, {} left", "", filled, "",
                                       width - filled, done_, total_, unit_, rate, unit_, duration_text(seconds_left));
  fmt::print(stderr, "\r{}\x1b[K", line);  // and nothing of a longer line before it
  std::fflush(stderr);
}

}  // namespace omma::tool
