#include "references/numerics/expression.h"

#include <boost/math/special_functions/fpclassify.hpp>
#include <cctype>

namespace trammel::references {

namespace {

using Function = Real (*)(const Real&);

const std::map<std::string, Function>& functions() {
  static const std::map<std::string, Function> table = {
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

/// sum = product (('+'|'-') product)*; product = power (('*'|'/') power)*;
/// power = '-' power | primary ('^' power)?; primary = number | name | function '(' sum ')' | '('
/// sum
/// ')'.
class Parser {
 public:
  Parser(const std::string& text, const std::map<std::string, Real>& values)
      : text_(text), values_(values) {}

  Real parse() {
    const Real value = sum();
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

  Real sum() {
    Real value = product();
    for (;;) {
      if (accept('+')) {
        value += product();
      } else if (accept('-')) {
        value -= product();
      } else {
        return value;
      }
    }
  }

  Real product() {
    Real value = power();
    for (;;) {
      if (accept('*')) {
        value *= power();
      } else if (accept('/')) {
        value /= power();
      } else {
        return value;
      }
    }
  }

  Real power() {
    if (accept('-')) return -power();
    const Real base = primary();
    return accept('^') ? Real(pow(base, power())) : base;
  }

  Real parenthesised() {
    if (!accept('(')) fail("expected '('");
    const Real value = sum();
    if (!accept(')')) fail("expected ')'");
    return value;
  }

  Real primary() {
    const char c = peek();
    if (c == '(') return parenthesised();
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) return identifier();
    fail("expected a number, a name or '('");
  }

  Real number() {
    const std::size_t from = position_;
    const auto digits = [&] {
      while (position_ < text_.size() &&
             (std::isdigit(static_cast<unsigned char>(text_[position_])) != 0)) {
        ++position_;
      }
    };
    digits();
    if (position_ < text_.size() && text_[position_] == '.') {
      ++position_;
      digits();
    }
    if (position_ < text_.size() && text_[position_] == 'e') {
      ++position_;
      if (position_ < text_.size() && (text_[position_] == '-' || text_[position_] == '+'))
        ++position_;
      digits();
    }
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
    if (function != functions().end()) return function->second(parenthesised());
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

std::vector<double> formula_program(const Json& json) {
  const Arguments arguments(json, "", {"formulas", "values"});
  std::map<std::string, Real> values;
  if (arguments.has("values")) {
    const Arguments given(arguments["values"], "/values");
    for (const std::string& name : given.keys()) values[name] = given.number(name);
  }
  std::vector<double> results;
  for (const std::string& formula : arguments.texts("formulas")) {
    const Real value = evaluate_expression(formula, values);
    results.push_back(static_cast<double>(value));
    values[std::string("v").append(std::to_string(results.size()))] = value;
  }
  return results;
}

}  // namespace trammel::references
