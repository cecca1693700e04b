#include "solver/sensitivity/frequency_sensitivity.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/numbers.h"
#include "solver/sensitivity/set_derivative.h"

namespace trammel::solver {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Frequencies nearer than this to each other, relatively, are one set. Shapes of modes farther
/// apart are good to the modes' round-off over it.
constexpr double kSameFrequency = 1e-7;

/// Modes enough that the last set wanted is whole.
ModalSolution whole_sets(const System& system, Index count) {
  constexpr Index kSpareModes = 3;
  const Index all = system.K.rows();
  Index wanted = std::min(all, count + kSpareModes);
  for (;;) {
    ModalSolution modes = solve_modes(system, {.count = wanted});
    if (!modes.outcome.solved() || wanted == all || modes.frequency.size() <= count) return modes;
    if (equal_frequencies(modes.frequency).back().first >= count) return modes;
    wanted = std::min(all, 2 * wanted);
  }
}

/// Distance of a set from the nearest frequency outside it, over its own unless that is zero.
double relative_gap(const VectorXd& frequency, const FrequencySet& set) {
  const double f = frequency[set.first];
  const Index end = set.first + set.count;
  double gap = std::numeric_limits<double>::infinity();
  if (set.first > 0) gap = f - frequency[set.first - 1];
  if (end < frequency.size()) gap = std::min(gap, frequency[end] - f);
  return f > 0 ? gap / f : gap;
}

/// Derivatives of one set of equal frequencies by the parameters with a seeded design.
/// @param shown  of the set, the first
Outcome differentiate_set(const System& system, const ModalSolution& modes, const FrequencySet& set,
                          Index shown, const std::vector<std::optional<SeededDesign>>& designs,
                          FrequencySensitivity& result) {
  const double omega = 2 * std::numbers::pi * modes.frequency[set.first];
  const MatrixXd U = system.T * modes.shape.middleCols(set.first, set.count);
  const SetDerivative derivative(system, U, omega * omega);
  for (Index p = 0; p < std::ssize(designs); ++p) {
    const auto& design = designs[to_size(p)];
    if (!design) continue;
    const MatrixXd small = derivative.of(*design);
    result.counters.element_evaluations += 2 * std::ssize(system.mesh.frame);
    if (!small.allFinite()) {
      return {Status::singular,
              "a limb is straight or folded: its angles, and with them the frequencies, change "
              "infinitely fast with the link lengths"};
    }
    const SymmetricEigenpairs<MatrixXd> rates = symmetric_eigenpairs(small);
    if (!rates.converged)
      return {Status::not_converged, "the rates of repeated frequencies did not converge"};
    result.derivative.col(p).segment(set.first, shown) =
        rates.value.head(shown) / (4 * std::numbers::pi * omega);
  }
  return {};
}

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

FrequencySensitivity frequency_sensitivity(const ManipulatorDesign& design, const Pose& pose,
                                           const std::vector<DesignParameter>& parameters,
                                           Index count) {
  const System system = assemble(build_manipulator(design, pose));
  const Posture posture = inverse_kinematics(design.geometry, pose);
  const ModalSolution modes = whole_sets(system, count);
  FrequencySensitivity result;
  result.outcome = modes.outcome;
  result.evidence = modes.evidence;
  result.counters = modes.counters;
  const Index kept = std::min(count, modes.frequency.size());
  result.frequency = modes.frequency.head(kept);
  result.derivative = MatrixXd::Constant(kept, std::ssize(parameters), kNaN);
  result.gap = VectorXd::Constant(kept, std::numeric_limits<double>::infinity());
  if (!modes.outcome.solved()) return result;

  std::vector<std::optional<SeededDesign>> designs(parameters.size());
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (is_seeded(parameters[p].kind)) designs[p].emplace(design, posture, parameters[p]);
  }
  for (const FrequencySet& set : equal_frequencies(modes.frequency)) {
    if (set.first >= kept) break;
    const Index shown = std::min(set.count, kept - set.first);
    result.sets.push_back({set.first, shown});
    result.gap.segment(set.first, shown).setConstant(relative_gap(modes.frequency, set));
    if (modes.frequency[set.first] == 0) {
      result.derivative.middleRows(set.first, shown).setZero();
      continue;
    }
    result.outcome = differentiate_set(system, modes, set, shown, designs, result);
    if (!result.outcome.solved()) {
      result.derivative.setConstant(kNaN);
      return result;
    }
  }
  return result;
}

}  // namespace trammel::solver
