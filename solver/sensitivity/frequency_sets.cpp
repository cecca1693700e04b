#include "solver/sensitivity/frequency_sets.h"

namespace trammel::solver {

namespace {

/// Frequencies nearer than this to each other, relatively, are one set. Shapes of modes farther
/// apart are good to the modes' round-off over it.
constexpr double kSameFrequency = 1e-7;

}  // namespace

std::vector<FrequencySet> equal_frequencies(const Eigen::VectorXd& frequency) {
  std::vector<FrequencySet> sets;
  for (Index i = 0; i < frequency.size(); ++i) {
    const bool repeated =
        !sets.empty() && frequency[i] - frequency[i - 1] <= kSameFrequency * frequency[i];
    if (repeated) {
      ++sets.back().count;
    } else {
      sets.push_back({i, 1});
    }
  }
  return sets;
}

}  // namespace trammel::solver
