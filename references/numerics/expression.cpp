#include "references/numerics/expression.h"

#include <boost/math/special_functions/fpclassify.hpp>
#include <cctype>
#include <cstdlib>

namespace trammel::references {

namespace {

const std::map<std::string, Real (*)(const Real&)>& functions() {
  static const std::map<std::string, Real (*)(const Real&)> table = {
      {"abs", [](const Real& x) -> Real { return abs(x); }},
      {"acos", [](const Real& x) -> Real { return acos(x); }},
      {"asin", [](const Real& x) -> Real { return asin(x); }},
      {"atan", [](const Real& x) -> Real { return atan(x); }},
      {"cos", [](const Real& x) -> Real { return cos(x); }},
      {"cosh", [](const Real& x) -> Real { return cosh(x); }},
      {"exp", [](const Real& x) -> Real { return exp(x); }},
      {"log", [](const Real& x) -> Real { return log(x); }},
      {"sin", [](const Real& x) -> Real { return sin(x); }},
      {"sinh", [](const Real& x) -> Real { return sinh(x); }},
      {"sqrt", [](const Real& x) -> Real { return sqrt(x); }},
      {"tan", [](const Real& x) -> Real { return tan(x); }},
      {"tanh", [](const Real& x) -> Real { return tanh(x); }}};
  return table;
}

/// Grammar: sum = power (operator power)*, where * and / bind closer than + and -;
/// power = '-' power | primary ('^' power)?;
/// primary = number | name | function '(' sum ')' | '(' sum ')'.
class Parser {
 public:
  Parser(const std::string& text, const std::map<std::string, Real>& values)
      : text_(text), values_(values) {}

  Real parse() {
    const Real value = operation(1);
    if (peek() != '\0') fail("expected an operator");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw DerivationError("'" + text_ + "', column " + std::to_string(position_ + 1) + ": " + what);
  }

  char peek() {
    while (position_ < text_.size() && text_[position_] == ' ') ++position_;
    return position_ < text_.size() ? text_[position_] : '\0';
  }

  bool accept(char c) {
    if (peek() != c) return false;
    ++position_;
    return true;
  }

  /// Evaluates operators whose precedence is at least `rank`. The precedence is 1 for + and -, and
  /// 2 for * and /.
  Real operation(int rank) {
    if (rank > 2) return power();
    Real value = operation(rank + 1);
    while (peek() == (rank == 1 ? '+' : '*') || peek() == (rank == 1 ? '-' : '/')) {
      const char name = text_[position_++];
      const Real other = operation(rank + 1);
      value = name == '+'   ? value + other
              : name == '-' ? value - other
              : name == '*' ? value * other
                            : value / other;
    }
    return value;
  }

  Real power() {
    if (accept('-')) return -power();
    const Real base = primary();
    return accept('^') ? Real(pow(base, power())) : base;
  }

  Real parenthesized() {
    if (!accept('(')) fail("expected '('");
    const Real value = operation(1);
    if (!accept(')')) fail("expected ')'");
    return value;
  }

  Real primary() {
    const char c = peek();
    if (c == '(') return parenthesized();
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) return identifier();
    fail("expected a number, a name or '('");
  }

  Real number() {
    const std::size_t from = position_;
    char* end = nullptr;
    std::strtod(text_.c_str() + from, &end);
    position_ = static_cast<std::size_t>(end - text_.c_str());
    if (position_ == from) fail("expected a number");
    return Real(text_.substr(from, position_ - from));
  }

  Real identifier() {
    const std::size_t from = position_;
    while (position_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[position_])) != 0 ||
            text_[position_] == '_')) {
      ++position_;
    }
    const std::string name = text_.substr(from, position_ - from);
    const auto value = values_.find(name);
    if (value != values_.end()) return value->second;
    if (name == "pi") return pi<Real>();
    const auto function = functions().find(name);
    if (function != functions().end()) return function->second(parenthesized());
    position_ = from;
    fail("unknown name '" + name + "'");
  }

  const std::string& text_;
  const std::map<std::string, Real>& values_;
  std::size_t position_ = 0;
};

}  // namespace

Real evaluate_expression(const std::string& text, const std::map<std::string, Real>& values) {
  const Real value = Parser(text, values).parse();
  if (!(boost::math::isfinite)(value)) throw DerivationError("'" + text + "' is not finite");
  return value;
}

std::vector<Real> formula_program(const Arguments& arguments) {
  std::map<std::string, Real> values;
  if (arguments.has("values")) {
    const Arguments given(arguments["values"], "/values");
    for (const std::string& name : given.keys()) values[name] = given.number(name);
  }
  std::vector<Real> results;
  for (const std::string& formula : arguments.texts("formulas")) {
    const Real value = evaluate_expression(formula, values);
    results.push_back(value);
    values[std::string("v").append(std::to_string(results.size()))] = value;
  }
  return results;
}

}  // namespace trammel::references
