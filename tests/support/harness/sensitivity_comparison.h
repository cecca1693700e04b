#pragma once

#include <cstdint>

#include "harness/statics_modes/frequency_differences.h"
#include "tests/support/solver/sensitivity_designs.h"

/// Exact sensitivities against differences of the frequencies of the changed design.
namespace trammel::solver {

struct Comparison {
  /// Largest error over the largest derivative of that mode. A derivative that happens to be nearly
  /// zero counts as a thousandth of the largest one, both over the frequency: differences round off
  /// by the frequency, not by its derivative.
  double worst = 0;
  Index compared = 0;
  Index repeated = 0;  ///< poses with repeated frequencies
};

/// @param centred  every so many poses is a centred one; 0: none
inline Comparison compare(const ManipulatorDesign& design, const DesignParameter& parameter,
                          int poses, double relative_step, std::uint64_t seed, int centred = 0) {
  constexpr Index kModes = 6;
  std::mt19937_64 engine(seed);
  VectorXd error = VectorXd::Zero(kModes);
  VectorXd largest = VectorXd::Zero(kModes), frequency = largest;
  Comparison result;
  for (int i = 0; i < poses; ++i) {
    const bool symmetric = centred > 0 && i % centred == 0;
    const Pose pose = symmetric ? random_centred_pose(engine) : random_pose(design, engine);
    const FrequencySensitivity s = frequency_sensitivity(design, pose, {parameter}, kModes);
    if (!s.outcome.solved()) throw ModelError(s.outcome.reason);
    const harness::FrequencyDifferences differences =
        harness::differentiate_frequencies(design, pose, parameter, kModes, relative_step);
    if (!differences.outcome.solved()) throw ModelError(differences.outcome.reason);
    error = error.cwiseMax((s.derivative.col(0) - differences.derivative).cwiseAbs());
    largest = largest.cwiseMax(s.derivative.col(0).cwiseAbs());
    frequency = frequency.cwiseMax(s.frequency);
    ++result.compared;
    for (const FrequencySet& set : s.sets) {
      if (set.count < 2) continue;
      ++result.repeated;
      break;
    }
  }
  const double scale = largest.cwiseQuotient(frequency).maxCoeff();
  result.worst = error.cwiseQuotient(largest.cwiseMax(1e-3 * scale * frequency)).maxCoeff();
  return result;
}

}  // namespace trammel::solver
