#include "reports/data/check_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr int kMaxTargetDigits = 8;  ///< largest number of digits of a target

std::string number_with_unit(const std::string& number, const std::string& unit) {
  const std::string symbol = display_unit(unit);
  return symbol.empty() ? number : number + "\u202f" + symbol;
}

int count_digits(const std::string& text) {
  const std::string mantissa = text.substr(0, text.find('e'));
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string::npos) return 1;
  return static_cast<int>(std::count_if(mantissa.begin() + static_cast<long>(first), mantissa.end(),
                                        [](char c) { return c >= '0' && c <= '9'; }));
}

int digits_of_check(const Check& check) {
  if (!check.expected || !check.computed) return 4;
  return distinguishing_digits(*check.expected, *check.computed);
}

/// Returns whether the check judges the extrapolated value of a convergence study.
bool is_extrapolated(const Check& check) {
  return check.name.ends_with(".richardson");
}

std::string statistic_text(const std::string& statistic) {
  constexpr std::array<std::pair<const char*, const char*>, 4> words = {{
      {"max_abs", "largest magnitude"},
      {"max", "largest"},
      {"min", "smallest"},
      {"rms", "root mean square"},
  }};
  for (const auto& [key, text_of_key] : words)
    if (statistic == key) return text_of_key;
  return replace_separators(statistic);
}

/// Returns the number of significant digits that a ratio requires so that its text differs from
/// "1".
int digits_of_ratio(double ratio) {
  return distinguishing_digits(ratio, 1) + (ratio > 1 && ratio < 1.1 ? 1 : 0);
}

/// Returns a tolerance limit or a difference as text. The text is a percentage, a ratio, or a
/// number with its unit, as the key "measure" of the check requires.
std::string measured_text(const Check& check, double x, bool sign) {
  if (check.measure == "relative") return percent_text(x, 3, sign);
  if (check.measure == "ratio") return trimmed(x, digits_of_ratio(x));
  const std::string number = sign ? number_with_sign(x, 3) : trimmed(x, 4);
  const bool plain = check.measure == "order" || check.measure == "leading-term";
  return plain ? number : number_with_unit(number, check.unit);
}

std::string bound_text(const Check& check) {
  const Tolerance& t = *check.tolerance;
  const auto limit = [&](double x) { return number_with_unit(trimmed(x, 4), check.unit); };
  if (t.low && t.high && *t.low == *t.high) return limit(*t.low);
  if (t.low && t.high) return trimmed(*t.low, 4) + " to " + limit(*t.high);
  if (t.high) return "≤ " + limit(*t.high);
  return t.low ? "≥ " + limit(*t.low) : "";
}

}  // namespace

bool is_numeric(const Check& check) {
  return check.quantity != "status" && !check.is_known_discrepancy() &&
         std::isfinite(difference_over_tolerance(check));
}

std::string check_title(const Check& check) {
  return check.title.empty() ? check.name : check.title;
}

std::string target_text(const Check& check) {
  if (check.measure == "validation") return "as recorded";
  if (!check.expected) return check.measure == "bound" && check.tolerance ? bound_text(check) : "–";
  // A target with at most kMaxTargetDigits digits is shown with all digits.
  const int digits = count_digits(shortest_decimal(*check.expected));
  if (digits <= kMaxTargetDigits) return rounded_text(*check.expected, digits);
  return rounded_text(*check.expected, digits_of_check(check));
}

std::string computed_text(const Check& check) {
  if (check.measure == "status") return check.message.substr(0, check.message.find(':'));
  if (check.measure == "validation" && check.verdict == Verdict::pass) return "same as recorded";
  if (check.measure == "validation" && check.verdict == Verdict::fail) return "not as recorded";
  if (!check.computed) return check.verdict == Verdict::not_run ? "–" : "none";
  const double x = *check.computed;
  if (x == std::round(x) && std::abs(x) < 1e6) return trimmed(x, 7);
  return rounded_text(x, digits_of_check(check));
}

std::string difference_text(const Check& check, double difference) {
  if (check.measure == "ratio") return "×\u202f" + measured_text(check, difference, false);
  return measured_text(check, difference, true);
}

