#pragma once

#include "references/data/manufactured.h"
#include "solver/linear/fields.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

/// Manufactured solutions on a mesh: loads from the closed form, solve, errors against the closed
/// form.
namespace trammel::harness {

struct MembraneTest {
  references::manufactured::MembraneProblem problem;
  double thickness = 0;     ///< [m]
  solver::Index cells = 1;  ///< along either side
  bool six_nodes = false;
  double distortion = 0;  ///< of the mesh, in cells
};

/// The discrete model and its solution; q is empty where there is none.
struct ManufacturedSolution {
  solver::Outcome outcome;
  solver::System system;
  Eigen::VectorXd q;  ///< free coordinates
  solver::Evidence evidence;
  solver::Counters counters;
};

struct MembraneTestResult {
  ManufacturedSolution solution;
  solver::MembraneErrors errors;
};

/// @throws ModelError  where the mesh has no meaning
[[nodiscard]] MembraneTestResult run_membrane_test(const MembraneTest& test);

struct BeamTest {
  /// Along the direction (4, 3) / 5, so that no coordinate is left out.
  references::manufactured::BeamProblem problem;
  solver::Index cells = 1;
  double distortion = 0;  ///< of the mesh, in cells
};

struct BeamTestResult {
  ManufacturedSolution solution;
  solver::BeamErrors errors;
};

/// @throws ModelError  where the mesh has no meaning
[[nodiscard]] BeamTestResult run_beam_test(const BeamTest& test);

}  // namespace trammel::harness
