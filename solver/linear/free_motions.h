#pragma once

#include <Eigen/Core>
#include <string>

#include "solver/linalg/factorization.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Zero-energy modes: a basis of the null space of the stiffness matrix K. The motions in this null
/// space cause no deformation.
struct ZeroEnergyModes {
  Eigen::MatrixXd basis;  ///< one mode per column, in the free coordinates q
  /// false: the null space may be larger than the space in which modes were searched.
  bool all_found = true;
  [[nodiscard]] Eigen::Index count() const { return basis.cols(); }
};

/// Searches for zero-energy modes if the factorization of K has a small, zero or negative pivot.
/// The search uses inverse iteration of K with a small shift. A zero-energy mode u has a strain
/// energy u^T K u that is within its round-off error. The size of a pivot is no sufficient
/// criterion, because a long slender chain is ill-conditioned without being a mechanism.
[[nodiscard]] ZeroEnergyModes find_zero_energy_modes(const System& system, const Factorization& K,
                                                     Counters& counters);

/// Describes a mechanism in words, such as "free motion: node B along x 1, rotation of node A
/// -0.5". Descriptions of several motions are separated by semicolons. The text is empty if `modes`
/// is empty. Each description contains the three largest displacements of the motion, divided by
/// the largest displacement. Rotations are multiplied by the size of the model. The basis is first
/// transformed to echelon form, so that each motion has few nonzero displacements.
[[nodiscard]] std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes);

/// Returns the outcome `singular` with a description of the zero-energy modes if the model has
/// zero-energy modes. Otherwise returns `solved`.
/// @param system  assembled model.
/// @param K  factorization of the stiffness matrix.
/// @param counters  incremented by the factorizations and solves.
[[nodiscard]] Outcome require_no_mechanism(const System& system, const Factorization& K,
                                           Counters& counters);

}  // namespace trammel::solver
