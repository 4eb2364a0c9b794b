#include <iterator>
#include <nlohmann/json.hpp>

#include "omma/camera/files/parse.h"

namespace omma {
namespace {

// The line of the last character that belongs to a token: the parser reads one character beyond a number.
struct LineCounter {
  int line = 1;
  bool newline_read = false;

  void read(char c) {
    if (newline_read) ++line;
    newline_read = c == '\n';
  }
};

// nlohmann's parser tells no lines, so its characters are counted as it takes them.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, LineCounter* counter) : at_(at), counter_(counter) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    counter_->read(*at_++);
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  LineCounter* counter_;
};

class Handler : public nlohmann::json_sax<nlohmann::json> {
 public:
  Handler(TreeBuilder& tree, const LineCounter& counter) : tree_(tree), counter_(counter) {}

  bool null() override {
    tree_.null(line());
    return true;
  }
  bool boolean(bool value) override { return number_text(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return number_text(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number_text(std::to_string(value)); }
  bool number_float(number_float_t, const string_t& text) override { return number_text(text); }
  bool string(string_t& text) override {
    tree_.scalar(text, true, line());
    return true;
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override {
    tree_.begin_map(line());
    return true;
  }
  bool key(string_t& text) override { return string(text); }
  bool end_object() override {
    tree_.end();
    return true;
  }
  bool start_array(std::size_t) override {
    tree_.begin_list(line());
    return true;
  }
  bool end_array() override { return end_object(); }
  bool parse_error(std::size_t, const std::string& last_token, const nlohmann::json::exception&) override {
    tree_.fail(line(), last_token.empty() || last_token == "<U+0000>"
                           ? std::string("is no JSON: it ends too early")
                           : fmt::format("is no JSON: not expected here: {}", last_token.substr(0, 40)));
  }

 private:
  int line() const { return counter_.line; }
  bool number_text(std::string text) {
    tree_.scalar(std::move(text), false, line());
    return true;
  }

  TreeBuilder& tree_;
  const LineCounter& counter_;
};

}  // namespace

Value parse_json(const Place& file, std::string_view text, const Limits& limits) {
  TreeBuilder tree(file, limits);
  LineCounter counter;
  Handler handler(tree, counter);
  const CountingIterator begin(text.data(), &counter), end(text.data() + text.size(), &counter);
  nlohmann::json::sax_parse(begin, end, &handler);
  return tree.take();
}

}  // namespace omma
