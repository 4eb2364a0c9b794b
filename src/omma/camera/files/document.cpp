#include "omma/camera/files/document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "omma/base/names.h"
#include "omma/camera/files/parse.h"

namespace omma {
namespace {

// What a message quotes of a file's content.
std::string in_quotes(std::string_view text) {
  constexpr size_t longest = 40;
  std::string shown;
  for (const char c : text.substr(0, longest)) shown += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  return fmt::format("'{}{}'", shown, text.size() > longest ? "…" : "");
}

std::vector<Line> parse_lines(const Place& file, std::string_view text, const Limits& limits) {
  std::vector<Line> lines;
  ValueCounter values(file, limits);
  std::istringstream stream{std::string(text)};
  std::string raw;
  for (int number = 1; std::getline(stream, raw); ++number) {
    Line line{number, {}};
    std::istringstream words(raw.substr(0, raw.find('#')));
    for (std::string word; words >> word;) {
      values.add(number);
      line.words.push_back(word);
    }
    if (!line.words.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

// The first character that is neither white space nor within a comment; 0 when there is none.
char first_character(std::string_view text) {
  bool comment = false;
  for (const char c : text) {
    if (c == '\n') comment = false;
    if (comment || std::isspace(static_cast<unsigned char>(c))) continue;
    if (c != '#') return c;
    comment = true;
  }
  return 0;
}

Syntax syntax_of(char first) {
  if (first == '{' || first == '[') return Syntax::json;
  if (first == '<') return Syntax::xml;
  const bool number = (first >= '0' && first <= '9') || first == '+';
  return number ? Syntax::lines : Syntax::yaml;
}

}  // namespace

void Place::fail_with(const std::string& message) const {
  std::string where = file;
  if (line > 0) where += fmt::format(":{}", line);
  if (!key.empty()) where += fmt::format(": {}", key);
  throw InputError("{}: {}", where, message);
}

Document parse_document(std::string file, std::string_view text, const Limits& limits) {
  Document document;
  document.file = std::move(file);
  const Place whole = document.place();
  if (text.size() > limits.document_bytes) {
    whole.fail("has {} bytes: {}", text.size(), limit_text(limits, &Limits::document_bytes));
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find('\0') != std::string_view::npos) whole.fail("is no text file: it has a zero byte");
  const char first = first_character(text);
  if (first == 0) whole.fail("holds nothing; a camera calibration is expected");
  document.syntax = syntax_of(first);
  switch (document.syntax) {
    case Syntax::json:
      document.root = parse_json(whole, text, limits);
      break;
    case Syntax::xml:
      document.root = parse_xml(whole, text, limits);
      break;
    case Syntax::yaml:
      document.root = parse_yaml(whole, text, limits);
      break;
    case Syntax::lines:
      document.lines = parse_lines(whole, text, limits);
      break;
  }
  return document;
}

double number_at(const Place& place, std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc::result_out_of_range) place.fail("{} is too large or too small for a number", in_quotes(text));
  if (error != std::errc() || end != digits.data() + digits.size()) place.fail("{} is not a number", in_quotes(text));
  if (!std::isfinite(number)) place.fail("{} is not a finite number", in_quotes(text));
  return number;
}

long integer_at(const Place& place, std::string_view text) {
  const double number = number_at(place, text);
  if (number != std::floor(number) || std::abs(number) > 2147483647.0) {
    place.fail("{} is not a whole number within 32 bits", in_quotes(text));
  }
  return static_cast<long>(number);
}

DocumentNode DocumentNode::child(const Value& value, const std::string& name) const {
  return {document_, &value, key_.empty() ? name : key_ + "." + name};
}

std::optional<DocumentNode> DocumentNode::find(std::string_view key) const {
  for (const auto& [name, value] : value_->members) {
    if (name == key) return child(value, name);
  }
  return {};
}

std::optional<DocumentNode> DocumentNode::find_any(std::initializer_list<const char*> keys) const {
  for (const char* key : keys) {
    if (std::optional<DocumentNode> found = find(key)) return found;
  }
  return {};
}

DocumentNode DocumentNode::at(std::string_view key) const {
  if (!is_map()) fail("a map with {} is expected", in_quotes(key));
  if (std::optional<DocumentNode> found = find(key)) return *found;
  std::vector<std::string> names;
  for (const auto& [name, value] : value_->members) names.push_back(name);
  const std::optional<std::string> nearest = nearest_name(key, names);
  fail("{} is missing{}", in_quotes(key), nearest ? fmt::format("; there is {}", in_quotes(*nearest)) : "");
}

std::vector<DocumentNode> DocumentNode::items() const {
  if (!is_list()) fail("a list is expected");
  std::vector<DocumentNode> nodes;
  for (size_t i = 0; i < value_->items.size(); ++i) {
    nodes.push_back({document_, &value_->items[i], fmt::format("{}[{}]", key_, i)});
  }
  return nodes;
}

std::vector<std::pair<std::string, DocumentNode>> DocumentNode::members() const {
  if (!is_map()) fail("a map is expected");
  std::vector<std::pair<std::string, DocumentNode>> nodes;
  for (const auto& [name, value] : value_->members) nodes.emplace_back(name, child(value, name));
  return nodes;
}

double DocumentNode::number() const {
  if (value_->kind != Value::Kind::scalar) fail("a number is expected");
  if (value_->quoted) fail("a number is expected, and {} is text in quotes", in_quotes(value_->text));
  return number_at(place(), value_->text);
}

long DocumentNode::integer() const {
  number();
  return integer_at(place(), value_->text);
}

bool DocumentNode::boolean() const {
  const std::string text = this->text();
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  fail("{} is neither true nor false", in_quotes(text));
}

std::string DocumentNode::text() const {
  if (value_->kind != Value::Kind::scalar) fail("a text is expected");
  return value_->text;
}

std::vector<double> DocumentNode::numbers() const {
  std::vector<double> numbers;
  if (is_list()) {
    for (const DocumentNode& item : items()) numbers.push_back(item.number());
    return numbers;
  }
  if (is_null()) return numbers;
  std::istringstream words(text());
  for (std::string word; words >> word;) numbers.push_back(number_at(place(), word));
  return numbers;
}

std::vector<double> DocumentNode::numbers(size_t count) const {
  std::vector<double> numbers = this->numbers();
  if (numbers.size() != count) fail("has {} numbers; {} are expected", numbers.size(), count);
  return numbers;
}

}  // namespace omma
