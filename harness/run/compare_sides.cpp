#include "harness/run/compare_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "harness/base/quantity.h"
#include "harness/base/text.h"
#include "harness/base/timing.h"
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
using Runs =
    std::vector<const results::Run*>;  ///< of one name, a side each; null where it has none

/// Values below this share of the largest of their series are zeros but for round-off.
constexpr double kRoundoff = 1e-9;
/// What is stated to be round-off is no more than this, relative.
constexpr double kLargestRoundoff = 1e-6;
constexpr std::size_t kFewEntries = 6;  ///< that are all listed
constexpr std::size_t kDrawnRuns = 8;   ///< whose series are kept

/// What a quantity's values are compared with: all of its unit, but poses with poses, and numbers
/// without a unit with themselves.
std::string series_of(const std::string& name) {
  const std::string unit = unit_of(name), head = name.substr(0, name.find(':'));
  return unit == "1" || head.rfind("pose_", 0) == 0 ? head : unit;
}

/// The largest magnitude of each series on any side.
std::map<std::string, double> series_scales(const Runs& runs) {
  std::map<std::string, double> scales;
  for (const results::Run* run : runs)
    for (const auto& [name, quantity] : run->quantities) {
      double& scale = scales[series_of(name)];
      for (const Number value : quantity.values)
        if (value) scale = std::max(scale, std::abs(*value));
    }
  return scales;
}

/// The relative round-off that a run states of an entry, in refinements or as a quantity of its
/// own.
double stated_roundoff(const results::Run& run, const std::string& name, std::size_t i) {
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

/// The difference that the checks of a run allow because of round-off.
double allowed_by_checks(const results::Run& run, const std::string& name, std::size_t i) {
  double allowed = 0;
  for (const results::Check& check : run.checks) {
    const bool here =
        check.quantity == name && (!check.index || *check.index == static_cast<int>(i));
    if (!here || !check.tolerance || !check.tolerance->symmetric || !check.expected) continue;
    if (check.why.find("ound-off") == std::string::npos) continue;
    const double size = std::abs(*check.expected), high = check.tolerance->high.value_or(0);
    const double width = check.measure == "relative" ? high * size : high;
    if (check.measure != "relative" && check.measure != "absolute") continue;
    if (width <= kLargestRoundoff * size) allowed = std::max(allowed, width);
  }
  return allowed;
}

/// What is to be said of values whose `noise` is known.
/// @param scale  the largest value of the series
void judge(ComparedValue& value, double scale) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Number first = value.values.front();
  value.percent.assign(value.values.size(), Number());
  for (std::size_t s = 1; s < value.values.size(); ++s) {
    const Number other = value.values[s];
    const double difference = first && other   ? std::abs(*other - *first)
                              : first || other ? kInfinite
                                               : 0;
    if (difference > 0)
      value.share = std::max(value.share, scale > 0 ? difference / scale : kInfinite);
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
    const double roundoff =
        stated_roundoff(*run, name, i) * std::abs(found.values.back().value_or(0));
    found.noise = std::max({found.noise, roundoff, allowed_by_checks(*run, name, i)});
  }
  judge(found, scale);
  return found;
}

/// All of a few entries; of many the one that differs most.
std::vector<ComparedNumber> compare_entries(const std::string& name, const Runs& runs,
                                            double scale) {
  const std::vector<double>& first = *runs.front()->quantity(name);
  std::vector<std::size_t> entries;
  if (first.size() <= kFewEntries) {
    for (std::size_t i = 0; i < first.size(); ++i) entries.push_back(i);
  } else {
    std::pair<double, std::size_t> worst{-1, 0};
    for (const results::Run* run : runs)
      for (std::size_t i = 0; i < first.size(); ++i) {
        const Number own = first[i], other = (*run->quantity(name))[i];
        const double away = own && other ? std::abs(*other - *own) : (own || other ? HUGE_VAL : 0);
        if (away > worst.first) worst = {away, i};
      }
    entries.push_back(worst.second);
  }
  std::vector<ComparedNumber> found;
  for (const std::size_t i : entries) found.push_back(compare_entry(name, i, runs, scale));
  return found;
}

