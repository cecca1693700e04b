#include "harness/judge/check_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::harness {

CheckResult start_check_result(const Check& check) {
  CheckResult entry;
  entry.name = check.name;
  entry.title = check.title;
  entry.quantity = check.quantity;
  entry.unit = unit_of(check.quantity);
  entry.statistic = check.statistic;
  entry.reference = check.reference;
  entry.against_variant = check.against_variant;
  entry.against_quantity = check.against_quantity;
  entry.role = to_string(check.role);
  entry.measure = to_string(check.measure);
  entry.expectation = check.expectation;
  entry.why = check.why;
  return entry;
}

CheckResult failed_check_result(const Check& check, const std::string& message) {
  CheckResult entry = start_check_result(check);
  entry.message = message;
  return entry;
}

const references::Reference& find_reference(const CheckContext& context,
                                            const std::string& pointer) {
  std::vector<std::string> tokens;
  for (JsonPointer left(pointer); !left.empty(); left.pop_back()) tokens.push_back(left.back());
  JsonView place(context.document);
  std::for_each(tokens.rbegin(), tokens.rend(),
                [&](const std::string& token) { place = place[token]; });
  return context.references.get(place);
}

bool fails_gate(Verdict verdict) {
  return verdict != Verdict::pass && verdict != Verdict::recorded && verdict != Verdict::not_given;
}

double severity(const CheckResult& entry) {
  if (entry.verdict == Verdict::error) return std::numeric_limits<double>::infinity();
  const double value = entry.difference.value_or(entry.computed.value_or(0));
  if (!entry.tolerance) return std::abs(value);
  const auto& [low, high, symmetric] = *entry.tolerance;
  if (!low || !high) return low ? *low - value : value - *high;
  const double half = (*high - *low) / 2;
  return (std::abs(value - (*low + half)) - half) / (half > 0 ? half : 1);
}

}  // namespace trammel::harness
