#include "reports/check_text.h"

#include <algorithm>
#include <cmath>

#include "reports/number.h"
#include "reports/quantity.h"

namespace trammel::reports {

namespace {

constexpr int most_target_digits = 8;

std::string with_unit(const std::string& number, const std::string& unit) {
  const std::string people = unit_for_people(unit);
  return people.empty() ? number : number + "\u202f" + people;
}

int digits_in(const std::string& text) {
  const std::string mantissa = text.substr(0, text.find('e'));
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string::npos) return 1;
  return static_cast<int>(std::count_if(mantissa.begin() + static_cast<long>(first), mantissa.end(),
                                        [](char c) { return c >= '0' && c <= '9'; }));
}

int digits_for(const Check& check) {
  if (!check.expected || !check.computed) return 4;
  return telling_digits(*check.expected, *check.computed);
}

/// A limit or difference in the check's own measure.
std::string measured(const Check& check, double x, bool sign) {
  if (check.measure == "relative") return relative(x, 3, sign);
  const std::string number = sign ? with_sign(x, 3) : trimmed(x, 4);
  const bool plain = check.measure == "ratio" || check.measure == "order";
  return plain ? number : with_unit(number, check.unit);
}

std::string bound_text(const Check& check) {
  const Tolerance& t = *check.tolerance;
  const auto limit = [&](double x) { return with_unit(trimmed(x, 4), check.unit); };
  if (t.low && t.high) return limit(*t.low) + " to " + limit(*t.high);
  if (t.high) return "≤ " + limit(*t.high);
  return t.low ? "≥ " + limit(*t.low) : "";
}

}  // namespace

std::string target_text(const Check& check) {
  if (!check.expected) return check.measure == "bound" && check.tolerance ? bound_text(check) : "–";
  // A value that was printed with few digits is shown with those; a long one as far as it tells.
  const int own = digits_in(shortest(*check.expected));
  if (own <= most_target_digits) return significant(*check.expected, own);
  return significant(*check.expected, digits_for(check));
}

std::string computed_text(const Check& check) {
  if (!check.computed) return check.verdict == Verdict::not_run ? "–" : "none";
  const double x = *check.computed;
  if (x == std::round(x) && std::abs(x) < 1e6) return trimmed(x, 7);
  return significant(x, digits_for(check));
}

std::string difference_text(const Check& check, double difference) {
  if (check.measure == "ratio") return "ratio " + trimmed(difference, 4);
  return measured(check, difference, true);
}

std::string difference_text(const Check& check) {
  if (check.measure == "bound") {
    const double used = tolerance_used(check);
    return std::isfinite(used) ? relative(used, 2, false) + " of the limit" : "–";
  }
  return check.difference ? difference_text(check, *check.difference) : "–";
}

std::string tolerance_text(const Check& check) {
  if (!check.tolerance) return "–";
  const Tolerance& t = *check.tolerance;
  if (check.measure == "bound") return bound_text(check);
  if (t.symmetric) return "± " + measured(check, *t.high, false);
  const bool sign = check.measure != "ratio";
  if (t.low && t.high)
    return measured(check, *t.low, sign) + " to " + measured(check, *t.high, sign);
  if (t.high) return "≤ " + measured(check, *t.high, sign);
  return t.low ? "≥ " + measured(check, *t.low, sign) : "–";
}

std::string quantity_text(const Check& check) {
  const Quantity quantity = parse_quantity(check.quantity);
  std::string text = in_words(quantity);
  if (!check.statistic.empty()) {
    std::string statistic = check.statistic;
    std::replace(statistic.begin(), statistic.end(), '_', ' ');
    text = statistic + " of " + text;
  }
  if (!check.against_variant.empty()) text += ", over that of " + check.against_variant;
  const std::string unit = check.unit.empty() ? quantity.unit : unit_for_people(check.unit);
  return axis_label(text, check.measure == "ratio" ? "" : unit);
}

std::string entry_text(const Check& check, std::size_t of) {
  if (!check.index) return "";
  const std::string number = std::to_string(*check.index + 1);
  if (check.quantity.rfind("frequency", 0) == 0) return "mode " + number;
  if (of > 20) return "point " + number;
  return of > 1 || *check.index > 0 ? number : "";
}

std::string trouble_text(const CheckGroup& group) {
  const Check& worst = group.worst();
  const auto bad = static_cast<std::size_t>(
      std::count_if(group.checks.begin(), group.checks.end(), [](const Check* check) {
        return check->verdict == Verdict::fail || check->verdict == Verdict::error;
      }));
  std::string text;
  if (group.checks.size() > 1) {
    text = std::to_string(bad) + " of " + std::to_string(group.checks.size()) + "; worst: ";
    const std::string entry = entry_text(worst, group.checks.size());
    if (!entry.empty()) text += entry + ", ";
  }
  if (!worst.computed) return text + (worst.message.empty() ? "nothing computed" : worst.message);
  text += "computed " + computed_text(worst) + " against " + target_text(worst);
  if (worst.measure != "bound")
    text += ", " + difference_text(worst) + " where " + tolerance_text(worst) +
            (worst.known_discrepancy ? " is expected" : " is allowed");
  return worst.message.empty() ? text : text + " (" + worst.message + ")";
}

}  // namespace trammel::reports
