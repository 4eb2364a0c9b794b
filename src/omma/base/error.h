// How Omma reports what went wrong.
//
// A message says what, where (file, line, key), why, and what would be accepted. The kind of an error is the exit
// code of the tool: the command was wrong, the input was wrong, or this machine cannot do it.
#pragma once

#include <fmt/core.h>

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

namespace omma {

enum class ErrorKind { command = 2, input = 3, machine = 4 };

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  Error(ErrorKind kind, fmt::string_view format, fmt::format_args values);
  ErrorKind kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_); }

 private:
  ErrorKind kind_;
};

/// The caller asked for something that does not exist or makes no sense: an unknown name, a value out of range.
struct CommandError : Error {
  template <typename... Args>
  explicit CommandError(fmt::format_string<Args...> format, Args&&... args)
      : Error(ErrorKind::command, format, fmt::make_format_args(args...)) {}
};

/// A file holds something that cannot be used.
struct InputError : Error {
  template <typename... Args>
  explicit InputError(fmt::format_string<Args...> format, Args&&... args)
      : Error(ErrorKind::input, format, fmt::make_format_args(args...)) {}
};

/// The request is sound, but this machine lacks something for it: a driver, a feature, memory, disk space.
struct MachineError : Error {
  template <typename... Args>
  explicit MachineError(fmt::format_string<Args...> format, Args&&... args)
      : Error(ErrorKind::machine, format, fmt::make_format_args(args...)) {}
};

/// Nothing went wrong: the caller asked for the work to stop (RenderOptions::stop).
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// Says something without stopping: a texture that is missing, vertices that were dropped. On standard error, unless
/// there is a sink.
void warn(const std::string& message);

/// Where warnings of all threads go from now on, one call at a time; nothing: to standard error again.
void set_warning_sink(std::function<void(const std::string& message)> sink);

}  // namespace omma
