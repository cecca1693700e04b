#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Measuring how long computations take, so that what is compared is measured alike.
namespace trammel::harness {

struct TimingOptions {
  int repeats = 7;         ///< at least this many are needed for quartiles that mean something
  std::uint64_t seed = 1;  ///< of the order
  /// A measurement is the mean of so many computations that it takes at least this long [s].
  double shortest_s = 2e-3;
};

/// Processor time of one computation. Medians over the repeats.
struct Timing {
  std::vector<double> cpu_s;  ///< by repeat
  double median_s = 0;
  double wall_median_s = 0;
  int runs_each = 1;  ///< computations in a measurement
};

/// What one computation takes over another.
struct RelativeTime {
  double median = 0;
  /// Holds the true median with a probability of at least 98 %, however the times are distributed
  /// (sign test; of seven repeats all of them).
  double low = 0, high = 0;
};

/// Of the ratios in each repeat, both having met the same load of the machine.
/// @param first, step  the repeats that count: all of them, or every second one from `first`
[[nodiscard]] RelativeTime relative_time(const std::vector<double>& times,
                                         const std::vector<double>& baseline, std::size_t first = 0,
                                         std::size_t step = 1);

/// Runs every work once to warm up, then in each repeat all of them once, in an order shuffled
/// anew: what the machine does meanwhile meets all alike.
/// @param done  called after each repeat
[[nodiscard]] std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& works,
                                                   const TimingOptions& options,
                                                   const std::function<void()>& done);

/// What one evaluation of something takes, measured; never judged.
struct EvaluationTime {
  std::string name;             ///< with words joined by '_'
  double wall_s = 0;            ///< of one evaluation
  std::size_t evaluations = 0;  ///< over which it was averaged
};

/// Averaged over as many rounds as fill a few hundredths of a second.
/// @param round  does so many `evaluations`
[[nodiscard]] EvaluationTime time_evaluation(const std::string& name, std::size_t evaluations,
                                             const std::function<void()>& round);

/// By linear interpolation between the sorted values; share 0.5 is the median.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// 0 ... n - 1 in an order that is the same on every machine.
[[nodiscard]] std::vector<std::size_t> shuffled(std::size_t n, std::uint64_t& state);

}  // namespace trammel::harness
