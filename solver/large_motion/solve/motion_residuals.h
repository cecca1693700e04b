#pragma once

#include "solver/large_motion/solve/stepper.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

/// Residuals of the step that a stepper has accepted last, evaluated anew.
class MotionResiduals {
 public:
  /// @pre both outlive this
  MotionResiduals(const ConstrainedSystem& system, const Stepper& stepper);

  /// The method's equation of motion, row by row over |M| |a| + |K| |q| + |G^T| |lambda|, and its
  /// relations between q, v and a.
  void add_equation_of_motion(Evidence& evidence);
  /// Rigid rows over the size of what they join, in positions and, where the method keeps them
  /// there, in velocities times h.
  void add_constraints(double h, Evidence& evidence);
  /// Takes what the step did to the energy; generalized-alpha has no balance of its own for forces
  /// that are not linear.
  void take_energy();
  /// The largest gap in the balance since the start, over the energies and the work done.
  void add_energy(Evidence& evidence) const;

 private:
  void add_terms(const TangentCoefficients& coefficients, const State& state);

  const ConstrainedSystem& system_;
  const Stepper& stepper_;
  VectorXd row_unit_;  ///< of each constraint [m or rad]
  bool has_energy_ = false;
  double energy_gap_ = 0, largest_energy_gap_ = 0, largest_energy_ = 0, throughput_ = 0;  ///< [J]
  KktMatrix matrix_;
  VectorXd residual_, unknowns_, terms_, magnitudes_, constraint_residual_, constraint_rate_;
};

}  // namespace trammel::solver::large_motion