void add_numbers(const Runs& runs, const std::vector<std::string>& labels, ComparedRun& found) {
  std::set<std::string> names;
  for (const results::Run* run : runs)
    for (const auto& quantity : run->quantities)
      if (!is_diagnostic(quantity.first)) names.insert(quantity.first);
  const std::map<std::string, double> scales = series_scales(runs);
  std::map<std::string, std::vector<std::string>> absent;  // by the sides that lack them
  for (const std::string& name : names) {
    std::vector<std::string> without, sizes;
    for (std::size_t s = 0; s < runs.size(); ++s) {
      const std::vector<double>* values = runs[s]->quantity(name);
      if (values == nullptr) without.push_back(labels[s]);
      if (values != nullptr) sizes.push_back(std::to_string(values->size()));
    }
    if (!without.empty()) {
      absent[join(without, "and")].push_back(name);
    } else if (std::set(sizes.begin(), sizes.end()).size() > 1) {
      found.remarks.push_back(name + " has " + join(sizes, "and") + " entries");
    } else {
      for (ComparedNumber& number : compare_entries(name, runs, scales.at(series_of(name))))
        found.numbers.push_back(std::move(number));
    }
  }
  for (const auto& [sides, missing] : absent)
    found.remarks.push_back("not in " + sides + ": " + join(missing, "and"));
}

/// Modes as they are drawn, where both sides draw the same nodes.
std::optional<SampledModes> drawn_modes(const results::Run& run, const results::Run& like) {
  const std::vector<double>* frequency = run.quantity("frequency_Hz");
  if (!run.drawing || !like.drawing || frequency == nullptr) return std::nullopt;
  if (run.drawing->nodes != like.drawing->nodes) return std::nullopt;
  const auto& shapes = run.drawing->shapes;
  std::size_t count = std::min(shapes.size(), frequency->size());
  const auto repeats = [&](std::size_t i) {
    const auto hertz = [&](std::size_t k) { return Number((*frequency)[k]).value_or(0); };
    return hertz(i) - hertz(i - 1) <= 1e-6 * hertz(i);
  };
  // A set of which only some are drawn has no subspace.
  if (count < frequency->size())
    while (count > 0 && repeats(count)) --count;
  SampledModes modes;
  modes.shape.resize(2 * static_cast<Eigen::Index>(run.drawing->nodes.size()),
                     static_cast<Eigen::Index>(count));
  for (std::size_t m = 0; m < count; ++m) {
    modes.frequency.push_back((*frequency)[m]);
    Eigen::Index row = 0;
    for (const auto& [x, y] : shapes[m].displacement)
      for (const double u : {x, y})
        modes.shape(row++, static_cast<Eigen::Index>(m)) = std::isfinite(u) ? u : 0;
  }
  return modes;
}

/// Whether modes solved for anew are those of the run: not those of a rotating or loaded one.
bool are_of(const SampledModes& modes, const results::Run& run) {
  const std::vector<double>& known = *run.quantity("frequency_Hz");
  for (std::size_t i = 0; i < known.size(); ++i)
    if (i >= modes.frequency.size() ||
        !(std::abs(modes.frequency[i] - known[i]) <= 1e-6 * (1 + std::abs(known[i]))))
      return false;
  return true;
}

using Sampled = std::optional<std::pair<SampledModes, SampledModes>>;

Sampled sample(const results::Run& a, const results::Run& b, const Document* document_a,
               const Document* document_b) {
  if (document_a != nullptr && document_b != nullptr) {
    auto both = sample_modes(*document_a, *document_b);
    if (are_of(both.first, a) && are_of(both.second, b)) return both;
  }
  auto drawn_a = drawn_modes(a, b), drawn_b = drawn_modes(b, a);
  if (!drawn_a || !drawn_b) return std::nullopt;
  return std::pair{std::move(*drawn_a), std::move(*drawn_b)};
}

