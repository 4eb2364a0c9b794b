// Recursive descent into the steps of a stack machine.
#include "omma/camera/deformation/expression.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

#include "omma/base/error.h"
#include "omma/base/names.h"

namespace omma {
namespace {

using Function = Expression::Function;

constexpr size_t max_length = 10000;
constexpr int max_nesting = 100;
constexpr int max_stack = 400;  // what max_nesting can need: each level holds three arguments at most

constexpr Function operators[] = {
    {"+", 2, [](const double* a) { return a[0] + a[1]; }},
    {"-", 2, [](const double* a) { return a[0] - a[1]; }},
    {"*", 2, [](const double* a) { return a[0] * a[1]; }},
    {"/", 2, [](const double* a) { return a[0] / a[1]; }},
    {"^", 2, [](const double* a) { return std::pow(a[0], a[1]); }},
    {"<=", 2, [](const double* a) { return a[0] <= a[1] ? 1.0 : 0.0; }},
    {">=", 2, [](const double* a) { return a[0] >= a[1] ? 1.0 : 0.0; }},
    {"==", 2, [](const double* a) { return a[0] == a[1] ? 1.0 : 0.0; }},
    {"<", 2, [](const double* a) { return a[0] < a[1] ? 1.0 : 0.0; }},
    {">", 2, [](const double* a) { return a[0] > a[1] ? 1.0 : 0.0; }},
};

constexpr Function negation = {"-", 1, [](const double* a) { return -a[0]; }};

constexpr Function functions[] = {
    {"sin", 1, [](const double* a) { return std::sin(a[0]); }},
    {"cos", 1, [](const double* a) { return std::cos(a[0]); }},
    {"tan", 1, [](const double* a) { return std::tan(a[0]); }},
    {"asin", 1, [](const double* a) { return std::asin(a[0]); }},
    {"acos", 1, [](const double* a) { return std::acos(a[0]); }},
    {"atan", 1, [](const double* a) { return std::atan(a[0]); }},
    {"atan2", 2, [](const double* a) { return std::atan2(a[0], a[1]); }},
    {"sqrt", 1, [](const double* a) { return std::sqrt(a[0]); }},
    {"abs", 1, [](const double* a) { return std::abs(a[0]); }},
    {"exp", 1, [](const double* a) { return std::exp(a[0]); }},
    {"log", 1, [](const double* a) { return std::log(a[0]); }},
    {"min", 2, [](const double* a) { return a[1] < a[0] ? a[1] : a[0]; }},
    {"max", 2, [](const double* a) { return a[1] > a[0] ? a[1] : a[0]; }},
    {"pow", 2, [](const double* a) { return std::pow(a[0], a[1]); }},
    {"floor", 1, [](const double* a) { return std::floor(a[0]); }},
    {"sign", 1, [](const double* a) { return static_cast<double>((a[0] > 0.0) - (a[0] < 0.0)); }},
    {"if", 3, [](const double* a) { return a[0] != 0.0 ? a[1] : a[2]; }},
};

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

class ExpressionParser {
 public:
  ExpressionParser(std::string_view what, std::string_view text, std::span<const std::string> variables,
                   std::vector<Expression::Step>& steps)
      : what_(what), text_(text), variables_(variables), steps_(steps) {
    if (text.size() > max_length) fail("the formula has {} characters, {} are accepted", text.size(), max_length);
    comparison();
    if (position_ < text_.size()) {
      fail("'{}' is not expected here; an operator or the formula's end is", text_[position_]);
    }
  }

 private:
  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    throw CommandError("{}: column {} of '{}': {}", what_, position_ + 1, text_.substr(0, 80),
                       fmt::format(format, std::forward<Args>(args)...));
  }

  void skip_spaces() {
    while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\t')) ++position_;
  }

  bool take(std::string_view token) {
    skip_spaces();
    if (!text_.substr(position_).starts_with(token)) return false;
    position_ += token.size();
    return true;
  }

  // The operator of these that comes next.
  const Function* take_operator(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
      if (take(name)) return std::ranges::find(operators, name, &Function::name);
    }
    return nullptr;
  }

