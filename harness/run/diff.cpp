#include "harness/run/diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/quantity.h"

namespace trammel::harness {
namespace {

std::string name_of_entry(const results::Check& check) {
  std::string name = check.name;
  if (!check.quantity.empty()) name += " " + check.quantity;
  if (check.index && check.expected && check.against_variant.empty())
    name += fmt::format("[{}]", *check.index);
  return check.statistic.empty() ? name : name + " " + check.statistic;
}

/// Returns the largest change that counts as round-off: 1e-9 of the value or 1e-6 of its tolerance,
/// whichever is larger. For diagnostic quantities, such as residuals, every change is round-off.
double roundoff_threshold(const results::Check& check) {
  if (is_error_measure(check.quantity)) return HUGE_VAL;
  double width = 0;
  if (check.tolerance)
    for (const results::Number& end : {check.tolerance->low, check.tolerance->high})
      width = std::max(width, std::abs(end.value_or(0)));
  const double size =
      std::max(std::abs(check.computed.value_or(0)), std::abs(check.expected.value_or(0)));
  if (check.measure == "relative") width *= size;
  return std::max(1e-9 * size, 1e-6 * width);
}

}  // namespace

bool Entry::differs(const Entry& other) const {
  if (verdict != other.verdict || value.has_value() != other.value.has_value()) return true;
  return value && !(std::abs(*value - *other.value) <= std::max(noise, other.noise));
}

std::string name_of(const results::Run& run) {
  return run.case_id + ":" + run.variant;
}

void add_entries_of_run(const results::Run& run, const std::string& name, Entries& entries) {
  entries.emplace(name, Entry{to_string(run.status), {}, 0, &run, nullptr});
  for (const results::Check& check : run.checks) {
    const std::string common = name + " " + name_of_entry(check);
    std::string unique = common;
    for (int n = 2; entries.count(unique) > 0; ++n) unique = fmt::format("{} #{}", common, n);
    entries.emplace(unique, Entry{to_string(check.verdict), check.computed,
                                  roundoff_threshold(check), &run, &check});
  }
}

Entries all_entries(const results::Results& results) {
  Entries entries;
  for (const results::Run& run : results.runs) add_entries_of_run(run, name_of(run), entries);
  return entries;
}

std::vector<DiffRow> pair_entries(const Entries& before, const Entries& after) {
  std::map<std::string, DiffRow> rows;
  for (const auto& [name, entry] : before) rows[name] = {name, &entry, nullptr};
  for (const auto& [name, entry] : after) {
    DiffRow& row = rows[name];
    row.name = name;
    row.after = &entry;
  }
  std::vector<DiffRow> all;
  for (auto& item : rows) all.push_back(std::move(item.second));
  return all;
}

}  // namespace trammel::harness