std::string difference_text(const Check& check) {
  if (check.measure == "bound") {
    // A value with only an upper limit is shown as its fraction of the limit: "12 % of limit". A
    // value with a lower limit is shown as "within" or "outside" its limits. For a known
    // discrepancy, the limits are the recorded range of the value.
    const double used = difference_over_tolerance(check);
    if (!std::isfinite(used)) return "–";
    if (check.tolerance->low && used > 1) return "outside";
    if (check.tolerance->low) return check.is_known_discrepancy() ? "as recorded" : "within";
    return percent_text(used, 2, false) + " of limit";
  }
  return check.difference ? difference_text(check, *check.difference) : "–";
}

std::string tolerance_text(const Check& check) {
  if (!check.tolerance) return "–";
  const Tolerance& t = *check.tolerance;
  if (check.measure == "bound") return bound_text(check);
  if (t.symmetric && *t.high == 0) return "exactly";
  if (t.symmetric) return "± " + measured_text(check, *t.high, false);
  const bool sign = check.measure != "ratio";
  if (t.low && t.high)
    return measured_text(check, *t.low, sign) + " to " + measured_text(check, *t.high, sign);
  if (t.high) return "≤ " + measured_text(check, *t.high, sign);
  return t.low ? "≥ " + measured_text(check, *t.low, sign) : "–";
}

std::string quantity_text(const Check& check) {
  const QuantityLabel quantity = parse_quantity(check.quantity);
  std::string text = to_text(quantity);
  if (check.measure == "status") return "status of the run";
  if (check.measure == "validation") return "verdicts of ASME V&V 20 on " + text;
  if (check.measure == "order") return "order of convergence of " + text;
  if (check.measure == "leading-term")
    return "ratio of the error of " + text + " to the theoretical leading error term";
  if (is_extrapolated(check)) text = "extrapolated " + text;
  if (!check.statistic.empty()) text = statistic_text(check.statistic) + " of " + text;
  if (!check.against_quantity.empty())
    text += ", against " + to_text(parse_quantity(check.against_quantity));
  if (!check.against_variant.empty()) text += ", against " + check.against_variant;
  return axis_label(text, check.unit.empty() ? quantity.unit : display_unit(check.unit));
}

std::string entry_text(const Check& check, std::size_t entries) {
  if (!check.index) return "";
  const std::string number = std::to_string(*check.index + 1);
  if (check.quantity.starts_with("frequency")) return "mode " + number;
  if (entries > 20 || *check.index > 20) return "point " + number;
  return entries > 1 || *check.index > 0 ? number : "";
}

std::string failure_text(const CheckGroup& group) {
  const Check& worst = group.worst();
  const auto bad =
      static_cast<std::size_t>(std::ranges::count_if(group.checks, [](const Check* check) {
        return check->verdict == Verdict::fail || check->verdict == Verdict::error;
      }));
  std::string text;
  if (group.checks.size() > 1) {
    text = std::to_string(bad) + " of " + std::to_string(group.checks.size()) + "; worst: ";
    const std::string entry = entry_text(worst, group.checks.size());
    if (!entry.empty()) text += entry + ", ";
  }
  if (!worst.computed) return text + (worst.message.empty() ? "no computed value" : worst.message);
  text += "computed " + computed_text(worst) + " against " + target_text(worst);
  if (worst.measure != "bound")
    text += ", " + difference_text(worst) + " where " + tolerance_text(worst) +
            (worst.is_known_discrepancy() ? " is expected" : " is allowed");
  return worst.message.empty() ? text : text + " (" + worst.message + ")";
}

std::string work_counters_text(const Counters& counters) {
  std::string text;
  for (const auto& [name, n] : counters) {
    if (n == 0 && name == "steps") continue;  // zero load or time steps are not shown
    std::string digits = std::to_string(n);
    for (auto place = static_cast<std::ptrdiff_t>(digits.size()) - 3; place > 0; place -= 3)
      digits.insert(static_cast<std::size_t>(place), "\u202f");
    add_item(text, digits + " " + replace_separators(name));
  }
  return text;
}

}  // namespace trammel::reports
