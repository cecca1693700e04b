#pragma once

#include "references/data/manufactured.h"
#include "solver/linear/fields.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

/// Method of manufactured solutions on a mesh: derives loads from the closed form, solves, and
/// computes errors against the closed form.
namespace trammel::harness {

struct MembraneTest {
  references::manufactured::MembraneProblem problem;
  double thickness = 0;     ///< thickness of the membrane [m]
  solver::Index cells = 1;  ///< number of cells along each side
  bool six_nodes = false;
  double distortion = 0;  ///< displacement of inner mesh nodes, relative to the size of a cell
};

/// Discrete model and its solution. The vector q is empty if there is no solution.
struct ManufacturedSolution {
  solver::Outcome outcome;
  solver::System system;
  Eigen::VectorXd q;  ///< values of the free coordinates
  solver::Evidence evidence;
  solver::Counters counters;
};

struct MembraneTestResult {
  ManufacturedSolution solution;
  solver::MembraneErrors errors;
};

/// Solves a manufactured membrane problem and computes its errors.
/// @throws ModelError  if the mesh is invalid.
[[nodiscard]] MembraneTestResult run_membrane_test(const MembraneTest& test);

struct BeamTest {
  /// Exact solution of a beam along the direction (4, 3) / 5, so that all coordinates are excited.
  references::manufactured::BeamProblem problem;
  solver::Index cells = 1;
  double distortion = 0;  ///< displacement of inner mesh nodes, relative to the size of a cell
};

struct BeamTestResult {
  ManufacturedSolution solution;
  solver::BeamErrors errors;
};

/// Solves a manufactured beam problem and computes its errors.
/// @throws ModelError  if the mesh is invalid.
[[nodiscard]] BeamTestResult run_beam_test(const BeamTest& test);

}  // namespace trammel::harness
