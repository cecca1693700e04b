#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/base/quantity.h"
#include "harness/input/check.h"
#include "harness/input/reference_library.h"
#include "harness/judge/convergence.h"

/// Evaluation of checks, which compare computed quantities with expected values or bounds.
namespace trammel::harness {

using results::Verdict;

/// Judgment of one entry of the checked quantity, or of a check that cannot be evaluated.
using CheckResult = results::Check;

/// Results of a run, and the data with which its checks are judged.
struct CheckContext {
  const Document& document;
  const Quantities& quantities;
  const std::vector<Convergence>& convergence;
  const References& references;
  /// Returns the quantities of another variant of the case; null if that variant has no results.
  std::function<const Quantities*(const std::string& variant)> variant;
  /// Solver that computed the quantities; null for trammel. For a quantity that another solver does
  /// not return, the verdict is "not given" instead of an error.
  const results::SolverIdentity* other_solver = nullptr;
};

/// Creates a judgment with the check's name, role and reasons, and with the verdict "error".
[[nodiscard]] CheckResult create_check_result(const Check& check);
/// Creates a judgment with the verdict "error" and the given message.
[[nodiscard]] CheckResult failed_check_result(const Check& check, const std::string& message);

/// Returns the reference whose id is at this JSON pointer of the case document.
[[nodiscard]] const references::Reference& find_reference(const CheckContext& context,
                                                          const std::string& pointer);

/// Returns true if the verdict fails a run: every verdict except `pass`, `recorded` and
/// `not_given`.
[[nodiscard]] bool counts_as_failure(Verdict verdict);

/// Returns one judgment per entry of the checked quantity. For a quantity with many entries,
/// returns only the judgment of the worst entry.
[[nodiscard]] std::vector<CheckResult> evaluate_check(const Check& check,
                                                      const CheckContext& context);

/// Returns the judgments of a check of the order of convergence, from the convergence studies of
/// the context: the observed order and, if requested, the leading term of the error and the
/// extrapolated value.
[[nodiscard]] std::vector<CheckResult> evaluate_order_check(const Check& check,
                                                            const CheckContext& context);

}  // namespace trammel::harness