std::vector<std::size_t> from_one(std::vector<std::size_t> numbers) {
  for (std::size_t& number : numbers) ++number;
  return numbers;
}

/// Modes of all sides matched with those of the first; empty where they cannot be.
std::vector<ComparedModes> compare_modes(const Runs& runs,
                                         const std::vector<const Document*>& documents) {
  std::vector<ComparedModes> rows;
  const std::vector<double>& known = *runs.front()->quantity("frequency_Hz");
  double largest = 0;
  for (std::size_t s = 1; s < runs.size(); ++s) {
    const Sampled both = sample(*runs.front(), *runs[s], documents.front(), documents[s]);
    if (!both) return {};
    std::size_t row = 0;
    for (const ModeMatch& match : match_modes(both->first, both->second)) {
      if (match.a.front() >= known.size()) break;
      const double first = both->first.frequency[match.a.front()];
      largest = std::max(largest, std::abs(first));
      if (s == 1) {
        rows.emplace_back();
        rows.back().modes = {from_one(match.a)};
        rows.back().values = {first};
        rows.back().last = {Number()};
        rows.back().alike = {1.0};
      }
      ComparedModes& found = rows.at(row++);
      found.modes.push_back(from_one(match.b));
      const bool there = !match.b.empty();
      const double low = there ? both->second.frequency[match.b.front()] : 0;
      const double high = there ? both->second.frequency[match.b.back()] : 0;
      found.values.push_back(there ? Number(low) : Number());
      found.last.push_back(high - low > 1e-6 * high ? Number(high) : Number());
      found.alike.push_back(there ? Number(match.overlap) : Number());
      const double stated = stated_roundoff(*runs[s], "frequency_Hz", match.a.front());
      found.noise = std::max({found.noise, stated * first, kRoundoff * largest});
    }
    if (row != rows.size()) return {};
  }
  for (ComparedModes& found : rows) judge(found, largest);
  return rows;
}

void match_by_shape(const Runs& runs, const std::vector<const Document*>& documents,
                    ComparedRun& found) {
  const auto is_frequency = [](const ComparedNumber& number) {
    return number.quantity == "frequency_Hz";
  };
  const bool there = std::ranges::all_of(
      runs, [](const results::Run* run) { return run->quantity("frequency_Hz") != nullptr; });
  const bool changed = std::ranges::any_of(
      found.numbers, [&](const auto& n) { return is_frequency(n) && n.changed; });
  const bool computed = documents.front() != nullptr;
  if (!there || (!changed && !computed)) return;
  if (computed && found.info.analysis != "modes") return;
  found.modes = compare_modes(runs, documents);
  if (found.modes.empty()) return;
  const auto by_number = [&](const ComparedNumber& number) {
    return is_frequency(number) || number.quantity == "frequency_gap";
  };
  std::erase_if(found.numbers, by_number);
}

/// "deflection[2] passes, failed before", at most three of them.
void add_verdicts(const Runs& runs, const std::vector<std::string>& labels, ComparedRun& found) {
  using Key = std::tuple<std::string, std::string, std::optional<int>>;
  std::map<Key, results::Verdict> before;
  for (const results::Check& check : runs.front()->checks)
    before.emplace(Key{check.name, check.quantity, check.index}, check.verdict);
  for (std::size_t s = 1; s < runs.size(); ++s) {
    if (runs[s]->status != runs.front()->status)
      found.remarks.push_back("ends " + to_string(runs[s]->status) + " in " + labels[s] + ", " +
                              to_string(runs.front()->status) + " in " + labels.front());
    std::set<std::string> said;
    for (const results::Check& check : runs[s]->checks) {
      const auto known = before.find({check.name, check.quantity, check.index});
      if (known == before.end() || known->second == check.verdict) continue;
      if (said.size() >= 3 || !said.insert(check.name).second) continue;
      found.remarks.push_back("check " + check.name + ": " + to_string(check.verdict) + " in " +
                              labels[s] + ", " + to_string(known->second) + " in " +
                              labels.front());
    }
  }
}

