#pragma once

#include <map>
#include <string>
#include <vector>

#include "references/numerics/arguments.h"
#include "references/numerics/real.h"

/// Closed formulas written out in the reference file itself: numbers, names, + - * / ^ (right to
/// left), unary minus, parentheses, pi, and abs, sqrt, exp, log, sin, cos, tan, asin, acos, atan,
/// sinh, cosh, tanh.
namespace trammel::references {

/// @tparam T  the scalar; instantiated for Real.
/// @param values  what the names of the text stand for.
/// @throws DerivationError  with the column where the text cannot be read, or an unknown name, or
///                          where the value is not finite.
template <class T>
[[nodiscard]] T evaluate_expression(const std::string& text,
                                    const std::map<std::string, T>& values);

extern template Real evaluate_expression<Real>(const std::string&,
                                               const std::map<std::string, Real>&);

/// Arguments: formulas (array of texts), values (object of numbers). One value a formula; each
/// formula may use the results of those before it as v1, v2, ...
[[nodiscard]] std::vector<double> formula_program(const Json& arguments);

}  // namespace trammel::references
