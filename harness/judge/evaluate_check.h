#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/quantity.h"
#include "harness/input/check.h"
#include "harness/input/reference_library.h"
#include "harness/judge/convergence.h"

/// What a check comes to, and what it is judged with.
namespace trammel::harness {

using results::Verdict;

/// The judgement of one entry of a check, or of a check that has no entries.
using CheckResult = results::Check;

/// What a run's checks are judged with.
struct CheckContext {
  const Document& document;
  const Quantities& quantities;
  const std::vector<Convergence>& convergence;
  const References& references;
  /// Quantities of another variant of the case; null where it has none.
  std::function<const Quantities*(const std::string& variant)> variant;
  /// Null: trammel's own. Of another, what is missing is not given instead of an error.
  const results::SolverIdentity* other_solver = nullptr;
};

/// A judgement that carries the check's name, role and reasons; an error until it is filled in.
[[nodiscard]] CheckResult start_check_result(const Check& check);
[[nodiscard]] CheckResult failed_check_result(const Check& check, const std::string& message);

/// A place in the document that holds the name of a reference: the check's own, or one inside it.
[[nodiscard]] const references::Reference& find_reference(const CheckContext& context,
                                                          const std::string& pointer);

/// A gate that does not hold: everything but a pass, what is only recorded and what is not given.
[[nodiscard]] bool fails_gate(Verdict verdict);

/// How far out an entry lies: errors first, then by the share of the window that is used.
[[nodiscard]] double severity(const CheckResult& entry);

/// One judgement an entry; of a long array the worst alone, which says so.
[[nodiscard]] std::vector<CheckResult> evaluate_check(const Check& check,
                                                      const CheckContext& context);

/// The judgements of an "order" check on the refinements of the context: the observed order, and
/// where asked for the leading term of the error and the extrapolated value.
[[nodiscard]] std::vector<CheckResult> evaluate_order_check(const Check& check,
                                                            const CheckContext& context);

}  // namespace trammel::harness