Number number_of(double value) {
  return value;
}

bool same_bits(const Runs& runs) {
  return std::ranges::all_of(runs, [&](const results::Run* run) {
    const auto same = [](const auto& a, const auto& b) {
      return a.first == b.first &&
             std::ranges::equal(a.second.values, b.second.values, {}, number_of, number_of);
    };
    return run->status == runs.front()->status &&
           std::ranges::equal(run->quantities, runs.front()->quantities, same);
  });
}

ComparedRun compare_runs(const std::string& name, const Runs& runs,
                         const std::vector<std::string>& labels,
                         const std::vector<const Document*>& documents, results::CaseInfo info) {
  ComparedRun found;
  found.name = name;
  found.info = std::move(info);
  if (documents.front() != nullptr || !same_bits(runs)) add_numbers(runs, labels, found);
  match_by_shape(runs, documents, found);
  if (documents.front() == nullptr) add_verdicts(runs, labels, found);
  found.changed = !found.remarks.empty();
  const auto count = [&](const ComparedValue& value) {
    if (value.changed) found.share = std::max(found.share, value.share);
    found.changed = found.changed || value.changed;
  };
  for (const ComparedNumber& number : found.numbers) count(number);
  for (const ComparedModes& modes : found.modes) count(modes);
  std::ranges::stable_sort(found.numbers, [](const auto& a, const auto& b) {
    return std::pair(a.changed, a.share) > std::pair(b.changed, b.share);
  });
  return found;
}

/// Relative errors against references by check entry.
std::map<std::string, double> errors_of(const std::string& name, const results::Run& run) {
  std::map<std::string, double> errors;
  for (const results::Check& check : run.checks) {
    if (check.reference.empty() || !check.computed || !check.expected || *check.expected == 0)
      continue;
    const std::string key = fmt::format("{} {} {} {} {}", name, check.name, check.quantity,
                                        check.statistic, check.index.value_or(-1));
    errors[key] = std::abs(*check.computed - *check.expected) / std::abs(*check.expected);
  }
  return errors;
}

/// What the sides come to in all: time and work of the runs that all have, and errors of what
/// references are there for on all of them.
class Totals {
 public:
  explicit Totals(std::size_t sides) : errors_(sides), time_(sides), work_(sides) {}

  void add(const std::string& name, const Runs& runs) {
    for (std::size_t s = 0; s < runs.size(); ++s) {
      errors_[s].merge(errors_of(name, *runs[s]));
      time_[s] += runs[s]->cost.cpu_s;
      for (const auto& counter : runs[s]->cost.counters) work_[s] += counter.second;
    }
  }

  void put(std::vector<ComparedSide>& sides) const {
    std::vector<Timing> common(sides.size());  // errors in place of times
    for (const auto& item : errors_.front())
      if (std::ranges::all_of(errors_,
                              [&](const auto& other) { return other.count(item.first) > 0; }))
        for (std::size_t s = 0; s < sides.size(); ++s)
          common[s].cpu_s.push_back(std::max(errors_[s].at(item.first), 1e-16));
    for (std::size_t s = 0; s < sides.size(); ++s) {
      sides[s].cpu_s = time_[s];
      sides[s].work = work_[s];
      if (time_.front() > 0) sides[s].relative_time = time_[s] / time_.front();
      if (common[s].cpu_s.empty()) continue;
      sides[s].median_error = quantile(common[s].cpu_s, 0.5);
      sides[s].largest_error = quantile(common[s].cpu_s, 1);
    }
    if (!common.front().cpu_s.empty()) rank(common, sides);
  }

