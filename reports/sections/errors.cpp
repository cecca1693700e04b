#include <algorithm>

#include "reports/sections/sections.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxValues = 8;

/// "5.821, 5.844, 9.016", or the ends of a curve.
std::string values_text(const std::vector<double>& values) {
  if (values.size() > kMaxValues) {
    const auto [low, high] = std::ranges::minmax(values);
    return low_to_high(significant(low, 4), significant(high, 4));
  }
  std::string text;
  for (const double value : values) add_item(text, significant(value, 6));
  return text;
}

Data row_of(const ErrorEstimate& estimate, const std::vector<double>& values) {
  double largest = 0;
  for (const Number& error : estimate.relative) largest = std::max(largest, error.value_or(0));
  const QuantityLabel quantity = parse_quantity(estimate.quantity);
  return object({{"quantity", axis_label(to_text(quantity), quantity.unit)},
                 {"values", values_text(values)},
                 {"error", "± " + relative(largest, 2, false)},
                 {"coarse", !estimate.asymptotic}});
}

}  // namespace

void set_errors(Data& data, const std::vector<const Run*>& runs) {
  Data rows = list();
  const auto found =
      std::ranges::find_if(runs, [](const Run* run) { return run->errors.has_value(); });
  if (found != runs.end())
    for (const ErrorEstimate& estimate : (*found)->errors->quantities)
      if (const std::vector<double>* values = (*found)->quantity(estimate.quantity))
        rows.push_back(row_of(estimate, *values));
  set(data, {{"has_errors", rows.is_non_empty_list()},
             {"errors_from", rows.is_non_empty_list() ? (*found)->errors->companions : ""},
             {"errors", rows}});
}

}  // namespace trammel::reports
