// Texts to trees. Each throws InputError with the line for what is not well-formed, nested too deeply, or has a key
// twice.
#pragma once

#include <string_view>

#include "omma/camera/files/document.h"

namespace omma {

Value parse_json(const Place& file, std::string_view text);
/// Also OpenCV's `%YAML:1.0`, which is no YAML.
Value parse_yaml(const Place& file, std::string_view text);
/// Elements as members, which may repeat; attributes as members named `@attribute`.
Value parse_xml(const Place& file, std::string_view text);

/// Builds a tree from what a parser meets. In a map every second value is a key.
class TreeBuilder {
 public:
  explicit TreeBuilder(Place file, bool repeated_keys = false)
      : place_(std::move(file)), repeated_keys_(repeated_keys) {}

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
  bool repeated_keys_;
  Value root_;
  std::vector<Open> open_;
  bool done_ = false;
};

/// Deeper trees are refused: parsers and readers recurse.
inline constexpr size_t max_tree_depth = 32;

}  // namespace omma
