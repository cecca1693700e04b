#include "harness/studies/slow_down.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/base/timing.h"

namespace trammel::harness {
namespace {

/// Probability of each sum of signed ranks of n pairs that do not differ: each rank is in it or
/// not.
std::vector<double> rank_sum_probabilities(std::size_t n) {
  std::vector<double> probability(n * (n + 1) / 2 + 1, 0.0);
  probability[0] = 1;
  for (std::size_t rank = 1; rank <= n; ++rank)
    for (std::size_t sum = probability.size(); sum-- > 0;)
      probability[sum] = 0.5 * probability[sum] + (sum >= rank ? 0.5 * probability[sum - rank] : 0);
  return probability;
}

/// How many Walsh averages lie outside the interval on either side; -1: not even all of them reach.
std::ptrdiff_t outside(std::size_t n, double tail) {
  const std::vector<double> probability = rank_sum_probabilities(n);
  double sum = 0;
  std::ptrdiff_t count = -1;
  for (const double p : probability) {
    sum += p;
    if (sum > tail) break;
    ++count;
  }
  return count;
}

}  // namespace

std::vector<RelativeSpeed> relative_speeds(const std::vector<InterleavedTimes>& times,
                                           double false_alarm) {
  const double tail =
      0.5 * false_alarm / static_cast<double>(std::max<std::size_t>(1, times.size()));
  std::vector<RelativeSpeed> found;
  for (const InterleavedTimes& pairs : times) {
    const std::size_t n = std::min(pairs.before_s.size(), pairs.after_s.size());
    std::vector<double> logs, averages;
    for (std::size_t i = 0; i < n; ++i)
      logs.push_back(std::log(pairs.after_s[i] / pairs.before_s[i]));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k <= i; ++k) averages.push_back(0.5 * (logs[i] + logs[k]));
    RelativeSpeed speed{pairs.name, 1, 0, std::numeric_limits<double>::infinity()};
    if (n > 0) speed.ratio = std::exp(quantile(averages, 0.5));
    const std::ptrdiff_t left_out = outside(n, tail);
    if (left_out >= 0 && n > 0) {
      std::ranges::sort(averages);
      const auto place = static_cast<std::size_t>(left_out);
      speed.low = std::exp(averages[place]);
      speed.high = std::exp(averages[averages.size() - 1 - place]);
    }
    found.push_back(std::move(speed));
  }
  return found;
}

std::size_t fewest_repeats(std::size_t computations, double false_alarm) {
  const double tail =
      0.5 * false_alarm / static_cast<double>(std::max<std::size_t>(1, computations));
  return static_cast<std::size_t>(std::ceil(-std::log2(tail)));
}

}  // namespace trammel::harness
