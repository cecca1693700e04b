#include "harness/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "harness/base/text.h"
#include "harness/base/statistic.h"

namespace trammel {
namespace {

/// Above so many entries only the worst one is told.
constexpr std::size_t most_entries = 16;

/// Why a check cannot be judged.
struct Unjudgeable {
  std::string message;
};

std::vector<std::string> names_of(const Quantities& quantities) {
  std::vector<std::string> names;
  for (const auto& item : quantities) names.push_back(item.first);
  return names;
}

/// What there is instead, without the parts it belongs to: " (known here: frequency_Hz and ...)".
std::string known_kinds(const Quantities& quantities) {
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
  return " (known here: " + join(kinds, "and") + ")";
}

const std::vector<double>& find_quantity(const Quantities& quantities, const std::string& name,
                                         const std::string& where) {
  const auto found = quantities.find(name);
  if (found != quantities.end()) return found->second.values;
  const std::string guess = did_you_mean(name, names_of(quantities));
  throw Unjudgeable{"no quantity '" + name + "'" + where +
                    (guess.empty() ? known_kinds(quantities) : guess)};
}

std::vector<double> pick(const std::vector<double>& values, const std::vector<std::size_t>& index,
                         const std::string& of) {
  if (index.empty()) return values;
  std::vector<double> picked;
  for (const std::size_t i : index) {
    if (i >= values.size()) {
      throw Unjudgeable{"index " + std::to_string(i) + " is outside of " + of + ", which has " +
                        std::to_string(values.size()) + " entries"};
    }
    picked.push_back(values[i]);
  }
  return picked;
}

/// The numbers to compare, entry by entry.
struct Pairs {
  std::vector<double> computed;
  std::vector<double> expected;     ///< empty: no target
  std::vector<double> uncertainty;  ///< of the expected, absolute; empty where it has none
};

void require_unit(const std::string& quantity, const std::string& unit, const std::string& whose) {
  const std::string its = unit_of(quantity);
  if (its != unit) {
    throw Unjudgeable{"the unit of " + quantity + " is " + its + ", that of " + whose + " is " +
                      unit};
  }
}

void pair_with_reference(const Check& check, const Evidence& evidence, Pairs& pairs) {
  const Reference& reference = find_reference(evidence, check.pointer + "/reference");
  require_unit(check.quantity, reference.unit, "reference " + reference.id);
  pairs.expected = pick(reference.values, check.reference_index, "reference " + reference.id);
  pairs.uncertainty =
      pick(reference.uncertainty, check.reference_index, "reference " + reference.id);
}

void pair_with_run(const Check& check, const Evidence& evidence, Pairs& pairs) {
  const Quantities* other = &evidence.quantities;
  std::string where;
  if (!check.against_variant.empty()) {
    other = evidence.variant(check.against_variant);
    where = " in variant '" + check.against_variant + "'";
    if (other == nullptr) throw Unjudgeable{"no solution" + where + " to compare with"};
  }
  const std::string name = check.against_quantity.empty() ? check.quantity : check.against_quantity;
  require_unit(check.quantity, unit_of(name), name);
  pairs.expected = pick(find_quantity(*other, name, where), check.index, name);
  if (!check.statistic.empty()) {
    pairs.expected = {statistic_of(check.statistic, pairs.expected)};
  }
}

Pairs collect(const Check& check, const Evidence& evidence) {
  Pairs pairs;
  pairs.computed =
      pick(find_quantity(evidence.quantities, check.quantity, ""), check.index, check.quantity);
  if (pairs.computed.empty()) throw Unjudgeable{check.quantity + " has no entries"};
  if (!check.statistic.empty()) pairs.computed = {statistic_of(check.statistic, pairs.computed)};
  if (!check.reference.empty()) pair_with_reference(check, evidence, pairs);
  if (!check.against_variant.empty() || !check.against_quantity.empty()) {
    pair_with_run(check, evidence, pairs);
  }
  if (check.has_target() && pairs.expected.size() != pairs.computed.size()) {
    throw Unjudgeable{"the lengths differ: " + std::to_string(pairs.computed.size()) +
                      " computed, " + std::to_string(pairs.expected.size()) + " expected"};
  }
  if (check.windows.size() > 1 && check.windows.size() != pairs.computed.size()) {
    throw Unjudgeable{"the lengths differ: " + std::to_string(pairs.computed.size()) +
                      " computed, " + std::to_string(check.windows.size()) + " windows"};
  }
  return pairs;
}

double measured(Measure measure, double computed, double expected) {
  switch (measure) {
    case Measure::relative:
      return (computed - expected) / std::abs(expected);
    case Measure::absolute:
      return computed - expected;
    case Measure::ratio:
      return computed / expected;
    case Measure::value:
      return computed;
  }
  return 0;
}

std::string outside(const Check& check, double value, const Window& window) {
  std::string where = shortest(value) + " is outside of [" + shortest(window.low) + ", " +
                      shortest(window.high) + "]";
  if (check.expectation == Expectation::known_discrepancy) {
    return "the known discrepancy is no longer what was recorded: " + where;
  }
  if (check.role == Role::validation) return "the recorded agreement no longer holds: " + where;
  return where;
}

/// Judges one entry into `entry`, whose computed and expected values are set.
void judge_entry(const Check& check, const Window* window, double uncertainty, Judgement& entry) {
  const double expected = entry.expected.value_or(0);
  if (!std::isfinite(*entry.computed)) {
    entry.message = "the computed value is " + shortest(*entry.computed);
    return;
  }
  if (!std::isfinite(expected)) {
    entry.message = "the expected value is " + shortest(expected);
    return;
  }
  const double value = measured(check.measure, *entry.computed, expected);
  if (!std::isfinite(value)) {
    entry.message = "there is no " + std::string(to_string(check.measure)) +
                    " comparison with an expected value of " + shortest(expected);
    return;
  }
  if (check.measure != Measure::value) entry.difference = value;
  if (window == nullptr) {
    entry.verdict = Verdict::recorded;
    return;
  }
  entry.window = *window;
  // Half of a known discrepancy may agree: where the window allows none, it is one.
  if (entry.expectation == Expectation::known_discrepancy && window->contains(0) &&
      (check.measure == Measure::relative || check.measure == Measure::absolute)) {
    entry.expectation = Expectation::agrees;
  }
  const double scale = check.measure == Measure::relative ? std::abs(expected) : 1;
  if (check.role == Role::verification && check.symmetric && uncertainty > window->high * scale) {
    entry.message = "the reference is known to +-" + shortest(uncertainty) +
                    " only, which is more than the tolerance";
    return;
  }
  const bool holds = window->contains(value);
  entry.verdict = holds ? Verdict::pass : Verdict::fail;
  if (!holds) entry.message = outside(check, value, *window);
}

/// How far out an entry lies: errors first, then by the share of the window that is used.
double badness(const Judgement& entry) {
  if (entry.verdict == Verdict::error) return std::numeric_limits<double>::infinity();
  const double value = entry.difference ? *entry.difference : *entry.computed;
  if (!entry.window) return std::abs(value);
  const Window& window = *entry.window;
  if (std::isinf(window.low) || std::isinf(window.high)) {
    return std::isinf(window.low) ? value - window.high : window.low - value;
  }
  const double half = (window.high - window.low) / 2;
  return (std::abs(value - (window.low + half)) - half) / (half > 0 ? half : 1);
}

std::vector<Judgement> worst_of(std::vector<Judgement> entries) {
  const auto worst = std::max_element(
      entries.begin(), entries.end(),
      [](const Judgement& a, const Judgement& b) { return badness(a) < badness(b); });
  Judgement told = *worst;
  told.message = "worst of " + std::to_string(entries.size()) +
                 (told.message.empty() ? "" : ": " + told.message);
  return {told};
}

std::vector<Judgement> judge_entries(const Check& check, const Pairs& pairs) {
  std::vector<Judgement> entries;
  for (std::size_t i = 0; i < pairs.computed.size(); ++i) {
    Judgement entry = start_judgement(check);
    if (check.statistic.empty()) entry.index = check.index.empty() ? i : check.index[i];
    entry.computed = pairs.computed[i];
    if (!pairs.expected.empty()) entry.expected = pairs.expected[i];
    const Window* window =
        check.windows.empty() ? nullptr : &check.windows[check.windows.size() == 1 ? 0 : i];
    judge_entry(check, window, pairs.uncertainty.empty() ? 0 : pairs.uncertainty[i], entry);
    entries.push_back(std::move(entry));
  }
  return entries.size() > most_entries ? worst_of(std::move(entries)) : entries;
}

}  // namespace

Judgement start_judgement(const Check& check) {
  Judgement entry;
  entry.name = check.name;
  entry.title = check.title;
  entry.quantity = check.quantity;
  entry.unit = unit_of(check.quantity);
  entry.statistic = check.statistic;
  entry.reference = check.reference;
  entry.against_variant = check.against_variant;
  entry.against_quantity = check.against_quantity;
  entry.role = check.role;
  entry.measure = to_string(check.measure);
  entry.symmetric = check.symmetric;
  entry.expectation = check.expectation;
  entry.why = check.why;
  return entry;
}

Judgement failed_judgement(const Check& check, const std::string& message) {
  Judgement entry = start_judgement(check);
  entry.message = message;
  return entry;
}

const Reference& find_reference(const Evidence& evidence, const std::string& pointer) {
  std::vector<std::string> tokens;
  for (JsonPointer left(pointer); !left.empty(); left.pop_back()) tokens.push_back(left.back());
  Cursor place(evidence.document);
  std::for_each(tokens.rbegin(), tokens.rend(),
                [&](const std::string& token) { place = place[token]; });
  return evidence.references.get(place);
}

std::vector<Judgement> judge(const Check& check, const Evidence& evidence) {
  try {
    if (check.order) return judge_order(check, evidence);
    return judge_entries(check, collect(check, evidence));
  } catch (const Unjudgeable& reason) {
    return {failed_judgement(check, reason.message)};
  }
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::error:
      return "error";
    case Verdict::not_run:
      return "not-run";
    case Verdict::recorded:
      return "recorded";
  }
  return "";
}

bool breaks_gate(Verdict verdict) {
  return verdict != Verdict::pass && verdict != Verdict::recorded;
}

}  // namespace trammel
