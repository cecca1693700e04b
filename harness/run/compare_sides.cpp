
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "harness/base/quantity.h"
#include "harness/base/rows.h"
#include "harness/base/statistic.h"
#include "harness/base/text.h"
#include "harness/run/diff.h"
#include "harness/run/stored_results.h"
#include "harness/studies/mode_match.h"

namespace trammel::harness {
namespace {

using results::ComparedModes;
using results::ComparedNumber;
using results::ComparedRun;
using results::ComparedSide;
using results::ComparedValue;
using results::Number;
using results::Numbers;
using results::SideComparison;
/// Runs with the same name, one per compared set of results (side); null: missing.
using Runs = std::vector<const results::Run*>;

/// Smallest assumed round-off error, relative to the largest value of a group of quantities (see
/// `scale_group_name`).
constexpr double kRoundoff = 1e-9;
/// Largest relative round-off error that is taken from the estimates stored with a run. Larger
/// estimates are ignored, because they are not due to round-off.
constexpr double kLargestRoundoff = 1e-6;
/// Largest number of entries of a quantity that are all shown. Of a longer quantity, only the entry
/// with the largest change is shown.
constexpr std::size_t kFewEntries = 6;
/// Maximum number of runs whose series are kept for drawing.
constexpr std::size_t kDrawnRuns = 8;

/// Returns the name of the group of quantities that share a scale. A group contains all quantities
/// with the same unit, but poses and each dimensionless quantity have separate groups.
std::string scale_group_name(const std::string& name) {
  const std::string unit = unit_of(name), head = name.substr(0, name.find(':'));
  return unit == "1" || head.rfind("pose_", 0) == 0 ? head : unit;
}

/// Returns the largest magnitude of each group of quantities over all compared runs.
std::map<std::string, double> series_scales(const Runs& runs) {
  std::map<std::string, double> scales;
  for (const results::Run* run : runs)
    for (const auto& [name, quantity] : run->quantities)
      for (double& scale = scales[scale_group_name(name)]; const Number value : quantity.values)
        scale = std::max(scale, std::abs(value.value_or(0)));
  return scales;
}

/// Returns the relative round-off error of an entry according to a convergence study of the run or
/// its quantity frequency_roundoff; 0 if unknown.
double stated_relative_roundoff(const results::Run& run, const std::string& name, std::size_t i) {
  double stated = 0;
  const auto take = [&](const Numbers& numbers) {
    for (const Number& number : numbers)
      stated = std::max(stated, number && *number < kLargestRoundoff ? *number : 0.0);
  };
  for (const results::Convergence& study : run.convergence)
    if (study.quantity == name && study.index == static_cast<int>(i)) take(study.roundoff);
  if (name.rfind("frequency_Hz", 0) == 0)
    if (const std::vector<double>* own = run.quantity("frequency_roundoff" + name.substr(12)))
      if (i < own->size()) take({(*own)[i]});
  return stated;
}

/// Order of compared runs or numbers: changes above round-off come first, and larger relative
/// changes before smaller ones.
constexpr auto changed_more = [](const auto& a, const auto& b) {
  return std::pair(a.changed, a.share) > std::pair(b.changed, b.share);
};

/// Returns the absolute difference of two numbers: infinity if one of them is missing, 0 if both
/// are missing.
double distance(const Number& a, const Number& b) {
  if (a && b) return std::abs(*b - *a);
  return a || b ? std::numeric_limits<double>::infinity() : 0;
}

/// Sets `share`, `percent` and `changed` of a compared number from its values and `noise`.
/// @param scale  largest value of the group of quantities
void set_change_of_value(ComparedValue& value, double scale) {
  const Number first = value.values.front();
  value.percent.assign(value.values.size(), Number());
  for (std::size_t s = 1; s < value.values.size(); ++s) {
    const Number other = value.values[s];
    const double difference = distance(first, other);
    if (difference > 0) value.share = std::max(value.share, difference / scale);
    value.changed = value.changed || difference > value.noise;
    if (first && other && std::abs(*first) > value.noise)
      value.percent[s] =
          difference > value.noise ? 100 * (*other - *first) / std::abs(*first) : 0.0;
  }
}

ComparedNumber compare_entry(const std::string& name, std::size_t i, const Runs& runs,
                             double scale) {
  ComparedNumber found;
  found.quantity = name;
  found.index = i;
  found.entries = runs.front()->quantity(name)->size();
  found.noise = kRoundoff * scale;
  for (const results::Run* run : runs) {
    found.values.push_back((*run->quantity(name))[i]);
    found.errors.push_back(run->error_half_width(name, i));
    const double roundoff =
        stated_relative_roundoff(*run, name, i) * std::abs(found.values.back().value_or(0));
    found.noise = std::max(found.noise, roundoff);
  }
  set_change_of_value(found, scale);
  return found;
}

/// Compares all entries of a short quantity. For a long quantity, returns only the entry with the
/// largest difference.
std::vector<ComparedNumber> compare_entries(const std::string& name, const Runs& runs,
                                            double scale) {
  const std::vector<double>& first = *runs.front()->quantity(name);
  std::vector<std::size_t> entries(first.size());
  std::iota(entries.begin(), entries.end(), 0);
  if (entries.size() > kFewEntries)
    entries = {*std::ranges::max_element(entries, {}, [&](std::size_t i) {
      double largest = 0;
      for (const results::Run* run : runs)
        largest = std::max(largest, distance(first[i], (*run->quantity(name))[i]));
      return largest;
    })};
  std::vector<ComparedNumber> found;
  for (const std::size_t i : entries) found.push_back(compare_entry(name, i, runs, scale));
  return found;
}

void compare_numbers(const Runs& runs, const std::vector<std::string>& labels, ComparedRun& found) {
  std::set<std::string> names;
  for (const results::Run* run : runs)
    for (const auto& quantity : run->quantities)
      if (!is_error_measure(quantity.first)) names.insert(quantity.first);
  const std::map<std::string, double> scales = series_scales(runs);
  // Missing quantities, by the label of the results that lack them.
  std::map<std::string, std::vector<std::string>> absent;
  for (const std::string& name : names) {
    std::vector<std::string> without, sizes;
    for (std::size_t s = 0; s < runs.size(); ++s) {
      const std::vector<double>* values = runs[s]->quantity(name);
      values ? sizes.push_back(std::to_string(values->size())) : without.push_back(labels[s]);
    }
    if (!without.empty()) {
      absent[join(without, "and")].push_back(name);
    } else if (std::set(sizes.begin(), sizes.end()).size() > 1) {
      found.remarks.push_back(name + " has " + join(sizes, "and") + " entries");
    } else {
      std::ranges::move(compare_entries(name, runs, scales.at(scale_group_name(name))),
                        std::back_inserter(found.numbers));
    }
  }
  for (const auto& [sides, missing] : absent)
    found.remarks.push_back("missing from " + sides + ": " + join(missing, "and"));
}

std::vector<std::size_t> convert_to_one_based(std::vector<std::size_t> numbers) {
  for (std::size_t& number : numbers) ++number;
  return numbers;
}

/// Matches the modes of all compared runs with those of the first run; empty if mode shapes are
/// missing.
std::vector<ComparedModes> compare_modes(const Runs& runs) {
  std::vector<ComparedModes> rows;
  const std::vector<double>& known = *runs.front()->quantity("frequency_Hz");
  double largest = 0;
  for (std::size_t s = 1; s < runs.size(); ++s) {
    if (!runs.front()->drawing || !runs[s]->drawing) return {};
    const auto [a, b] = sample_modes(known, *runs.front()->drawing,
                                     *runs[s]->quantity("frequency_Hz"), *runs[s]->drawing);
    if (a.shape.rows() == 0) return {};
    std::size_t row = 0;
    for (const ModeMatch& match : match_modes(a, b)) {
      const double first = a.frequency[match.a.front()];
      largest = std::max(largest, std::abs(first));
      if (s == 1) {
        rows.emplace_back();
        rows.back().modes = {convert_to_one_based(match.a)};
        rows.back().values = {first};
        rows.back().last = {Number()};
        rows.back().errors = {runs.front()->error_half_width("frequency_Hz", match.a.front())};
        rows.back().alike = {1.0};
      }
      ComparedModes& found = rows.at(row++);
      found.modes.push_back(convert_to_one_based(match.b));
      const bool there = !match.b.empty();
      const double low = there ? b.frequency[match.b.front()] : 0;
      const double high = there ? b.frequency[match.b.back()] : 0;
      found.values.push_back(there ? Number(low) : Number());
      found.errors.push_back(there ? runs[s]->error_half_width("frequency_Hz", match.b.front())
                                   : Number());
      found.last.push_back(high - low > 1e-6 * high ? Number(high) : Number());
      found.alike.push_back(there ? Number(match.overlap) : Number());
      const double stated = stated_relative_roundoff(*runs[s], "frequency_Hz", match.a.front());
      found.noise = std::max({found.noise, stated * first, kRoundoff * largest});
    }
    if (row != rows.size()) return {};
  }
  for (ComparedModes& found : rows) set_change_of_value(found, largest);
  return rows;
}

/// Compares the frequencies of modes with similar shapes instead of equal numbers, if frequencies
/// have changed or if variants are compared.
void match_modes_by_shape(const Runs& runs, bool are_variants, ComparedRun& found) {
  const auto by_number = [](const ComparedNumber& number) {
    return number.quantity == "frequency_Hz" || number.quantity == "frequency_gap";
  };
  const bool changed = std::ranges::any_of(found.numbers, [](const ComparedNumber& number) {
    return number.quantity == "frequency_Hz" && number.changed;
  });
  if (are_variants ? found.info.analysis != "modes" : !changed) return;
  if (std::ranges::any_of(runs,
                          [](const auto* run) { return run->quantity("frequency_Hz") == nullptr; }))
    return;
  found.modes = compare_modes(runs);
  const std::size_t count = found.modes.empty() ? 0 : found.modes.back().modes[0].back();
  std::erase_if(found.numbers,
                [&](const ComparedNumber& n) { return by_number(n) && n.index < count; });
}

/// Adds remarks about changed statuses of runs, and about at most three changed verdicts of checks
/// per compared run.
void diff_verdicts(const Runs& runs, const std::vector<std::string>& labels, ComparedRun& found) {
  Entries first;
  add_entries_of_run(*runs.front(), found.name, first);
  for (std::size_t s = 1; s < runs.size(); ++s) {
    Entries other;
    add_entries_of_run(*runs[s], found.name, other);
    std::set<std::string> checks;
    for (const DiffRow& row : pair_entries(first, other)) {
      if (!row.is_in_both() || row.before->verdict == row.after->verdict) continue;
      const std::string check = row.is_run() ? "" : row.after->check->name;
      if (!row.is_run() && (checks.size() >= 3 || !checks.insert(check).second)) continue;
      found.remarks.push_back(
          fmt::format("{}{} in {}, {} in {}", row.is_run() ? "ends " : "check " + check + ": ",
                      row.after->verdict, labels[s], row.before->verdict, labels.front()));
    }
  }
}

bool are_bit_identical(const Runs& runs) {
  const auto number = [](double value) { return Number(value); };  // makes NaN equal to NaN
  return std::ranges::all_of(runs, [&](const results::Run* run) {
    const auto same = [&](const auto& a, const auto& b) {
      return a.first == b.first &&
             std::ranges::equal(a.second.values, b.second.values, {}, number, number);
    };
    return run->status == runs.front()->status &&
           std::ranges::equal(run->quantities, runs.front()->quantities, same);
  });
}

ComparedRun compare_runs(const std::string& name, const Runs& runs,
                         const std::vector<std::string>& labels, bool are_variants,
                         results::CaseInfo info) {
  ComparedRun found;
  found.name = name;
  found.info = std::move(info);
  if (are_variants || !are_bit_identical(runs)) compare_numbers(runs, labels, found);
  match_modes_by_shape(runs, are_variants, found);
  if (!are_variants) diff_verdicts(runs, labels, found);
  found.changed = !found.remarks.empty();
  const auto count = [&](const ComparedValue& value) {
    if (value.changed) found.share = std::max(found.share, value.share);
    found.changed = found.changed || value.changed;
  };
  for (const ComparedNumber& number : found.numbers) count(number);
  for (const ComparedModes& modes : found.modes) count(modes);
  std::ranges::stable_sort(found.numbers, changed_more);
  return found;
}

/// Returns the errors of a run relative to reference values, by the name of the check entry.
std::map<std::string, double> errors_of_checks(const std::string& name, const results::Run& run) {
  Entries entries;
  add_entries_of_run(run, name, entries);
  std::map<std::string, double> errors;
  for (const auto& [entry_name, entry] : entries) {
    const results::Check* check = entry.check;
    if (check == nullptr || check->reference.empty() || !check->computed || !check->expected ||
        *check->expected == 0)
      continue;
    errors[entry_name] = std::abs(*check->computed - *check->expected) / std::abs(*check->expected);
  }
  return errors;
}

/// Computes the median and the largest error of each compared set of results (side), over the
/// reference values that all sets use.
void compare_errors(const std::vector<std::map<std::string, double>>& all,
                    std::vector<ComparedSide>& sides) {
  std::vector<std::vector<double>> errors(sides.size());
  for (const auto& item : all.front()) {
    const auto has_entry = [&](const auto& other) { return other.contains(item.first); };
    for (std::size_t s = 0; s < sides.size() && std::ranges::all_of(all, has_entry); ++s)
      errors[s].push_back(std::max(all[s].at(item.first), 1e-16));
  }
  if (errors.front().empty()) return;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    sides[s].median_error = quantile(errors[s], 0.5);
    sides[s].largest_error = quantile(errors[s], 1);
  }
}

ComparedSide side_of(const Side& side) {
  ComparedSide found;
  const results::Environment& environment = side.results.environment;
  found.label = side.label;
  found.runs = side.results.runs.size();
  if (side.document) return found;  // this call of trammel computed these results
  found.commit = environment.commit;
  found.date = environment.date;
  found.processor = environment.processor;
  if (side.results.solver) found.solver = side.results.solver->name;
  return found;
}

/// Returns a text such as "frequency of mode 3 by +12 % (81.2 to 91.1 Hz)".
std::string words_of(const ComparedValue& value, const std::string& name, const std::string& unit,
                     const std::vector<ComparedSide>& sides) {
  const Number from = value.values.front();
  const auto worst = std::ranges::max_element(value.values.begin() + 1, value.values.end(), {},
                                              [&](const Number& n) { return distance(from, n); });
  const std::size_t side = static_cast<std::size_t>(worst - value.values.begin());
  int digits = 4;
  while (from && *worst && digits < 12 && rounded(*from, digits) == rounded(**worst, digits))
    ++digits;
  const auto number = [&](const Number& n) { return n ? rounded(*n, digits) : "none"; };
  return fmt::format("{}{}{} ({} to {}{})", name,
                     value.percent[side] ? fmt::format(" by {:+.3g} %", *value.percent[side]) : "",
                     sides.size() > 2 ? " in " + sides[side].label : "", number(from),
                     number(*worst), unit == "1" ? "" : " " + unit);
}

/// Returns a text about the largest change of a mode of the run. If no mode has changed, describes
/// the largest change of a number. If no number has changed, returns the first remark.
std::string describe_change(const ComparedRun& run, const std::vector<ComparedSide>& sides) {
  const auto mode = std::ranges::max_element(
      run.modes, {}, [](const ComparedModes& m) { return m.changed ? m.share : -1; });
  if (mode != run.modes.end() && mode->changed)
    return words_of(*mode, fmt::format("the frequency of mode {}", mode->modes[0].front()), "Hz",
                    sides);
  if (run.numbers.empty() || !run.numbers.front().changed)
    return run.remarks.empty() ? "" : run.remarks.front();
  const ComparedNumber& number = run.numbers.front();
  const std::string entry = number.entries > 1 ? fmt::format("[{}]", number.index) : "";
  return words_of(number, number.quantity + entry, unit_of(number.quantity), sides);
}

/// Summarizes the changes between runs with the same names.
std::string conclusion_of_runs(const SideComparison& comparison) {
  const std::size_t all = comparison.same + comparison.within_noise + comparison.changed;
  const std::string same =
      fmt::format("{} {} the same bit for bit, {} {} by round-off",
                  count_of(comparison.same, "run"), comparison.same == 1 ? "is" : "are",
                  comparison.within_noise, comparison.within_noise == 1 ? "differs" : "differ");
  if (comparison.changed == 0) return "Nothing has changed: " + same;
  const ComparedRun& first = comparison.runs.front();
  return fmt::format("{} of {} changed beyond round-off, most {}: {}; {}", comparison.changed,
                     count_of(all, "run"), first.name, describe_change(first, comparison.sides),
                     same);
}

/// Summarizes the differences between variants.
std::string conclusion_of_variants(const SideComparison& comparison) {
  const auto& sides = comparison.sides;
  const std::string other =
      sides.size() == 2 ? sides.back().label : std::to_string(sides.size() - 1) + " others";
  const ComparedRun& run = comparison.runs.front();
  const auto changed = [](const auto& values) {
    return std::ranges::count_if(values, [](const auto& v) { return v.changed; });
  };
  const auto count = changed(run.numbers) + changed(run.modes);
  const std::size_t all = run.numbers.size() + run.modes.size();
  if (count == 0 && run.remarks.empty())
    return other + " and " + sides.front().label + " differ by no more than round-off";
  return fmt::format("{} against {}: {} of {} numbers differ beyond round-off, most {}", other,
                     sides.front().label, count, all, describe_change(run, sides));
}

/// Groups the runs of all compared sets of results by name. Runs that this call of the program has
/// computed form one group, because the names of compared variants differ.
std::map<std::string, Runs> runs_by_name(std::vector<Side>& sides) {
  std::map<std::string, Runs> by_name;
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (const results::Run& run : sides[s].results.runs) {
      const bool variants = sides[s].document.has_value();
      Runs& runs = by_name[variants ? sides[0].label : name_of(run)];
      runs.resize(sides.size(), nullptr);
      runs[s] = &run;
    }
  return by_name;
}

/// Loads the series of runs from the store. If the series of one run are missing from the store,
/// removes the series of all runs.
/// @returns the number of runs without stored series
std::size_t load_series(std::vector<results::Run>& runs, const std::vector<Side>& sides) {
  std::size_t lost = 0;
  for (std::size_t s = 0; s < runs.size(); ++s)
    if (!runs[s].stored.empty() && !load_stored_data(runs[s], sides[s].results.store)) ++lost;
  if (lost > 0)
    for (results::Run& run : runs)
      std::erase_if(run.quantities, [](const auto& q) {
        return q.second.values.size() > results::kSummaryEntries;
      });
  return lost;
}

void sort_and_drop(SideComparison& comparison) {
  std::ranges::stable_sort(comparison.runs, changed_more);
  for (std::size_t i = kDrawnRuns; i < comparison.runs.size(); ++i) comparison.runs[i].runs.clear();
}

}  // namespace

