// How far a long work has come, on standard error: a bar on a terminal, now and then a line elsewhere.
#pragma once

#include <chrono>
#include <string_view>

namespace omma::tool {

class Progress {
 public:
  Progress(std::string_view unit, int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more is done.
  void step();

 private:
  using Clock = std::chrono::steady_clock;
  void draw_bar(double rate, double seconds_left) const;

  std::string_view unit_;
  int total_;
  int done_ = 0;
  bool terminal_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point said_ = begin_;
  int said_done_ = 0;
};

}  // namespace omma::tool
