#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Measurement of computing times under equal conditions, so that the times can be compared.
namespace trammel::harness {

struct TimingOptions {
  int repeats = 7;         ///< number of measurements; 7 is the minimum for quartiles
  std::uint64_t seed = 1;  ///< seed of the random order of measurements
  /// Minimum duration of a measurement [s]. A shorter computation is repeated within the
  /// measurement, which returns the mean time.
  double shortest_s = 2e-3;
};

/// Computing times of one computation. Medians are taken over the repeated measurements.
struct Timing {
  std::vector<double> cpu_s;  ///< processor times of one computation, one per repeat
  double median_s = 0, wall_median_s = 0;
  int runs_each = 1;  ///< number of computations in a measurement
};

/// Computing time of one computation divided by that of another computation.
struct RelativeTime {
  double median = 0;
  /// Interval that contains the true median of the ratio with a probability of at least 98 %, for
  /// any distribution of the times (sign test). For seven repeats, the interval spans all ratios.
  double low = 0, high = 0;
};

/// Returns the median ratio of two times. Ratios are computed for each repeat, because both times
/// of a repeat were measured under the same machine load.
/// @param first, stride  selects the repeats first, first + stride, ...; by default all repeats
[[nodiscard]] RelativeTime time_ratio(const std::vector<double>& times,
                                      const std::vector<double>& baseline, std::size_t first = 0,
                                      std::size_t stride = 1);

/// Runs every function once or twice to warm up. Then measures all of them in each repeat, in a new
/// random order. Disturbances of the machine therefore affect the times of all functions alike.
/// @param after_repeat  called after each repeat
[[nodiscard]] std::vector<Timing> measure_interleaved(
    const std::vector<std::function<void()>>& works, const TimingOptions& options,
    const std::function<void()>& after_repeat);

/// Time of one evaluation of a function. Reports show this time, but checks do not use it.
struct EvaluationTime {
  std::string name;             ///< name of the function, with '_' between words
  double wall_s = 0;            ///< time of one evaluation [s]
  std::size_t evaluations = 0;  ///< number of evaluations in the average
};

/// Measures the mean time of one evaluation of a function. `batch` is repeated for at least 0.02 s.
/// @param batch  evaluates the function `evaluations` times
[[nodiscard]] EvaluationTime measure_evaluation(const std::string& name, std::size_t evaluations,
                                                const std::function<void()>& batch);

/// Returns a random permutation of 0 ... n - 1 that is the same on every machine.
/// @param state  state of the random generator, which is advanced
[[nodiscard]] std::vector<std::size_t> shuffle_indices(std::size_t n, std::uint64_t& state);

}  // namespace trammel::harness
