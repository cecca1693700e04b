#pragma once

#include "harness/judge/check_result.h"

namespace trammel::harness {

/// The judgements of an "order" check on the refinements of the context: the observed order, and
/// where asked for the leading term of the error and the extrapolated value.
[[nodiscard]] std::vector<CheckResult> evaluate_order_check(const Check& check,
                                                            const CheckContext& context);

}  // namespace trammel::harness
