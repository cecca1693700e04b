#pragma once

#include <map>
#include <string>
#include <vector>

#include "references/numerics/arguments.h"
#include "references/numerics/real.h"

/// Formulas in the text of a reference file. They may contain numbers, names, + - * / ^ (evaluated
/// from right to left), unary minus, parentheses, pi, and abs, sqrt, exp, log, sin, cos, tan, asin,
/// acos, atan, sinh, cosh, tanh.
namespace trammel::references {

/// Returns the value of a formula. `values` contains the values of the names in the text.
/// @throws DerivationError  if the text is invalid, a name is unknown, or the value is not finite.
[[nodiscard]] Real evaluate_expression(const std::string& text,
                                       const std::map<std::string, Real>& values);

/// Computes the value of each formula. Arguments: formulas (array of texts), values (object of
/// numbers). A formula may use the results of earlier formulas as v1, v2, ...
[[nodiscard]] std::vector<Real> formula_program(const Arguments& arguments);

}  // namespace trammel::references
