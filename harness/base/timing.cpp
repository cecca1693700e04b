#include "harness/base/timing.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <random>

#include "harness/base/statistic.h"
#include "harness/base/stopwatch.h"

namespace trammel::harness {
namespace {

constexpr int kMaxRunsEach = 1000;

struct Elapsed {
  double cpu_s = 0, wall_s = 0;
};

Elapsed measure(const std::function<void()>& work, int runs) {
  const Stopwatch watch;
  for (int i = 0; i < runs; ++i) work();
  return {watch.cpu_s() / runs, watch.wall_s() / runs};
}

/// Returns the number of calls of `work` that take about `shortest_s` [s], at most kMaxRunsEach.
/// Calls `work` once to warm up. If this call is short, a second call measures the time.
int run_count_for_duration(const std::function<void()>& work, double shortest_s) {
  // A first call is slower, because it loads code and data, but less than ten times.
  if (measure(work, 1).cpu_s >= 10 * shortest_s) return 1;
  const double once = std::max(measure(work, 1).cpu_s, 1e-7);
  return std::clamp(static_cast<int>(std::ceil(shortest_s / once)), 1, kMaxRunsEach);
}

}  // namespace

RelativeTime time_ratio(const std::vector<double>& times, const std::vector<double>& baseline,
                        std::size_t first, std::size_t stride) {
  std::vector<double> ratios;
  for (std::size_t i = first; i < times.size(); i += stride)
    ratios.push_back(times[i] / baseline[i]);
  std::ranges::sort(ratios);
  const std::size_t n = ratios.size();
  const boost::math::binomial repeats_below(static_cast<double>(n), 0.5);
  std::size_t outside = 0;  // number of ratios below the interval, equal to the number above it
  while (2 * cdf(repeats_below, static_cast<double>(outside + 1)) <= 0.02) ++outside;
  return {quantile(ratios, 0.5), ratios[outside], ratios[n - 1 - outside]};
}

std::vector<std::size_t> shuffle_indices(std::size_t n, std::uint64_t& state) {
  // Fisher-Yates shuffle; std::shuffle differs between libraries.
  std::mt19937_64 engine(state);
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[engine() % i]);
  state = engine();
  return order;
}

EvaluationTime measure_evaluation(const std::string& name, std::size_t evaluations,
                                  const std::function<void()>& batch) {
  constexpr double enough_s = 0.02;
  const Stopwatch watch;
  std::size_t rounds = 0;
  do {
    batch();
    ++rounds;
  } while (watch.wall_s() < enough_s);
  const std::size_t all = rounds * evaluations;
  return {name, watch.wall_s() / static_cast<double>(all), all};
}

std::vector<Timing> measure_interleaved(const std::vector<std::function<void()>>& works,
                                        const TimingOptions& options,
                                        const std::function<void()>& after_repeat) {
  std::vector<Timing> timings(works.size());
  std::vector<std::vector<double>> wall(works.size());
  for (std::size_t i = 0; i < works.size(); ++i)
    timings[i].runs_each = run_count_for_duration(works[i], options.shortest_s);
  std::uint64_t state = options.seed;
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    for (const std::size_t i : shuffle_indices(works.size(), state)) {
      const Elapsed elapsed = measure(works[i], timings[i].runs_each);
      timings[i].cpu_s.push_back(elapsed.cpu_s);
      wall[i].push_back(elapsed.wall_s);
    }
    if (after_repeat) after_repeat();
  }
  for (std::size_t i = 0; i < works.size(); ++i) {
    Timing& timing = timings[i];
    timing.median_s = quantile(timing.cpu_s, 0.5);
    timing.wall_median_s = quantile(wall[i], 0.5);
  }
  return timings;
}

}  // namespace trammel::harness
