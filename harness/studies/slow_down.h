#pragma once

#include <string>
#include <vector>

/// Whether one program is slower than another, told from noise.
namespace trammel::harness {

/// Times of one computation by two programs, a pair in each repeat, so that both have met the same
/// load of the machine.
struct InterleavedTimes {
  std::string name;
  std::vector<double> before_s, after_s;
};

/// After over before: the estimate of Hodges and Lehmann and the interval of Wilcoxon's signed
/// ranks, which assumes no distribution (M. Hollander, D. A. Wolfe, Nonparametric Statistical
/// Methods, 1999, 3.1 to 3.3). It is as wide as so many computations together need, so that none of
/// them is called slower or faster by chance with more than the probability asked for.
struct RelativeSpeed {
  std::string name;
  double ratio = 1, low = 0, high = 0;  ///< high is infinite where repeats are too few
  [[nodiscard]] bool slower() const { return low > 1; }
  [[nodiscard]] bool faster() const { return high < 1; }
};

/// @param false_alarm  probability of any false word over all computations together
[[nodiscard]] std::vector<RelativeSpeed> relative_speeds(const std::vector<InterleavedTimes>& times,
                                                         double false_alarm = 0.01);

/// Repeats below which nothing can be said of so many computations.
[[nodiscard]] std::size_t fewest_repeats(std::size_t computations, double false_alarm = 0.01);

}  // namespace trammel::harness
