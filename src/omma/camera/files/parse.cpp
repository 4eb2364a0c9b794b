#include "omma/camera/files/parse.h"

#include <algorithm>

namespace omma {

void ValueCounter::fail(int line) {
  place_.line = line;
  place_.fail("more than {} values and keys: {}", limits_.document_values,
              limit_text(limits_, &Limits::document_values));
}

void TreeBuilder::fail(int line, const std::string& message) const {
  Place place = place_;
  place.line = line;
  place.fail_with(message);
}

void TreeBuilder::open(Value::Kind kind, int line, std::string tag) {
  values_.add(line);
  if (open_.size() >= limits_.document_depth) {
    fail(line, fmt::format("is nested more than {} levels deep: {}", limits_.document_depth,
                           limit_text(limits_, &Limits::document_depth)));
  }
  if (!open_.empty() && open_.back().value.kind == Value::Kind::map && !open_.back().has_key) {
    fail(line, "a key is expected to be a text");
  }
  Value value;
  value.kind = kind;
  value.line = line;
  value.tag = std::move(tag);
  open_.push_back({std::move(value), {}, false});
}

void TreeBuilder::begin_map(int line, std::string tag) { open(Value::Kind::map, line, std::move(tag)); }

void TreeBuilder::begin_list(int line, std::string tag) { open(Value::Kind::list, line, std::move(tag)); }

void TreeBuilder::end() {
  Value value = std::move(open_.back().value);
  if (!repeated_keys_) refuse_repeated_keys(value);
  open_.pop_back();
  add(std::move(value));
}

void TreeBuilder::refuse_repeated_keys(const Value& map) const {
  std::vector<std::pair<std::string_view, int>> keys;
  for (const auto& [name, value] : map.members) keys.emplace_back(name, value.line);
  std::ranges::sort(keys);
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  const auto twice = std::ranges::adjacent_find(keys, same);
  if (twice != keys.end()) fail(std::next(twice)->second, fmt::format("the key '{}' is there twice", twice->first));
}

void TreeBuilder::null(int line) {
  values_.add(line);
  Value value;
  value.line = line;
  add(std::move(value));
}

void TreeBuilder::scalar(std::string text, bool quoted, int line) {
  values_.add(line);
  Value value;
  value.kind = Value::Kind::scalar;
  value.text = std::move(text);
  value.quoted = quoted;
  value.line = line;
  add(std::move(value));
}

void TreeBuilder::add(Value value) {
  if (open_.empty()) {
    root_ = std::move(value);
    done_ = true;
    return;
  }
  Open& parent = open_.back();
  if (parent.value.kind == Value::Kind::list) {
    parent.value.items.push_back(std::move(value));
    return;
  }
  if (!parent.has_key) {
    if (value.kind != Value::Kind::scalar) fail(value.line, "a key is expected to be a text");
    parent.key = std::move(value.text);
    parent.has_key = true;
    return;
  }
  parent.has_key = false;
  parent.value.members.push_back({std::move(parent.key), std::move(value)});
}

}  // namespace omma
