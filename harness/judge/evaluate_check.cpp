#include "harness/judge/evaluate_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/statistic.h"
#include "harness/base/text.h"
#include "harness/results/check_groups.h"

namespace trammel::harness {
namespace {

/// Maximum number of entries of a quantity that a check reports one by one. If there are more
/// entries, only the worst entry is reported.
constexpr std::size_t kMaxEntries = 16;

/// Exception with the reason why the computed and the expected values of a check cannot be
/// compared.
struct NotComparable {
  std::string message;
  bool is_missing = false;  ///< true if the requested quantity is missing
};

std::vector<std::string> names_of_quantities(const Quantities& quantities) {
  std::vector<std::string> names;
  for (const auto& item : quantities) names.push_back(item.first);
  return names;
}

/// Lists the names of the available quantities without the part after the colon: " (computed
/// quantities: frequency_Hz and ...)".
std::string list_quantity_kinds(const Quantities& quantities) {
  constexpr std::size_t most = 12;
  std::vector<std::string> kinds;
  for (const auto& item : quantities) {
    const std::string kind = item.first.substr(0, item.first.find(':'));
    if (kinds.empty() || kinds.back() != kind) kinds.push_back(kind);
  }
  if (kinds.empty()) return "";
  if (kinds.size() > most) {
    kinds.resize(most);
    kinds.emplace_back("more");
  }
  return " (computed quantities: " + join(kinds, "and") + ")";
}

const std::vector<double>& find_quantity(const Quantities& quantities, const std::string& name,
                                         const std::string& where) {
  const auto found = quantities.find(name);
  if (found != quantities.end()) return found->second.values;
  const bool has_entry = quantities.contains(name.substr(0, name.find(':')));
  const std::string guess = has_entry ? "; the key 'index' selects a value, from 0"
                                      : did_you_mean(name, names_of_quantities(quantities));
  throw NotComparable{"no quantity '" + name + "'" + where +
                          (guess.empty() ? list_quantity_kinds(quantities) : guess),
                      true};
}

std::vector<double> pick(const std::vector<double>& values, const std::vector<std::size_t>& index,
                         const std::string& source) {
  if (index.empty()) return values;
  std::vector<double> picked;
  for (const std::size_t i : index) {
    if (i >= values.size())
      throw NotComparable{
          fmt::format("index {} is outside of {}, which has {} entries", i, source, values.size())};
    picked.push_back(values[i]);
  }
  return picked;
}

/// Computed and expected numbers of a check, one per entry.
struct ComparedValues {
  std::vector<double> computed;
  std::vector<double> expected;  ///< expected values; empty if the check is a bound
  /// Absolute uncertainty of each expected value; empty if the expected values have no uncertainty.
  std::vector<double> uncertainty;
};

void require_unit(const std::string& quantity, const std::string& unit, const std::string& whose) {
  const std::string unit_found = unit_of(quantity);
  if (unit_found != unit)
    throw NotComparable{fmt::format("units differ: the unit of {} is {}, that of {} is {}",
                                    quantity, unit_found, whose, unit)};
}

void pair_with_reference(const Check& check, const CheckContext& context, ComparedValues& pairs) {
  const references::Reference& reference = find_reference(context, check.pointer + "/reference");
  require_unit(check.quantity, reference.unit, "reference " + reference.id);
  pairs.expected = pick(reference.values, check.reference_index, "reference " + reference.id);
  pairs.uncertainty =
      pick(reference.uncertainty, check.reference_index, "reference " + reference.id);
}

void pair_with_run(const Check& check, const CheckContext& context, ComparedValues& pairs) {
  const Quantities* other = &context.quantities;
  std::string where;
  if (!check.against_variant.empty()) {
    other = context.variant(check.against_variant);
    where = " in variant '" + check.against_variant + "'";
    if (other == nullptr) throw NotComparable{"no solution" + where + " to compare with", true};
  }
  const std::string name = check.against_quantity.empty() ? check.quantity : check.against_quantity;
  require_unit(check.quantity, unit_of(name), name);
  pairs.expected = pick(find_quantity(*other, name, where), check.index, name);
  if (!check.statistic.empty()) pairs.expected = {statistic_of(check.statistic, pairs.expected)};
}

ComparedValues collect(const Check& check, const CheckContext& context) {
  ComparedValues pairs;
  pairs.computed =
      pick(find_quantity(context.quantities, check.quantity, ""), check.index, check.quantity);
  if (pairs.computed.empty()) throw NotComparable{check.quantity + " has no values"};
  if (!check.statistic.empty()) pairs.computed = {statistic_of(check.statistic, pairs.computed)};
  if (!check.reference.empty()) pair_with_reference(check, context, pairs);
  if (!check.against_variant.empty() || !check.against_quantity.empty())
    pair_with_run(check, context, pairs);
  if (check.has_comparison_target() && pairs.expected.size() != pairs.computed.size())
    throw NotComparable{fmt::format(
        "the numbers of values differ: {} computed, {} expected; the key 'index' selects values",
        pairs.computed.size(), pairs.expected.size())};
  if (check.windows.size() > 1 && check.windows.size() != pairs.computed.size())
    throw NotComparable{fmt::format("{} values were computed, but the check has {} ranges",
                                    pairs.computed.size(), check.windows.size())};
  return pairs;
}

std::string outside(const Check& check, double value, const Window& window) {
  std::string what = check.measure == Measure::value ? "value" : to_string(check.measure);
  if (check.measure < Measure::ratio) what += " difference";
  const std::string where =
      fmt::format("the {} {} is outside of [{}, {}]", what, shortest_decimal(value),
                  shortest_decimal(window.low), shortest_decimal(window.high));
  if (check.expectation == Expectation::known_discrepancy)
    return "the difference left its recorded range: " + where;
  if (check.role == Role::validation) return "no longer agrees within the recorded range: " + where;
  return where;
}

/// Returns the tolerance window, widened on both sides by half a unit of the last digit that the
/// solver prints.
Window widened(const Window& window, const Check& check, const CheckResult& entry, int digits) {
  if (*entry.computed == 0) return window;
  const double leading = std::floor(std::log10(std::abs(*entry.computed)));
  double half_unit = 0.5 * std::pow(10.0, leading + 1 - digits);
  if (check.measure == Measure::relative || check.measure == Measure::ratio)
    half_unit /= std::abs(*entry.expected);
  return {window.low - half_unit, window.high + half_unit};
}

/// Sets the verdict of an entry of a check by its tolerance. The computed and expected values must
/// be set before the call.
void judge_entry(const Check& check, const Window* window, double uncertainty, CheckResult& entry) {
  const double expected = check.has_comparison_target() ? *entry.expected : 0;
  if (!std::isfinite(*entry.computed)) {
    entry.message = "the computed value is " + shortest_decimal(*entry.computed);
    return;
  }
  if (!std::isfinite(expected)) {
    entry.message = "the expected value is " + shortest_decimal(expected);
    return;
  }
  const double value =
      check.measure == Measure::value ? *entry.computed : *results::difference_of_check(entry);
  if (!std::isfinite(value)) {
    entry.message = "the measure " + std::string(to_string(check.measure)) +
                    " is undefined for an expected value of " + shortest_decimal(expected);
    return;
  }
  if (check.measure != Measure::value) entry.difference = value;
  if (window == nullptr) {
    entry.verdict = Verdict::recorded;
    return;
  }
  entry.tolerance = {window->low, window->high, check.symmetric};
  // A known discrepancy may be limited to some entries. An entry whose window contains zero is
  // expected to agree.
  if (entry.expectation == Expectation::known_discrepancy && window->contains(0) &&
      (check.measure == Measure::relative || check.measure == Measure::absolute)) {
    entry.expectation = Expectation::agrees;
  }
  const double scale = check.measure == Measure::relative ? std::abs(expected) : 1;
  if (check.role == Role::verification && check.symmetric && uncertainty > window->high * scale) {
    entry.message = "the uncertainty of the reference is +-" + shortest_decimal(uncertainty) +
                    ", which is more than the tolerance";
    return;
  }
  const bool holds = window->contains(value);
  entry.verdict = holds ? Verdict::pass : Verdict::fail;
  if (!holds) entry.message = outside(check, value, *window);
}

std::vector<CheckResult> keep_worst_entry(std::vector<CheckResult> entries) {
  CheckResult worst = *std::ranges::min_element(entries, results::is_worse_than);
  worst.message = "worst of " + std::to_string(entries.size()) +
                  (worst.message.empty() ? " entries" : " entries: " + worst.message);
  return {worst};
}

std::vector<CheckResult> evaluate_check_entries(const Check& check, const ComparedValues& pairs,
                                                const results::SolverIdentity* other_solver) {
  std::vector<CheckResult> entries;
  for (std::size_t i = 0; i < pairs.computed.size(); ++i) {
    CheckResult entry = create_check_result(check);
    if (check.statistic.empty()) entry.index = check.index.empty() ? i : check.index[i];
    entry.computed = pairs.computed[i];
    if (!pairs.expected.empty()) entry.expected = pairs.expected[i];
    const Window* window =
        check.windows.empty() ? nullptr : &check.windows[check.windows.size() == 1 ? 0 : i];
    std::optional<Window> printed;
    if (window != nullptr && other_solver != nullptr && other_solver->digits)
      window = &printed.emplace(widened(*window, check, entry, *other_solver->digits));
    judge_entry(check, window, pairs.uncertainty.empty() ? 0 : pairs.uncertainty[i], entry);
    entries.push_back(std::move(entry));
  }
  return entries.size() > kMaxEntries ? keep_worst_entry(std::move(entries)) : entries;
}

std::vector<CheckResult> evaluate_computed_values(const Check& check, const CheckContext& context) {
  try {
    if (check.order) return evaluate_order_check(check, context);
    return evaluate_check_entries(check, collect(check, context), context.other_solver);
  } catch (const NotComparable& reason) {
    CheckResult failed = failed_check_result(check, reason.message);
    if (reason.is_missing && context.other_solver != nullptr) failed.verdict = Verdict::not_given;
    return {failed};
  }
}

/// Judges a negative control: it passes if the worst entry has the required verdict and message.
CheckResult judge_negative_control(const Check& check, const std::vector<CheckResult>& entries) {
  CheckResult control = keep_worst_entry(entries).front();
  const NegativeControl& asked = *check.negative_control;
  const std::string verdict = to_string(control.verdict);
  const bool holds = verdict == asked.verdict &&
                     control.message.find(asked.message) != std::string::npos &&
                     (!asked.index || control.index == asked.index);
  const std::string found = "'" + verdict + "' (" + control.message + ")";
  control.message = holds
                        ? "the verdict is " + found + ", as required"
                        : fmt::format("expected '{}'{} with '{}' (got {})", asked.verdict,
                                      asked.index ? fmt::format(" of entry {}", *asked.index) : "",
                                      asked.message, found);
  control.verdict = holds ? Verdict::pass : Verdict::fail;
  // A negative control never counts as a known discrepancy.
  control.expectation = Expectation::agrees;
  return control;
}

}  // namespace

std::vector<CheckResult> evaluate_check(const Check& check, const CheckContext& context) {
  if (check.negative_control && context.other_solver != nullptr) {
    CheckResult control = failed_check_result(check, "this check tests only trammel's verdicts");
    control.verdict = Verdict::not_given;
    return {control};
  }
  std::vector<CheckResult> entries = evaluate_computed_values(check, context);
  if (check.negative_control) return {judge_negative_control(check, entries)};
  return entries;
}

CheckResult create_check_result(const Check& check) {
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
  CheckResult entry = create_check_result(check);
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

bool counts_as_failure(Verdict verdict) {
  return verdict != Verdict::pass && verdict != Verdict::recorded && verdict != Verdict::not_given;
}

}  // namespace trammel::harness
