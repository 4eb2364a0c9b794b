// What a calibration file holds, before anyone says what it means: a tree of named values from YAML, JSON or XML, or
// lines of words. Every value knows its line, so that whoever finds it wrong can say where.
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "omma/base/error.h"
#include "omma/base/limits.h"

namespace omma {

/// Where something stands in a file.
struct Place {
  std::string file;
  int line = 0;     ///< from 1; 0: unknown
  std::string key;  ///< "cam0.intrinsics"; empty for the whole file

  /// Throws InputError: "file:line: key: message".
  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    fail_with(fmt::format(format, std::forward<Args>(args)...));
  }
  [[noreturn]] void fail_with(const std::string& message) const;
};

struct Member;

/// A node of the tree as it was parsed.
struct Value {
  enum class Kind { null, scalar, list, map } kind = Kind::null;
  std::string text;     ///< of a scalar
  bool quoted = false;  ///< text that is no number even if it looks like one
  std::string tag;      ///< YAML's tag or XML's type_id, without any prefix
  std::vector<Value> items;
  std::vector<Member> members;  ///< in the file's order
  int line = 0;
};

struct Member {
  std::string name;
  Value value;
};

/// A line of a plain text file, comments (#) removed, cut at white space; never empty.
struct Line {
  int number = 0;
  std::vector<std::string> words;
};

enum class Syntax { yaml, json, xml, lines };

struct Document {
  std::string file;
  Syntax syntax = Syntax::lines;
  Value root;               ///< of YAML, JSON and XML
  std::vector<Line> lines;  ///< of plain text

  Place place(int line = 0, std::string key = {}) const { return {file, line, std::move(key)}; }
};

/// Parses by content: { or [ begins JSON, < begins XML, a digit or a sign plain lines, anything else YAML. Throws
/// InputError when the text is none of them, is beyond the limits, or names a key twice. YAML's anchors are refused.
Document parse_document(std::string file, std::string_view text, const Limits& limits = {});

/// A value together with its place. Every function that finds something else than it asks for throws InputError.
class DocumentNode {
 public:
  explicit DocumentNode(std::shared_ptr<const Document> document) : DocumentNode(document, &document->root, {}) {}

  const Document& document() const { return *document_; }
  const Value& value() const { return *value_; }
  Place place() const { return document_->place(value_->line, key_); }
  const std::string& key() const { return key_; }

  bool is_map() const { return value_->kind == Value::Kind::map; }
  bool is_list() const { return value_->kind == Value::Kind::list; }
  bool is_null() const { return value_->kind == Value::Kind::null; }

  /// A member of a map; nothing when this is no map or has no such member.
  std::optional<DocumentNode> find(std::string_view key) const;
  /// The first of these members that is there.
  std::optional<DocumentNode> find_any(std::initializer_list<const char*> keys) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  DocumentNode at(std::string_view key) const;

  std::vector<DocumentNode> items() const;
  std::vector<std::pair<std::string, DocumentNode>> members() const;

  double number() const;
  long integer() const;  ///< also written as 640.0
  bool boolean() const;  ///< true or false, 1 or 0
  std::string text() const;
  /// The numbers of a list, or those in a text with white space between them.
  std::vector<double> numbers() const;
  std::vector<double> numbers(size_t count) const;

  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    place().fail_with(fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  DocumentNode(std::shared_ptr<const Document> document, const Value* value, std::string key)
      : document_(std::move(document)), value_(value), key_(std::move(key)) {}

  DocumentNode child(const Value& value, const std::string& name) const;

  std::shared_ptr<const Document> document_;
  const Value* value_;
  std::string key_;
};

/// The whole of `text` as a finite number; fails at `place` otherwise.
double number_at(const Place& place, std::string_view text);

/// The whole of `text` as a whole number that an int holds; fails at `place` otherwise.
long integer_at(const Place& place, std::string_view text);

}  // namespace omma
