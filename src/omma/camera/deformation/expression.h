// Formulae that people type: `2*sin(theta/2)`, `if(abs(u)<0.5, u, 2*u-0.5)`.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace omma {

/// Numbers, the constants pi and e, the variables given, + - * / ^ (to the right first, before a sign), < > <= >= ==
/// (1 or 0), parentheses, and the functions sin cos tan asin acos atan atan2 sqrt abs exp log min max pow floor sign
/// and if(condition,then,otherwise). Angles are radians. A formula has no effects and always ends.
class Expression {
 public:
  /// Throws CommandError that begins with `what`, with the column and the nearest name.
  Expression(std::string_view what, std::string_view text, std::span<const std::string> variables);

  /// As many values as there are variables, in their order. Not finite where the formula is not defined.
  double operator()(std::span<const double> values) const;

  /// An operator or a function of up to three numbers.
  struct Function {
    const char* name;
    int arity;
    double (*call)(const double* arguments);
  };

 private:
  // A stack machine's step: a call, else a variable, else a number.
  struct Step {
    const Function* function = nullptr;
    int variable = -1;
    double number = 0.0;
  };
  friend class ExpressionParser;
  std::vector<Step> steps_;
};

}  // namespace omma
