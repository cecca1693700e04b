#include "harness/studies/pareto_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

/// Returns a factor as text with two digits: "1.7", "43", "7900".
std::string times(double factor) {
  if (factor < 100) return rounded(factor, 2);
  const double unit = std::pow(10, std::floor(std::log10(factor)) - 1);
  return std::to_string(std::llround(std::round(factor / unit) * unit));
}

/// Returns equally fast settings as text: "'fine' or 'finer' or one of 3 more".
std::string list_tied_settings(std::size_t setting, const std::vector<std::size_t>& tied,
                               const std::vector<std::string>& titles) {
  std::string text = fmt::format("'{}'", titles[setting]);
  const std::size_t named = tied.size() <= 3 ? tied.size() : 2;
  for (std::size_t i = 0; i < named; ++i) text += fmt::format(" or '{}'", titles[tied[i]]);
  if (tied.size() > named) text += fmt::format(" or one of {} more", tied.size() - named);
  return text;
}

/// Describes the time that a higher accuracy than that of the point `first` requires.
/// @param fine  the fastest point with an error of at most 1e-6
/// @param best  the most accurate point
std::string describe_finest_setting(const CostPoint& first, const std::optional<CostPoint>& fine,
                                    const CostPoint& best, const std::vector<std::string>& titles) {
  if (fine && fine->setting == first.setting) return ", and its error is at most 1e-6 as well.";
  if (fine)
    return fmt::format("; an error of 1e-6 requires '{}', which takes {} times as long.",
                       titles[fine->setting], times(fine->time / first.time));
  if (best.setting == first.setting)
    return fmt::format("; its error, {}, is the smallest of all settings.", error_text(best.error));
  return fmt::format("; the smallest error is that of '{}', {}, which takes {} times as long.",
                     titles[best.setting], error_text(best.error), times(best.time / first.time));
}

}  // namespace

std::optional<CostPoint> fastest_allowed(const std::vector<CostPoint>& points, double error) {
  double min_time = std::numeric_limits<double>::infinity();
  for (const CostPoint& point : points)
    if (point.error <= error) min_time = std::min(min_time, point.time);
  std::optional<CostPoint> best;
  for (const CostPoint& point : points) {
    if (point.error > error || point.time > (1 + kParetoTolerance) * min_time) continue;
    if (!best || point.error < (1 - kParetoTolerance) * best->error) best = point;
  }
  return best;
}

std::vector<std::size_t> tied_settings(const std::vector<CostPoint>& points, double error) {
  std::vector<std::size_t> tied;
  const auto best = fastest_allowed(points, error);
  for (const CostPoint& point : points) {
    if (point.error <= error && point.setting != best->setting &&
        point.low <= (1 + kParetoTolerance) * best->high)
      tied.push_back(point.setting);
  }
  return tied;
}

bool has_point_of_setting(const std::vector<CostPoint>& points, std::size_t setting) {
  return std::ranges::any_of(points, [=](const CostPoint& p) { return p.setting == setting; });
}

std::vector<CostPoint> find_pareto_front(const std::vector<CostPoint>& points) {
  std::vector<CostPoint> front;
  for (const CostPoint& point : points) {
    const CostPoint best = *fastest_allowed(points, (1 + kParetoTolerance) * point.error);
    if (!has_point_of_setting(front, best.setting)) front.push_back(best);
  }
  std::ranges::sort(front, [](const CostPoint& a, const CostPoint& b) { return a.time < b.time; });
  return front;
}

const std::vector<double>& target_errors_of_report() {
  static const std::vector<double> errors = {0.05, 0.01, 1e-3, 1e-4, 1e-6};
  return errors;
}

double compare_pareto_fronts(const std::vector<CostPoint>& a, const std::vector<CostPoint>& b) {
  const auto front_a = find_pareto_front(a), front_b = find_pareto_front(b);
  double largest = 0;
  const auto look = [&](double error) {
    // Settings whose errors differ by less than kParetoTolerance count as equally accurate.
    const double within = (1 + kParetoTolerance) * error;
    const auto at_a = fastest_allowed(front_a, within), at_b = fastest_allowed(front_b, within);
    if (at_a && at_b) largest = std::max(largest, std::abs(std::log(at_a->time / at_b->time)));
  };
  for (const CostPoint& point : front_a) look(point.error);
  for (const CostPoint& point : front_b) look(point.error);
  return std::expm1(largest);
}

std::string error_text(double error) {
  return error < 1e-4 ? rounded(error, 2) : rounded(100 * error, 2) + " %";
}

std::string describe_pareto_front(const std::vector<CostPoint>& points,
                                  const std::vector<std::string>& titles, std::size_t baseline) {
  const std::vector<CostPoint> front = find_pareto_front(points);
  if (front.empty()) return "No setting could be measured.";
  const CostPoint& best = front.back();
  const auto first = fastest_allowed(points, 0.01);
  if (!first)
    return fmt::format("All errors exceed 1 %: the smallest is that of '{}', {}.",
                       titles[best.setting], error_text(best.error));
  const std::vector<std::size_t> tied = tied_settings(points, 0.01);
  std::string text = fmt::format("For an error of at most 1 %, {} is the fastest setting{}",
                                 list_tied_settings(first->setting, tied, titles),
                                 tied.empty() ? "" : " (their times do not differ significantly)");
  const bool as_quick = std::abs(std::log(first->time)) <= std::log1p(kParetoTolerance);
  if (as_quick && first->setting != baseline)
    text += fmt::format(", taking as long as '{}'", titles[baseline]);
  if (!as_quick)
    text += fmt::format(", taking {} times as long as '{}'", times(first->time), titles[baseline]);
  return text + describe_finest_setting(*first, fastest_allowed(points, 1e-6), best, titles);
}

}  // namespace trammel::harness