 private:
  /// Those that cannot be told from the better one before them share its rank.
  static void rank(const std::vector<Timing>& errors, std::vector<ComparedSide>& sides) {
    constexpr std::size_t kFewest = 7;  // that an interval can be told from
    std::vector<std::size_t> order(sides.size());
    for (std::size_t s = 0; s < order.size(); ++s) order[s] = s;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return sides[a].median_error < sides[b].median_error;
    });
    std::size_t head = order.front();  // of those that share a rank
    for (std::size_t place = 0; place < order.size(); ++place) {
      ComparedSide& side = sides[order[place]];
      bool apart = place > 0;
      if (errors.front().cpu_s.size() >= kFewest) {
        const RelativeTime ratio = relative_time(errors[order[place]], errors[order.front()]);
        side.error_ratio = {ratio.median, ratio.low, ratio.high};
        apart = apart && relative_time(errors[order[place]], errors[head]).low > 1;
      } else {
        apart = false;
      }
      if (apart) head = order[place];
      side.rank = place == 0 ? 1 : apart ? place + 1 : sides[order[place - 1]].rank;
    }
  }

  std::vector<std::map<std::string, double>> errors_;
  std::vector<double> time_;
  std::vector<std::size_t> work_;
};

ComparedSide side_of(const Side& side) {
  ComparedSide found;
  const results::Environment& environment = side.results.environment;
  found.label = side.label;
  found.runs = side.results.runs.size();
  if (side.document) return found;  // computed here and now
  found.commit = environment.commit;
  found.date = environment.date;
  found.processor = environment.processor;
  if (side.results.solver) found.solver = side.results.solver->name;
  return found;
}

/// "frequency of mode 3 by +12 % (81.2 to 91.1 Hz)"
std::string words_of(const ComparedValue& value, const std::string& name, const std::string& unit,
                     const std::vector<ComparedSide>& sides) {
  std::size_t worst = 1;
  const auto away = [&](std::size_t s) {
    const Number a = value.values.front(), b = value.values[s];
    return a && b ? std::abs(*b - *a) : a || b ? HUGE_VAL : 0;
  };
  for (std::size_t s = 2; s < value.values.size(); ++s)
    if (away(s) > away(worst)) worst = s;
  const Number from = value.values.front(), to = value.values[worst];
  int digits = 4;
  while (from && to && digits < 12 && rounded(*from, digits) == rounded(*to, digits)) ++digits;
  const auto number = [&](const Number& n) { return n ? rounded(*n, digits) : "none"; };
  std::string text = name;
  if (value.percent[worst]) text += fmt::format(" by {:+.3g} %", *value.percent[worst]);
  if (sides.size() > 2) text += " in " + sides[worst].label;
  return text + " (" + number(from) + " to " + number(to) + (unit == "1" ? "" : " " + unit) + ")";
}

/// What has changed most in a run.
std::string most_changed(const ComparedRun& run, const std::vector<ComparedSide>& sides) {
  const ComparedModes* modes = nullptr;
  for (const ComparedModes& one : run.modes)
    if (one.changed && (modes == nullptr || one.share > modes->share)) modes = &one;
  if (modes != nullptr)
    return words_of(*modes, "the frequency of mode " + std::to_string(modes->modes[0].front()),
                    "Hz", sides);
  if (!run.numbers.empty() && run.numbers.front().changed) {
    const ComparedNumber& number = run.numbers.front();
    const std::string entry = number.entries > 1 ? "[" + std::to_string(number.index) + "]" : "";
    return words_of(number, number.quantity + entry, unit_of(number.quantity), sides);
  }
  return run.remarks.empty() ? "" : run.remarks.front();
}

std::string runs_text(std::size_t n) {
  return std::to_string(n) + (n == 1 ? " run" : " runs");
}

