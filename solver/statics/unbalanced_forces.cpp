#include "solver/statics/unbalanced_forces.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/strain.h"
#include "solver/linalg/backward_error.h"
#include "solver/model/numbers.h"

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

/// What the rounding of a constraint's force is a share of: a constraint carries the terms at each
/// of its coordinates to all of them, as a chain of inextensible elements does to its loose end.
/// @returns  constraint row
VectorXd carried_terms(const std::vector<ConstraintRow>& rows, const VectorXd& force,
                       VectorXd terms) {
  VectorXd carried = force.cwiseAbs();
  const auto carry = [&](Index i) {
    const ConstraintRow& row = rows[to_size(i)];
    if (row.source == ConstraintRow::Source::support) return;
    double& size = carried[i];
    for (const auto& [coordinate, coefficient] : row.terms) {
      if (coefficient != 0) size = std::max(size, terms[coordinate] / std::abs(coefficient));
    }
    for (const auto& [coordinate, coefficient] : row.terms)
      terms[coordinate] = std::max(terms[coordinate], std::abs(coefficient) * size);
  };
  for (Index i = 0; i < carried.size(); ++i) carry(i);
  for (Index i = carried.size(); i-- > 0;) carry(i);
  return carried;
}

/// Adds what supports and other constraints exert, with its magnitudes.
void add_constraints(const System& system, const ElasticState& state,
                     const StaticSolution& solution, VectorXd& sum, VectorXd& magnitudes) {
  const VectorXd multipliers = constraint_forces(system, state);
  const VectorXd carried = carried_terms(system.constraints.rows, multipliers, magnitudes);
  for (std::size_t i = 0; i < system.constraints.rows.size(); ++i) {
    const ConstraintRow& row = system.constraints.rows[i];
    double force = multipliers[static_cast<Index>(i)];
    for (const auto& [coordinate, coefficient] : row.terms)
      magnitudes[coordinate] += std::abs(coefficient) * carried[static_cast<Index>(i)];
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
  return largest_ratio(sum, magnitudes);
}

}  // namespace trammel::solver
