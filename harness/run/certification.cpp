#include "harness/run/certification.h"

#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "harness/base/statistic.h"
#include "harness/run/diff.h"

namespace trammel::harness {
namespace {

constexpr double kAllDigits = 16;
/// A tolerance below this multiple of the noise (see certification.h) is tight.
constexpr double kClear = 10;

/// Returns true if the run was solved, or if the solver reported a singular matrix or an iteration
/// without convergence.
bool has_solver_answer(const results::Run& run) {
  using results::Status;
  return run.status == Status::solved || run.status == Status::singular ||
         run.status == Status::not_converged;
}

std::string verdict_of(const Entry* entry) {
  if (entry == nullptr) return "missing";
  const bool with_reason =
      entry->check == nullptr && !has_solver_answer(*entry->run) && !entry->run->reason.empty();
  return with_reason ? entry->verdict + ": " + entry->run->reason : entry->verdict;
}

double agreeing_digits(double a, double b) {
  if (a == b) return kAllDigits;
  const double difference = std::abs(a - b) / std::max(std::abs(a), std::abs(b));
  return std::isfinite(difference) ? std::clamp(-std::log10(difference), 0.0, kAllDigits) : 0;
}

/// Adds the tolerance of a check entry to `tight` if it is less than kClear times the noise. Of the
/// entries of a check, only the entry with the smallest ratio of tolerance to noise is kept.
void add_tight_tolerance(const DiffRow& row, const std::string& configuration,
                         std::vector<TightTolerance>& tight) {
  const results::Check &before = *row.before->check, &after = *row.after->check;
  if (!before.difference || !after.difference || !before.tolerance) return;
  const results::Tolerance& tolerance = *before.tolerance;
  if (!tolerance.symmetric || !tolerance.high) return;
  const double noise = std::abs(*after.difference - *before.difference);
  if (!(noise * kClear > *tolerance.high)) return;
  const TightTolerance noted{row.name.substr(0, row.name.find('[')), configuration, *tolerance.high,
                             noise};
  const auto is_same = [&](const TightTolerance& other) { return other.check == noted.check; };
  TightTolerance& worst = find_or_add(tight, is_same, noted);
  if (noise * worst.tolerance > worst.noise * noted.tolerance) worst = noted;
}

void compare(const Entries& first, const Configuration& other, Certification& result) {
  ConfigurationRow total{other.name, 0, 0, kAllDigits, kAllDigits, {}};
  const Entries entries = all_entries(other.results);
  std::vector<double> digits;
  // True if the first configuration contains the run of the current row; true if the run has the
  // same status in both configurations. The rows of checks follow the row of their run.
  bool is_known = false, ends_equally = false;
  for (const DiffRow& row : pair_entries(first, entries)) {
    bool flipped = false;
    if (row.is_run()) {
      is_known = row.before != nullptr;
      ends_equally = row.is_in_both() && row.before->verdict == row.after->verdict;
      flipped = is_known && (!ends_equally || !has_solver_answer(*row.after->run));
    } else if (is_known && !row.is_in_both()) {  // missing check of runs with equal status
      ++total.missing;
      flipped = ends_equally;
    } else if (is_known) {
      ++total.checks;
      flipped = row.before->verdict != row.after->verdict;
      const results::Check &before = *row.before->check, &after = *row.after->check;
      if (before.computed && after.computed && before.index == after.index) {
        digits.push_back(agreeing_digits(*before.computed, *after.computed));
        if (digits.back() < total.fewest_digits) {
          total.fewest_digits = digits.back();
          total.least_certain = row.name;
        }
      }
      add_tight_tolerance(row, other.name, result.tight);
    }
    if (flipped)
      result.flips.push_back({other.name, row.name, verdict_of(row.before), verdict_of(row.after)});
  }
  if (!digits.empty()) total.median_digits = quantile(std::move(digits), 0.5);
  result.rows.push_back(total);
}

}  // namespace

Certification certify(const std::vector<Configuration>& configurations) {
  Certification result;
  if (configurations.empty()) return result;
  const Entries first = all_entries(configurations.front().results);
  for (const auto& [name, entry] : first) {
    if (entry.check == nullptr && !has_solver_answer(*entry.run))
      result.flips.push_back(
          {configurations.front().name, name, verdict_of(&entry), verdict_of(&entry)});
  }
  for (std::size_t i = 1; i < configurations.size(); ++i) compare(first, configurations[i], result);
  std::ranges::stable_sort(result.tight, [](const TightTolerance& a, const TightTolerance& b) {
    return a.tolerance * b.noise < b.tolerance * a.noise;
  });
  return result;
}

}  // namespace trammel::harness
