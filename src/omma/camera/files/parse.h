// Texts to trees. Each throws InputError with the line for what is not well-formed, beyond the limits, or has a key
// twice.
#pragma once

#include <string_view>

#include "omma/camera/files/document.h"

namespace omma {

Value parse_json(const Place& file, std::string_view text, const Limits& limits);
/// Also OpenCV's `%YAML:1.0`, which is no YAML.
Value parse_yaml(const Place& file, std::string_view text, const Limits& limits);
/// Elements as members, which may repeat; attributes as members named `@attribute`.
Value parse_xml(const Place& file, std::string_view text, const Limits& limits);

/// Counts what a text holds while it is parsed, and fails where it is too much.
class ValueCounter {
 public:
  ValueCounter(Place file, const Limits& limits) : place_(std::move(file)), limits_(limits) {}

  void add(int line) {
    if (++count_ > limits_.document_values) fail(line);
  }

 private:
  [[noreturn]] void fail(int line);

  Place place_;
  const Limits& limits_;
  size_t count_ = 0;
};

/// Builds a tree from what a parser meets. In a map every second value is a key.
class TreeBuilder {
 public:
  TreeBuilder(const Place& file, const Limits& limits, bool repeated_keys = false)
      : place_(file), limits_(limits), values_(file, limits), repeated_keys_(repeated_keys) {}

  void begin_map(int line, std::string tag = {});
  void begin_list(int line, std::string tag = {});
  void end();
  void null(int line);
  void scalar(std::string text, bool quoted, int line);
  [[noreturn]] void fail(int line, const std::string& message) const;

  bool empty() const { return !done_ && open_.empty(); }
  Value take() { return std::move(root_); }

 private:
  struct Open {
    Value value;
    std::string key;
    bool has_key = false;
  };
  void open(Value::Kind kind, int line, std::string tag);
  void add(Value value);
  void refuse_repeated_keys(const Value& map) const;

  Place place_;
  const Limits& limits_;
  ValueCounter values_;
  bool repeated_keys_;
  Value root_;
  std::vector<Open> open_;
  bool done_ = false;
};

}  // namespace omma
