#pragma once

#include <map>
#include <string>
#include <vector>

#include "references/numerics/arguments.h"
#include "references/numerics/real.h"

/// Closed formulas in the text of a reference file: numbers, names, + - * / ^ (right to
/// left), unary minus, parentheses, pi, and abs, sqrt, exp, log, sin, cos, tan, asin, acos, atan,
/// sinh, cosh, tanh.
namespace trammel::references {

/// @param values  values of the names in the text.
/// @throws DerivationError  with the column if the text cannot be read or a name is unknown, and if
///                          the value is not finite.
[[nodiscard]] Real evaluate_expression(const std::string& text,
                                       const std::map<std::string, Real>& values);

/// Arguments: formulas (array of texts), values (object of numbers). One value a formula; each
/// formula may use the results of earlier formulas as v1, v2, ...
[[nodiscard]] std::vector<Real> formula_program(const Arguments& arguments);

}  // namespace trammel::references