/// What the same names have become.
std::string conclusion_of_runs(const SideComparison& comparison) {
  const std::size_t all = comparison.same + comparison.within_noise + comparison.changed;
  const std::string same = runs_text(comparison.same) + (comparison.same == 1 ? " is" : " are") +
                           " the same bit for bit, " + std::to_string(comparison.within_noise) +
                           (comparison.within_noise == 1 ? " differs" : " differ") +
                           " by round-off";
  if (comparison.changed == 0) return "Nothing has changed: " + same;
  const ComparedRun& first = comparison.runs.front();
  return fmt::format("{} of {} changed beyond round-off, most {}: {}; {}", comparison.changed,
                     runs_text(all), first.name, most_changed(first, comparison.sides), same);
}

/// What one variant makes of another.
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
                     sides.front().label, count, all, most_changed(run, sides));
}

/// Of two sides; one measurement of a short time says nothing.
std::string time_text(const std::vector<ComparedSide>& sides) {
  constexpr double kShort_s = 0.1;
  if (sides.size() != 2 || std::min(sides.front().cpu_s, sides.back().cpu_s) < kShort_s) return "";
  const bool elsewhere = sides.front().processor != sides.back().processor;
  return fmt::format("; {:.3g} times the processor time{}", *sides.back().relative_time,
                     elsewhere ? ", on another processor" : "");
}

/// The runs of all sides by name; those of variants computed now stand beside each other.
std::map<std::string, Runs> runs_by_name(std::vector<Side>& sides) {
  std::map<std::string, Runs> by_name;
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (const results::Run& run : sides[s].results.runs) {
      const bool variants = sides[s].document.has_value();
      Runs& runs = by_name[variants ? sides[0].label : run.case_id + ":" + run.variant];
      runs.resize(sides.size(), nullptr);
      runs[s] = &run;
    }
  return by_name;
}

/// With their series from the store; where one of them has lost its own, all go without.
/// @returns how many have lost theirs
std::size_t load_series(std::vector<results::Run>& runs, const std::vector<Side>& sides) {
  std::size_t lost = 0;
  for (std::size_t s = 0; s < runs.size(); ++s)
    if (!runs[s].stored.empty() && !take_stored(runs[s], sides[s].results.store)) ++lost;
  if (lost > 0)
    for (results::Run& run : runs)
      std::erase_if(run.quantities, [](const auto& q) {
        return q.second.values.size() > results::kSummaryEntries;
      });
  return lost;
}

void sort_and_drop(SideComparison& comparison) {
  std::ranges::stable_sort(comparison.runs, [](const auto& a, const auto& b) {
    return std::pair(a.changed, a.share) > std::pair(b.changed, b.share);
  });
  for (std::size_t i = kDrawnRuns; i < comparison.runs.size(); ++i) comparison.runs[i].runs.clear();
}

}  // namespace

SideComparison compare_sides(std::vector<Side> sides, bool series) {
  SideComparison comparison;
  std::vector<std::string> labels;
  std::vector<const Document*> documents;
  for (const Side& side : sides) {
    comparison.sides.push_back(side_of(side));
    labels.push_back(side.label);
    documents.push_back(side.document ? &*side.document : nullptr);
  }
  Totals totals(sides.size());
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
    found.remarks = {"not in " + join(without, "and")};
    found.changed = true;
    if (without.empty()) {
      lost += load_series(runs, sides);
      Runs loaded;
      for (const results::Run& run : runs) loaded.push_back(&run);
      totals.add(name, loaded);
      found = compare_runs(name, loaded, labels, documents,
                           sides.front().results.case_info(runs.front().case_id));
      if (same_bits(loaded) && !found.changed && documents.front() == nullptr) {
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
  totals.put(comparison.sides);
  comparison.conclusion =
      (documents.front() ? conclusion_of_variants(comparison) : conclusion_of_runs(comparison)) +
      time_text(comparison.sides) +
      (lost > 0 ? "; " + runs_text(lost) + " without series, which the stores lack" : "") + ".";
  return comparison;
}

}  // namespace trammel::harness