SideComparison compare_sides(std::vector<Side> sides, bool series) {
  SideComparison comparison;
  std::vector<std::string> labels;
  const bool are_variants = sides.front().document.has_value();
  for (const Side& side : sides) {
    comparison.sides.push_back(side_of(side));
    labels.push_back(side.label);
  }
  std::vector<std::map<std::string, double>> errors(sides.size());
  std::size_t lost = 0;
  for (const auto& [name, there] : runs_by_name(sides)) {
    std::vector<std::string> without;
    std::vector<results::Run> runs;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      if (there[s] == nullptr) without.push_back(labels[s]);
      if (there[s] != nullptr) runs.push_back(*there[s]);
    }
    ComparedRun found;
    found.name = name;
    found.remarks = {"missing from " + join(without, "and")};
    found.changed = true;
    if (without.empty()) {
      lost += load_series(runs, sides);
      Runs loaded;
      for (const results::Run& run : runs) loaded.push_back(&run);
      for (std::size_t s = 0; s < sides.size(); ++s) {
        errors[s].merge(errors_of_checks(name, runs[s]));
        comparison.sides[s].cpu_s += runs[s].cost.cpu_s;
        comparison.sides[s].work += runs[s].cost.counted_work();
      }
      found = compare_runs(name, loaded, labels, are_variants,
                           sides.front().results.case_info(runs.front().case_id));
      if (are_bit_identical(loaded) && !found.changed && !are_variants) {
        ++comparison.same;
        continue;
      }
      if (series) found.runs = std::move(runs);
    }
    ++(found.changed ? comparison.changed : comparison.within_noise);
    comparison.runs.push_back(std::move(found));
    if (comparison.runs.size() > 2 * kDrawnRuns) sort_and_drop(comparison);
  }
  sort_and_drop(comparison);
  for (ComparedSide& side : comparison.sides)
    if (comparison.sides.front().cpu_s > 0)
      side.relative_time = side.cpu_s / comparison.sides.front().cpu_s;
  compare_errors(errors, comparison.sides);
  comparison.conclusion =
      (are_variants ? conclusion_of_variants(comparison) : conclusion_of_runs(comparison)) +
      (lost > 0 ? "; " + count_of(lost, "run") + " without series, which the stores lack" : "") +
      ".";
  return comparison;
}

}  // namespace trammel::harness
