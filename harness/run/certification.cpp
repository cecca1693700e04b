#include "harness/run/certification.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

constexpr double kAllDigits = 16;
constexpr double kClear = 10;  ///< times the noise that a tolerance should be

using Checks = std::map<std::string, const results::Check*>;

std::string name_of(const results::Run& run, const results::Check& check) {
  std::string name = run.case_id + ":" + run.variant + " " + check.name;
  if (check.index) name += "[" + std::to_string(*check.index) + "]";
  return check.statistic.empty() ? name : name + " " + check.statistic;
}

/// Entries of one name, as those of several statistics, are told apart by their order.
Checks checks_of(const results::Results& results) {
  Checks checks;
  for (const results::Run& run : results.runs) {
    for (const results::Check& check : run.checks) {
      const std::string name = name_of(run, check);
      std::string own = name;
      for (int n = 2; checks.count(own) > 0; ++n) own = name + " #" + std::to_string(n);
      checks.emplace(own, &check);
    }
  }
  return checks;
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
        checks_(checks_of(configuration.results)),
        into_(into),
        row_{configuration.name, 0, 0, kAllDigits, kAllDigits, {}} {}

  void look_at(const std::string& name, const results::Check& first) {
    const auto found = checks_.find(name);
    if (found == checks_.end()) {
      ++row_.missing;
      return;
    }
    const results::Check& own = *found->second;
    ++row_.checks;
    if (own.verdict != first.verdict)
      into_.flips.push_back({name_, name, to_string(first.verdict), to_string(own.verdict)});
    if (first.computed && own.computed) note_digits(name, *first.computed, *own.computed);
    if (!first.difference || !own.difference || !first.tolerance) return;
    const results::Tolerance& tolerance = *first.tolerance;
    if (!tolerance.symmetric || !tolerance.high) return;
    const double noise = std::abs(*own.difference - *first.difference);
    if (noise * kClear > *tolerance.high) note_noise(name, *tolerance.high, noise);
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
    const auto same = std::find_if(into_.tight.begin(), into_.tight.end(),
                                   [&](const TightTolerance& one) { return one.check == name; });
    if (same == into_.tight.end()) {
      into_.tight.push_back({name, name_, tolerance, noise});
    } else if (noise * same->tolerance > same->noise * tolerance) {
      *same = {name, name_, tolerance, noise};
    }
  }

  std::string name_;
  Checks checks_;
  Certification& into_;
  ConfigurationRow row_;
  std::vector<double> digits_;
};

}  // namespace

Certification certify(const std::vector<Configuration>& configurations) {
  Certification result;
  if (configurations.empty()) return result;
  const Checks first = checks_of(configurations.front().results);
  for (std::size_t i = 1; i < configurations.size(); ++i) {
    Beside beside(configurations[i], result);
    for (const auto& [name, check] : first) beside.look_at(name, *check);
    beside.end();
  }
  std::stable_sort(result.tight.begin(), result.tight.end(),
                   [](const TightTolerance& a, const TightTolerance& b) {
                     return a.tolerance * b.noise < b.tolerance * a.noise;
                   });
  return result;
}

}  // namespace trammel::harness
