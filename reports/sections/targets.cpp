#include "reports/sections/targets.h"

#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "reports/data/check_status.h"
#include "reports/data/check_text.h"
#include "reports/sections/check_status_data.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"
#include "reports/text/words.h"

namespace trammel::reports {

namespace {

/// A check against a published target, and the better value of the same entry where there is one.
struct Target {
  const Run* run;
  const Check* check;
  const Check* better = nullptr;
  std::size_t entries = 0;

  [[nodiscard]] double ratio() const { return *check->computed / *check->expected; }
};

bool is_independent(const Reference& reference) {
  return reference.kind == "proved" || reference.kind == "exact" || reference.kind == "computed";
}

bool compares_values(const Check& check) {
  return check.computed && check.expected && *check.expected != 0 &&
         (check.measure == "relative" || check.measure == "absolute" || check.measure == "ratio");
}

const Check* find_better(const Run& run, const Check& target, const Results& results) {
  for (const Check& check : run.checks) {
    const Reference* reference = results.reference(check.reference);
    if (reference && is_independent(*reference) && compares_values(check) &&
        check.quantity == target.quantity && check.statistic == target.statistic &&
        check.index == target.index)
      return &check;
  }
  return nullptr;
}

/// Of the entries of one check the one farthest from its target.
void keep_farthest(std::vector<Target>& targets, const Target& candidate) {
  const auto same = [&](const Target& other) {
    return other.run == candidate.run && other.check->name == candidate.check->name &&
           other.check->quantity == candidate.check->quantity;
  };
  Target& farthest = harness::find_or_add(targets, same, candidate);
  const std::size_t entries = farthest.entries + 1;
  if (std::abs(candidate.ratio() - 1) > std::abs(farthest.ratio() - 1)) farthest = candidate;
  farthest.entries = entries;
}

std::vector<Target> targets_of(const Run& run, const Results& results) {
  std::vector<Target> targets;
  for (const Check& check : run.checks) {
    const Reference* reference = results.reference(check.reference);
    if (!reference || is_independent(*reference) || !compares_values(check)) continue;
    keep_farthest(targets, {&run, &check, find_better(run, check, results)});
  }
  return targets;
}

/// A variant that is compared with the target alone has the better value that another one has.
void share_better_values(std::vector<Target>& targets) {
  for (Target& target : targets) {
    for (const Target& other : targets) {
      if (target.better || !other.better || other.check->reference != target.check->reference ||
          other.check->quantity != target.check->quantity ||
          other.check->expected != target.check->expected)
        continue;
      target.better = other.better;
    }
  }
}

/// As it was printed, where the reference says so.
std::string printed_text(const Target& target, const Results& results) {
  const Reference& reference = *results.reference(target.check->reference);
  for (std::size_t i = 0; i < reference.printed.size() && i < reference.values.size(); ++i)
    if (reference.values[i] == target.check->expected) return reference.printed[i];
  return target_text(*target.check);
}

Data row_of(const Target& target, const CaseInfo& info, const Results& results) {
  const Check& check = *target.check;
  const QuantityLabel quantity = parse_quantity(check.quantity);
  std::string of_what =
      target.run->variant == "base" ? "" : info.variant_title(target.run->variant);
  if (target.entries > 1) {
    add_item(of_what, entry_text(check, target.entries) + " (farthest of " +
                          std::to_string(target.entries) + ")");
  }
  return with_status(
      check_status(check),
      {{"quantity", axis_label(to_text(quantity), quantity.unit)},
       {"of_what", of_what},
       {"target", printed_text(target, results)},
       {"better", target.better ? significant(*target.better->expected, 7) : "–"},
       {"computed", significant(*check.computed, 7)},
       {"ratio", significant(target.ratio(), 5)},
       {"better_ratio",
        target.better ? significant(*check.computed / *target.better->expected, 7) : "–"}});
}

/// Of one case: its base and, in their order, its variants.
Data case_of(const CaseInfo& info, const std::vector<Target>& targets, const Results& results) {
  const auto row = [&](const Target& target) { return row_of(target, info, results); };
  return object({{"case_title", info.title},
                 {"case_link", case_link(info.id)},
                 {"rows", list_of(targets, row)}});
}

bool is_benchmark(const CaseInfo& info) {
  return std::ranges::find(info.labels, "benchmark") != info.labels.end();
}

}  // namespace

Data targets_section(const Results& results, const std::vector<Family>& families) {
  Data cases = list();
  std::size_t n = 0, rows = 0, wrong = 0, without = 0;
  for (const Family& family : families) {
    for (const CaseInfo* info : family.cases) {
      if (!is_benchmark(*info)) continue;
      ++n;
      std::vector<Target> targets;
      for (const Run* run : family.runs_of(info->id)) {
        const std::vector<Target> more = targets_of(*run, results);
        targets.insert(targets.end(), more.begin(), more.end());
      }
      share_better_values(targets);
      const bool known = std::ranges::any_of(targets, [](const Target& target) {
        return target.run->variant == "base" && target.check->known_discrepancy();
      });
      wrong += known ? 1 : 0;
      without += targets.empty() ? 1 : 0;
      rows += targets.size();
      if (!targets.empty()) cases.push_back(case_of(*info, targets, results));
    }
  }
  std::string words = count(n, "published benchmark") + ".";
  if (wrong > 0)
    words += " Of " + std::to_string(wrong) +
             (wrong == 1 ? " the model as it is does" : " the models as they are do") +
             " not reach the printed target, for a recorded reason.";
  if (without > 0)
    words += " " + std::to_string(without) + (without == 1 ? " is" : " are") +
             " judged by closed forms alone and not listed here.";
  return object({{"has_rows", rows > 0}, {"words", words}, {"cases", cases}});
}

}  // namespace trammel::reports
