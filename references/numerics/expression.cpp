#include "references/numerics/expression.h"

#include <boost/math/special_functions/fpclassify.hpp>
#include <cctype>

namespace trammel::references {

namespace {

template <class T>
const std::map<std::string, T (*)(const T&)>& functions() {
  static const std::map<std::string, T (*)(const T&)> table = {
      {"abs", [](const T& x) -> T { return abs(x); }},
      {"acos", [](const T& x) -> T { return acos(x); }},
      {"asin", [](const T& x) -> T { return asin(x); }},
      {"atan", [](const T& x) -> T { return atan(x); }},
      {"cos", [](const T& x) -> T { return cos(x); }},
      {"cosh", [](const T& x) -> T { return cosh(x); }},
      {"exp", [](const T& x) -> T { return exp(x); }},
      {"log", [](const T& x) -> T { return log(x); }},
      {"sin", [](const T& x) -> T { return sin(x); }},
      {"sinh", [](const T& x) -> T { return sinh(x); }},
      {"sqrt", [](const T& x) -> T { return sqrt(x); }},
      {"tan", [](const T& x) -> T { return tan(x); }},
      {"tanh", [](const T& x) -> T { return tanh(x); }}};
  return table;
}

/// sum = product (('+'|'-') product)*; product = power (('*'|'/') power)*;
/// power = '-' power | primary ('^' power)?;
/// primary = number | name | function '(' sum ')' | '(' sum ')'.
template <class T>
class Parser {
 public:
  Parser(const std::string& text, const std::map<std::string, T>& values)
      : text_(text), values_(values) {}

  T parse() {
    const T value = sum();
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

  T sum() {
    T value = product();
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

  T product() {
    T value = power();
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

  T power() {
    if (accept('-')) return -power();
    const T base = primary();
    return accept('^') ? T(pow(base, power())) : base;
  }

  T parenthesised() {
    if (!accept('(')) fail("expected '('");
    const T value = sum();
    if (!accept(')')) fail("expected ')'");
    return value;
  }

  T primary() {
    const char c = peek();
    if (c == '(') return parenthesised();
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) return identifier();
    fail("expected a number, a name or '('");
  }

  T number() {
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
    return T(text_.substr(from, position_ - from));
  }

  T identifier() {
    const std::size_t from = position_;
    while (position_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[position_])) != 0 ||
            text_[position_] == '_')) {
      ++position_;
    }
    const std::string name = text_.substr(from, position_ - from);
    const auto value = values_.find(name);
    if (value != values_.end()) return value->second;
    if (name == "pi") return pi<T>();
    const auto function = functions<T>().find(name);
    if (function != functions<T>().end()) return function->second(parenthesised());
    position_ = from;
    fail("unknown name '" + name + "'");
  }

  const std::string& text_;
  const std::map<std::string, T>& values_;
  std::size_t position_ = 0;
};

}  // namespace

template <class T>
T evaluate_expression(const std::string& text, const std::map<std::string, T>& values) {
  const T value = Parser<T>(text, values).parse();
  if (!(boost::math::isfinite)(value)) throw DerivationError("'" + text + "' is not finite");
  return value;
}

template Real evaluate_expression<Real>(const std::string&, const std::map<std::string, Real>&);

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
