#include "harness/run/certification.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/base/find_or_add.h"

namespace trammel::harness {
namespace {

constexpr double kAllDigits = 16;
constexpr double kClear = 10;  ///< times the noise that a tolerance should be

constexpr const char* kMissing = "missing";

using ChecksByName = std::map<std::string, const results::Check*>;
using RunsByName = std::map<std::string, const results::Run*>;

std::string run_name(const results::Run& run) {
  return run.case_id + ":" + run.variant;
}

/// Of bounds and beside another variant the worst entry alone is kept: it may be another one.
std::string name_of(const results::Run& run, const results::Check& check) {
  std::string name = run_name(run) + " " + check.name;
  if (check.index && check.expected && check.against_variant.empty())
    name += "[" + std::to_string(*check.index) + "]";
  return check.statistic.empty() ? name : name + " " + check.statistic;
}

/// Entries of one name, as those of several statistics, are told apart by their order.
ChecksByName checks_of(const results::Run& run) {
  ChecksByName checks;
  for (const results::Check& check : run.checks) {
    const std::string name = name_of(run, check);
    std::string own = name;
    for (int n = 2; checks.count(own) > 0; ++n) own = name + " #" + std::to_string(n);
    checks.emplace(own, &check);
  }
  return checks;
}

RunsByName runs_of(const results::Results& results) {
  RunsByName runs;
  for (const results::Run& run : results.runs) runs.emplace(run_name(run), &run);
  return runs;
}

/// Whether the solver has said what becomes of the system.
bool has_answer(results::Status status) {
  using results::Status;
  return status == Status::solved || status == Status::singular || status == Status::not_converged;
}

std::string ending(const results::Run& run) {
  const std::string status = to_string(run.status);
  return has_answer(run.status) || run.reason.empty() ? status : status + ": " + run.reason;
}

double agreeing_digits(double a, double b) {
  if (a == b) return kAllDigits;
  const double apart = std::abs(a - b) / std::max(std::abs(a), std::abs(b));
  return std::isfinite(apart) ? std::clamp(-std::log10(apart), 0.0, kAllDigits) : 0;
}

/// What one configuration is worth beside the first.
class Beside {
 public:
  Beside(const Configuration& configuration, Certification& into)
      : name_(configuration.name),
        runs_(runs_of(configuration.results)),
        into_(into),
        row_{configuration.name, 0, 0, kAllDigits, kAllDigits, {}} {}

  /// The checks of a run that ends otherwise are counted, not named.
  void look_at(const std::string& name, const results::Run& first) {
    const auto found = runs_.find(name);
    const results::Run none;
    const results::Run& own = found == runs_.end() ? none : *found->second;
    const bool same = found != runs_.end() && own.status == first.status;
    if (!same || !has_answer(own.status))
      flip(name, ending(first), &own == &none ? kMissing : ending(own));
    const ChecksByName before = checks_of(first), after = checks_of(own);
    for (const auto& [check_name, check] : before) {
      const auto at = after.find(check_name);
      if (at != after.end()) {
        look_at(check_name, *check, *at->second);
      } else {
        note_missing(same, check_name, to_string(check->verdict), kMissing);
      }
    }
    for (const auto& [check_name, check] : after)
      if (before.count(check_name) == 0)
        note_missing(same, check_name, kMissing, to_string(check->verdict));
  }

  void end() {
    if (!digits_.empty()) {
      const auto middle = digits_.begin() + static_cast<std::ptrdiff_t>(digits_.size() / 2);
      std::nth_element(digits_.begin(), middle, digits_.end());
      row_.median_digits = *middle;
    }
    into_.rows.push_back(row_);
  }

 private:
  void look_at(const std::string& name, const results::Check& first, const results::Check& own) {
    ++row_.checks;
    if (own.verdict != first.verdict) flip(name, to_string(first.verdict), to_string(own.verdict));
    if (first.computed && own.computed && first.index == own.index)
      note_digits(name, *first.computed, *own.computed);
    if (!first.difference || !own.difference || !first.tolerance) return;
    const results::Tolerance& tolerance = *first.tolerance;
    if (!tolerance.symmetric || !tolerance.high) return;
    const double noise = std::abs(*own.difference - *first.difference);
    if (noise * kClear > *tolerance.high) note_noise(name, *tolerance.high, noise);
  }

  void flip(const std::string& what, const std::string& from, const std::string& to) {
    into_.flips.push_back({name_, what, from, to});
  }

  void note_missing(bool named, const std::string& check, const std::string& from,
                    const std::string& to) {
    ++row_.missing;
    if (named) flip(check, from, to);
  }

  void note_digits(const std::string& name, double first, double own) {
    const double digits = agreeing_digits(first, own);
    digits_.push_back(digits);
    if (digits >= row_.fewest_digits) return;
    row_.fewest_digits = digits;
    row_.least_certain = name;
  }

  /// The worst entry of a check stands for all.
  void note_noise(const std::string& entry, double tolerance, double noise) {
    const std::string name = entry.substr(0, entry.find('['));
    const TightTolerance noted{name, name_, tolerance, noise};
    const auto is_same = [&](const TightTolerance& one) { return one.check == name; };
    TightTolerance& worst = find_or_add(into_.tight, is_same, noted);
    if (noise * worst.tolerance > worst.noise * tolerance) worst = noted;
  }

  std::string name_;
  RunsByName runs_;
  Certification& into_;
  ConfigurationRow row_;
  std::vector<double> digits_;
};

}  // namespace

Certification certify(const std::vector<Configuration>& configurations) {
  Certification result;
  if (configurations.empty()) return result;
  const RunsByName first = runs_of(configurations.front().results);
  for (const auto& [name, run] : first) {
    if (!has_answer(run->status))
      result.flips.push_back({configurations.front().name, name, ending(*run), ending(*run)});
  }
  for (std::size_t i = 1; i < configurations.size(); ++i) {
    Beside beside(configurations[i], result);
    for (const auto& [name, run] : first) beside.look_at(name, *run);
    beside.end();
  }
  std::ranges::stable_sort(result.tight, [](const TightTolerance& a, const TightTolerance& b) {
    return a.tolerance * b.noise < b.tolerance * a.noise;
  });
  return result;
}

}  // namespace trammel::harness
