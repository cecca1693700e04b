#pragma once

#include "harness/judge/check_result.h"

/// From numbers to verdicts. Fails closed: what cannot be compared is an error, never a pass.
namespace trammel::harness {

/// One judgement an entry; of a long array the worst alone, which says so.
[[nodiscard]] std::vector<CheckResult> evaluate_check(const Check& check,
                                                      const CheckContext& context);

}  // namespace trammel::harness
