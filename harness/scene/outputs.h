#pragma once

#include <string>
#include <vector>

#include "harness/input/json_view.h"
#include "solver/linear/statics.h"
#include "solver/motion/harmonic.h"

/// What a response in time or over frequency is followed by: key "outputs" of its analysis.
namespace trammel::harness {

struct Output {
  enum class Kind { displacement, velocity, acceleration, resultant, bending_stress, stress };
  std::string name;  ///< displacement_y_m:M, bending_moment_N_m:AB.start, stress_Pa:AB ...
  Kind kind = Kind::displacement;
  solver::Index item = 0;       ///< node or member
  solver::Index component = 0;  ///< x, y, rotation; N, V, M
  solver::Index end = 0;        ///< of the member
  [[nodiscard]] bool needs_forces() const { return kind >= Kind::resultant; }
  /// The name with a word in front: peak_displacement_y_m:M.
  [[nodiscard]] std::string prefixed(const std::string& prefix) const { return prefix + name; }
};

/// Whether any of them does.
[[nodiscard]] bool needs_forces(const std::vector<Output>& outputs);

/// @throws InputError  where a name is none, or names a part that the model does not have.
[[nodiscard]] std::vector<Output> read_outputs(const JsonView& outputs, const solver::Model& model);

/// A state of motion; `forces` is read by the outputs that need forces only.
struct MovingState {
  Eigen::MatrixX3d displacement, velocity, acceleration;  ///< node x (x, y, rotation)
  solver::StaticSolution forces;
};
[[nodiscard]] double value_of(const Output& output, const solver::Model& model,
                              const MovingState& state);

/// The amplitude of an output. @param frequency  [Hz]
[[nodiscard]] double amplitude_of(const Output& output, const solver::Model& model,
                                  const solver::HarmonicAmplitudes& amplitudes, double frequency);

}  // namespace trammel::harness
