#include "solver/statics/unbalanced_forces.h"

#include <cmath>

#include "solver/assembly/length_scales.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/backward_error.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Forces that the nodes exert on the members by their section forces, less the members' loads.
void add_members(const System& system, const ElasticState& state, const StaticSolution& solution,
                 VectorXd& sum) {
  const ElementForces forces = end_forces(system, state);
  const auto& frame = system.mesh.frame;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const FrameElement& e = frame[i];
    const bool first = i == 0 || frame[i - 1].member != e.member;
    const bool last = i + 1 == frame.size() || frame[i + 1].member != e.member;
    Vector6d force = forces.col(static_cast<Index>(i));
    if (first) force.head<3>() = -solution.resultant_start.row(e.member).transpose();
    if (last) force.tail<3>() = solution.resultant_end.row(e.member).transpose();
    force = frame_rotation(e.direction).transpose() * force;
    // A bar's section forces hold its loads already; a beam's are those at its very ends.
    detail::scatter(e.coordinates, (force + element_load(e, acting_load(system, state, e))).eval(),
                    sum);
  }
}

/// Of springs and triangles; second-order forces of all but the members, whose section forces hold
/// theirs.
void add_other_elements(const System& system, const ElasticState& state, VectorXd& sum) {
  const auto add = [&](const auto& coordinates, const auto& B, const auto& c) {
    const auto deformation = (B * detail::gather(coordinates, state.u)).eval();
    detail::scatter(coordinates, (B.transpose() * c.cwiseProduct(deformation)).eval(), sum);
  };
  for_each_plate_deformation(system, add);
  for (const SpringElement& spring : system.springs) {
    add(spring.coordinates, Eigen::RowVector2d(-1, 1),
        Eigen::Matrix<double, 1, 1>(spring.stiffness));
  }
  if (!state.prestress) return;
  Prestress rest = *state.prestress;
  rest.axial.setZero();
  rest.axial_variation.setZero();
  sum += geometric_stiffness_forces(system, rest, state.u);
}

/// Adds what supports and other constraints exert, with its magnitudes.
void add_constraints(const System& system, const ElasticState& state,
                     const StaticSolution& solution, VectorXd& sum, VectorXd& magnitudes) {
  const VectorXd multipliers = constraint_forces(system, state);
  for (std::size_t i = 0; i < system.constraints.rows.size(); ++i) {
    const ConstraintRow& row = system.constraints.rows[i];
    double force = multipliers[static_cast<Index>(i)];
    for (const auto& [coordinate, coefficient] : row.terms)
      magnitudes[coordinate] += std::abs(coefficient * force);
    if (row.source == ConstraintRow::Source::inextensible) continue;  // the members have it
    if (row.source == ConstraintRow::Source::support)
      force = solution.reaction(row.index, support_component(system, row));
    for (const auto& [coordinate, coefficient] : row.terms) sum[coordinate] -= coefficient * force;
  }
}

}  // namespace

double unbalanced_forces(const System& system, const ElasticState& state,
                         const StaticSolution& solution, const VectorXd& terms) {
  VectorXd sum = -acting_load(system, state);
  VectorXd magnitudes = terms;
  add_members(system, state, solution, sum);
  add_other_elements(system, state, sum);
  add_constraints(system, state, solution, sum, magnitudes);
  // Constraints carry the round-off of a force to other coordinates, as a chain of inextensible
  // elements does to its loose end.
  const VectorXd length = length_scales(system);
  const double largest = magnitudes.cwiseQuotient(length).maxCoeff();
  return largest_ratio(sum, magnitudes.cwiseMax(kLeastShare * largest * length));
}

}  // namespace trammel::solver