  void call(const Function& function) { steps_.push_back({.function = &function}); }

  void comparison() {
    if (++nesting_ > max_nesting) fail("nested more than {} deep", max_nesting);
    sum();
    if (const Function* function = take_operator({"<=", ">=", "==", "<", ">"})) {
      sum();
      call(*function);
    }
    skip_spaces();
    --nesting_;
  }

  void sum() {
    product();
    while (const Function* function = take_operator({"+", "-"})) {
      product();
      call(*function);
    }
  }

  void product() {
    signed_power();
    while (const Function* function = take_operator({"*", "/"})) {
      signed_power();
      call(*function);
    }
  }

  void signed_power() {
    bool negative = false;
    while (true) {
      if (take("-")) {
        negative = !negative;
      } else if (!take("+")) {
        break;
      }
    }
    if (++nesting_ > max_nesting) fail("nested more than {} deep", max_nesting);
    primary();
    if (const Function* function = take_operator({"^"})) {
      signed_power();
      call(*function);
    }
    --nesting_;
    if (negative) call(negation);
  }

  void primary() {
    if (take("(")) {
      comparison();
      if (!take(")")) fail("')' is missing");
      return;
    }
    skip_spaces();
    if (position_ == text_.size()) fail("the formula ends where a number, a name or '(' is expected");
    if (begins_name(text_[position_])) return named();
    double number = 0.0;
    const char* begin = text_.data() + position_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), number);
    if (error != std::errc{}) fail("'{}' is not expected here; a number, a name or '(' is", text_[position_]);
    steps_.push_back({.number = number});
    position_ += static_cast<size_t>(end - begin);
  }

  void named() {
    const size_t begin = position_;
    size_t end = begin;
    while (end < text_.size() && (begins_name(text_[end]) || (text_[end] >= '0' && text_[end] <= '9'))) ++end;
    const std::string name(text_.substr(begin, end - begin));
    const auto* function = std::ranges::find(functions, name, &Function::name);
    const auto variable = std::ranges::find(variables_, name);
    if (function != std::end(functions)) {
      position_ = end;
      arguments(*function);
    } else if (variable != variables_.end()) {
      steps_.push_back({.variable = static_cast<int>(variable - variables_.begin())});
    } else if (name == "pi" || name == "e") {
      steps_.push_back({.number = name == "pi" ? std::numbers::pi : std::numbers::e});
    } else {
      std::vector<std::string> known(variables_.begin(), variables_.end());
      known.insert(known.end(), {"pi", "e"});
      for (const Function& candidate : functions) known.emplace_back(candidate.name);
      fail("{}", unknown_name("name", name, known));
    }
    position_ = std::max(position_, end);
  }

  void arguments(const Function& function) {
    if (!take("("))
      fail("'(' and {} of {} are expected", function.arity == 1 ? "the argument" : "arguments", function.name);
    for (int i = 0; i < function.arity; ++i) {
      if (i > 0 && !take(",")) fail("',' is expected: {} takes {} arguments", function.name, function.arity);
      comparison();
    }
    if (!take(")"))
      fail("')' is expected: {} takes {} argument{}", function.name, function.arity, function.arity == 1 ? "" : "s");
    call(function);
  }

  std::string_view what_, text_;
  std::span<const std::string> variables_;
  std::vector<Expression::Step>& steps_;
  size_t position_ = 0;
  int nesting_ = 0;
};

Expression::Expression(std::string_view what, std::string_view text, std::span<const std::string> variables) {
  ExpressionParser(what, text, variables, steps_);
}

double Expression::operator()(std::span<const double> values) const {
  std::array<double, max_stack> stack;
  double* top = stack.data();
  for (const Step& step : steps_) {
    if (step.function) {
      top -= step.function->arity;
      *top = step.function->call(top);
    } else {
      *top = step.variable >= 0 ? values[static_cast<size_t>(step.variable)] : step.number;
    }
    ++top;
  }
  return stack[0];
}

}  // namespace omma
