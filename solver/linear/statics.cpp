#include "solver/linear/statics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/linalg/dense_eigen.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/second_order.h"
#include "solver/linear/system.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

/// Returns the number of correct digits for a relative error, limited to the precision of a double.
double digits(double error) {
  return -std::log10(std::clamp(error, kEps, 1.0));
}

/// Returns the factor by which the loads amplify the second-order displacement d = -(K + K_G)^-1
/// K_G q, where q is the first-order displacement. This factor is the ratio of the elastic
/// stiffness to the stiffness under load for the motion d:
///
///   d^T K d / d^T (K + K_G) d.
///
/// For a single buckling shape, the factor is 1 / (1 - fraction of the buckling load). The part of
/// q that causes no second-order displacement does not affect the factor.
double amplification(const System& system, const VectorXd& first, const StaticState& second) {
  const VectorXd added = second.q - first;
  const double stiffness = projected_stiffness(system, system.T * added)(0, 0);
  const double roundoff = second.error * second.error;
  if (stiffness <= roundoff * projected_stiffness(system, system.T * first)(0, 0)) return 1;
  const double left = -added.dot(geometric_stiffness(system, second.forces) * first);
  return stiffness > 0 && left > 0 ? stiffness / left : 1;
}

/// Adds residuals to the evidence of the solution: the residual of K q + K_G q = f with newly
/// computed matrices K and K_G, and the imbalance of the reported forces.
void record_residuals(const System& system, const ElasticState& state, StaticSolution& solution) {
  RowBalance<double> rows(system);
  rows.add_elastic_forces(state.u);
  rows.add_load(-system.load);
  if (state.prestress) {
    rows.add(geometric_stiffness(system, *state.prestress), solution.q);
    // The geometric stiffness matrix K_G results from differences of larger values. The round-off
    // errors of these values are added to the scale of the residual.
    const Prestress roundoff = prestress_roundoff(system, solution.q);
    rows.add_term_magnitudes(geometric_stiffness_forces(system, roundoff, state.u).cwiseAbs() /
                             kEps);
  }
  solution.evidence.add(Residual::equilibrium, rows.backward_error());
  solution.evidence.add(Residual::load, rows.residual_over_load());
  solution.evidence.add(Residual::recovered_forces,
                        largest_relative_imbalance(system, state, solution, rows.magnitudes()));
}

}  // namespace

StaticSolution solve_statics(const System& system, const StaticsOptions& options) {
  StaticSolution solution;
  solution.counters = system.counters;
  StaticState reached{{}, VectorXd::Zero(system.K.rows()), {}, 0};
  if (reached.q.size() > 0) reached = solve_linear_statics(system, solution.counters);
  ElasticState state;
  if (options.second_order && reached.outcome.solved() && reached.q.size() > 0) {
    const VectorXd linear = reached.q;
    reached = solve_second_order(system, linear, solution.counters);
    if (reached.outcome.solved()) solution.amplification = amplification(system, linear, reached);
    solution.forces = reached.forces;
    state.prestress = &solution.forces;
  }
  solution.outcome = reached.outcome;
  if (!solution.outcome.solved()) return solution;
  solution.q = reached.q;
  solution.estimated_correct_digits = digits(reached.error);
  state.u = system.T * solution.q;
  state.constraint_forces = constraint_multipliers(system, state);
  postprocess(system, state, solution);
  record_residuals(system, state, solution);
  solution.outcome = outcome_by_evidence(solution.outcome, solution.evidence);
  return solution;
}

namespace {

/// Section forces N, V and M along one element. The forces act on a face whose normal points from
/// the first to the second node:
///
///   EI v'' = M, dM/dx = -V, dV/dx = -qy, dN/dx = -qx.
struct SectionForces {
  Vector3d start;
  Vector3d end;
  Vector2d load;  ///< mean (qx, qy) along and across the element, including inertia [N/m]

  /// Returns the section forces N, V and M at a distance x from the first end of the element. M is
  /// a parabola through both end moments.
  [[nodiscard]] Vector3d at(double x, double length) const {
    const double straight = start[2] + (end[2] - start[2]) * x / length;
    return {start[0] - load.x() * x, start[1] - load.y() * x,
            straight - load.y() * x * (length - x) / 2};
  }
  /// Returns the slope dM/dx = -V of the bending moment at the first end of the element. V acts
  /// across the undeformed axis. In second-order theory, the axial force contributes to dM/dx.
  [[nodiscard]] double slope(double length) const {
    return (end[2] - start[2]) / length - load.y() * length / 2;
  }
};

SectionForces section_forces(const Vector6d& end, double length) {
  const Vector2d load = -(end.head<2>() + end.segment<2>(3)) / length;
  return {-end.head<3>(), end.tail<3>(), load};
}

/// Returns |N| / A + |M| / W at a point of an element [Pa]. The result is 0 at the pointed end of a
/// taper. The result is NaN if the section has no area or modulus and the force or moment exceeds
/// `roundoff`.
double point_stress(const Member& member, const FrameElement& e, double from_start, double x,
                    const Vector3d& forces, const ForceRoundoff& roundoff) {
  const double length = e.length * static_cast<double>(member.elements);
  const Section section = section_at(member, std::min(1.0, (from_start + x) / length));
  const bool tip = (section.area <= 0 && e.section.area > 0) ||
                   (section.section_modulus <= 0 && e.section.section_modulus > 0);
  if (tip) return 0;
  const double axial = stress_of_force(forces[0], section.area, roundoff.force);
  const double bending = stress_of_force(forces[2], section.section_modulus, roundoff.moment);
  return axial + bending;
}

/// Returns the largest stress of an element [Pa]. The stress is evaluated at both ends and, under a
/// transverse load, at the two possible stationary points of |N|/A + |M|/W. For a taper, the stress
/// is also evaluated at intermediate points.
double largest_stress(const Member& member, const FrameElement& e, double from_start,
                      const SectionForces& f, const ForceRoundoff& roundoff) {
  double largest = 0;
  const auto evaluate = [&](double x) {
    if (!(x >= 0 && x <= e.length)) return;
    largest = nan_max(largest, point_stress(member, e, from_start, x, f.at(x, e.length), roundoff));
  };
  evaluate(0);
  evaluate(e.length);
  const bool tapers = member.section.section_modulus != member.end_section.section_modulus ||
                      member.section.area != member.end_section.area;
  // Number of intervals of the search for the largest stress, which underestimates a smooth maximum
  // by less than 1 %.
  constexpr int kPoints = 16;
  for (int k = 1; tapers && k < kPoints; ++k) evaluate(e.length * k / kPoints);
  if (f.load.y() != 0) {
    const double lever =
        e.section.area > 0 ? f.load.x() * e.section.section_modulus / e.section.area : 0;
    const double slope = f.slope(e.length);  // dM/dx = slope + q_y x
    evaluate((-slope - lever) / f.load.y());
    evaluate((-slope + lever) / f.load.y());
  }
  return largest;
}

void recover_displacements(const System& system, const RecoveredForces& forces,
                           StaticSolution& solution) {
  const Model& model = system.model;
  solution.displacement = node_motion_from_unconstrained(system, forces.u);
  solution.end_rotation.resize(std::ssize(model.members), 2);
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const auto& [first, second] = model.members[i].nodes;
    const Vector2d span = forces.position[to_size(second)] - forces.position[to_size(first)];
    const Vector2d shift =
        (solution.displacement.row(second) - solution.displacement.row(first)).head<2>();
    for (std::size_t end = 0; end < 2; ++end) {
      const Index c = system.coordinates.member_end[i][end];
      // A bar does not bend, so that both ends rotate with the line between its nodes.
      solution.end_rotation(static_cast<Index>(i), static_cast<Index>(end)) =
          c < 0 ? cross(span, shift) / span.squaredNorm() : forces.u[c];
    }
  }
}

void recover_members(const System& system, const RecoveredForces& forces,
                     StaticSolution& solution) {
  const ForceRoundoff roundoff = force_roundoff(forces.element, box_diagonal(forces.position));
  const auto count = std::ssize(system.model.members);
  solution.resultant_start.resize(count, 3);
  solution.resultant_end.resize(count, 3);
  solution.member_stress.setZero(count);
  double from_start = 0;
  for (std::size_t i = 0; i < system.mesh.frame.size(); ++i) {
    const FrameElement& e = system.mesh.frame[i];
    const bool first = i == 0 || system.mesh.frame[i - 1].member != e.member;
    const auto section = section_forces(forces.element.col(static_cast<Index>(i)), e.length);
    if (first) from_start = 0;
    if (first) solution.resultant_start.row(e.member) = section.start;
    solution.resultant_end.row(e.member) = section.end;
    double& largest = solution.member_stress[e.member];
    largest = nan_max(largest, largest_stress(system.model.members[to_size(e.member)], e,
                                              from_start, section, roundoff));
    from_start += e.length;
  }
}

void recover_triangles(const System& system, const VectorXd& u, StaticSolution& solution) {
  const Model& model = system.model;
  solution.triangle_stress.resize(std::ssize(model.triangles), 3);
  solution.node_stress.setZero(std::ssize(model.nodes), 3);
  VectorXd area = VectorXd::Zero(std::ssize(model.nodes));
  const std::array<Vector3d, 6> points = triangle_node_area_coordinates();
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const Triangle& triangle = model.triangles[i];
    const double size = std::abs(signed_area(triangle_nodes<3>(model, triangle)));
    const auto stress = [&](const Vector3d& at) { return plate_stress(system, triangle, at, u); };
    solution.triangle_stress.row(static_cast<Index>(i)) = stress(Vector3d::Constant(1 / 3.0));
    for (std::size_t k = 0; k < (triangle.quadratic() ? 6 : 3); ++k) {
      solution.node_stress.row(triangle.nodes[k]) += size * stress(points[k]);
      area[triangle.nodes[k]] += size;
    }
  }
  for (Index node = 0; node < area.size(); ++node) solution.node_stress.row(node) /= area[node];
}

/// Sums all external actions on the model: loads, reactions and springs to the ground. In
/// second-order theory, the sum includes the forces of the geometric stiffness.
void sum_external_forces(const System& system, const ElasticState& state,
                         StaticSolution& solution) {
  VectorXd load = acting_load(system, state);
  // Second-order theory: subtract the forces of the geometric stiffness.
  if (state.prestress) {
    load -= geometric_stiffness_forces(system, *state.prestress, state.u);
  }
  for (const SpringElement& spring : system.springs) {
    const auto& [ground, node] = spring.coordinates;
    if (ground < 0) load[node] -= spring.stiffness * state.u[node];
  }
  const ForceSum sum = sum_forces(system, system.mesh.positions, load, solution);
  solution.equilibrium_residual = sum.force.norm();
  solution.moment_residual = std::abs(sum.moment);
}

}  // namespace

VectorXd acting_load(const System& system, const ElasticState& state) {
  return state.load_factor * system.load +
         (state.weight_factor - state.load_factor) * system.weight;
}

Vector2d acting_line_load(const System& system, const ElasticState& state,
                          const FrameElement& element) {
  const Member& member = system.model.members[to_size(element.member)];
  return state.load_factor * member.load +
         state.weight_factor * element.section.mass_per_length * system.model.gravity;
}

VectorXd constraint_multipliers(const System& system, const ElasticState& state) {
  if (state.constraint_forces.size() > 0) return state.constraint_forces;
  VectorXd force = internal_forces(system, state.u) - acting_load(system, state);
  if (state.prestress) force += geometric_stiffness_forces(system, *state.prestress, state.u);
  if (state.acceleration.size() > 0) force += inertia_forces(system, state.acceleration);
  return system.constraints.lagrange_multipliers(force);
}

ForceRoundoff force_roundoff(const ElementForces& ends, double size) {
  // Limit relative to the largest end force or moment. It equals the limit of the residual
  // `equilibrium`.
  constexpr double kShare = 1e-10;
  if (ends.cols() == 0) return {};
  double force = 0, moment = 0;
  for (const Index end : {0, 3}) {
    force = std::max(force, ends.middleRows<2>(end).cwiseAbs().maxCoeff());
    moment = std::max(moment, ends.row(end + 2).cwiseAbs().maxCoeff());
  }
  return {kShare * std::max(force, size > 0 ? moment / size : 0),
          kShare * std::max(moment, force * size)};
}

ElementForces end_forces(const System& system, const ElasticState& state) {
  const VectorXd axial = axial_forces(system, state.u, constraint_multipliers(system, state));
  ElementForces forces(6, std::ssize(system.mesh.frame));
  for (Index index = 0; index < forces.cols(); ++index) {
    const FrameElement& e = system.mesh.frame[to_size(index)];
    const Member& member = system.model.members[to_size(e.member)];
    const Vector6d u = detail::gather(e.coordinates, state.u);
    Vector3d s = frame_deformation_stiffness(e.section, member.theory, e.length)
                     .cwiseProduct(frame_deformation_matrix(e.direction, e.length) * u);
    s[0] = axial[index];
    Vector6d force =
        frame_deformation_matrix(Vector2d(Vector2d::UnitX()), e.length).transpose() * s;
    if (state.prestress)
      force += geometric_stiffness_forces(e, member.theory, state.prestress->axial[index],
                                          state.prestress->axial_variation[index], u);
    const Matrix6d R = frame_transformation_matrix(e.direction);
    if (state.acceleration.size() > 0)
      force += R * (e.mass * detail::gather(e.coordinates, state.acceleration));
    force -= R * element_load(e, acting_line_load(system, state, e));
    forces.col(index) = force;
  }
  return forces;
}

Index support_component(const System& system, const ConstraintRow& row) {
  const Index u = row.terms.front().first;
  const auto& node =
      system.coordinates.node[to_size(system.model.supports[to_size(row.index)].node)];
  return u == node[0] ? 0 : u == node[1] ? 1 : 2;
}

void set_displacements_and_forces(const System& system, const RecoveredForces& forces,
                                  StaticSolution& solution) {
  recover_displacements(system, forces, solution);
  solution.reaction.setZero(std::ssize(system.model.supports), 3);
  for (std::size_t i = 0; i < forces.constraints.rows.size(); ++i) {
    const ConstraintRow& row = forces.constraints.rows[i];
    if (row.source != ConstraintRow::Source::support) continue;
    solution.reaction(row.index, support_component(system, row)) =
        forces.multipliers[static_cast<Index>(i)];
  }
  recover_members(system, forces, solution);
}

void ForceSum::add(const Vector2d& at, const Vector2d& f, double m) {
  force += f;
  moment += m + cross(at, f);
  terms += Vector2d(f.norm(), std::abs(m) + at.norm() * f.norm());
}

ForceSum sum_forces(const System& system, const std::vector<Vector2d>& position,
                    const VectorXd& load, const StaticSolution& solution) {
  ForceSum sum;
  for (Index i = 0; i < load.size(); ++i) {
    const Index node = system.coordinates.node_of[to_size(i)];
    const bool x = system.coordinates.node[to_size(node)][0] == i;
    if (system.coordinates.is_rotation[to_size(i)]) {
      sum.add(position[to_size(node)], Vector2d::Zero(), load[i]);
    } else {
      sum.add(position[to_size(node)], load[i] * (x ? Vector2d::UnitX() : Vector2d::UnitY()), 0);
    }
  }
  for (std::size_t i = 0; i < system.model.supports.size(); ++i) {
    const Eigen::RowVector3d r = solution.reaction.row(static_cast<Index>(i));
    sum.add(position[to_size(system.model.supports[i].node)], {r[0], r[1]}, r[2]);
  }
  return sum;
}

void postprocess(const System& system, const ElasticState& state, StaticSolution& solution) {
  set_displacements_and_forces(system,
                               {system.mesh.positions, state.u, system.constraints,
                                constraint_multipliers(system, state), end_forces(system, state)},
                               solution);
  recover_triangles(system, state.u, solution);
  sum_external_forces(system, state, solution);
}

namespace {

/// Adds the forces of nodes on members to `sum`. The forces are computed from section forces and
/// member loads.
void add_member_forces(const System& system, const ElasticState& state,
                       const StaticSolution& solution, VectorXd& sum) {
  const ElementForces forces = end_forces(system, state);
  const auto& frame = system.mesh.frame;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const FrameElement& e = frame[i];
    const bool first = i == 0 || frame[i - 1].member != e.member;
    const bool last = i + 1 == frame.size() || frame[i + 1].member != e.member;
    Vector6d force = forces.col(static_cast<Index>(i));
    if (first) force.head<3>() = -solution.resultant_start.row(e.member).transpose();
    if (last) force.tail<3>() = solution.resultant_end.row(e.member).transpose();
    force = frame_transformation_matrix(e.direction).transpose() * force;
    // Add the nodal forces of the load along the element, which the section forces at its ends do
    // not include.
    detail::scatter(e.coordinates,
                    (force + element_load(e, acting_line_load(system, state, e))).eval(), sum);
  }
}

/// Adds the forces of springs and triangles, and the second-order forces of all elements except
/// members. The section forces of members include the second-order forces of members.
void add_other_elements(const System& system, const ElasticState& state, VectorXd& sum) {
  const auto add = [&](const auto& coordinates, const auto& B, const auto& c) {
    const auto deformation = (B * detail::gather(coordinates, state.u)).eval();
    detail::scatter(coordinates, (B.transpose() * c.cwiseProduct(deformation)).eval(), sum);
  };
  for_each_plate_deformation(system, add);
  for (const SpringElement& spring : system.springs)
    add(spring.coordinates, Eigen::RowVector2d(-1, 1),
        Eigen::Matrix<double, 1, 1>(spring.stiffness));
  if (!state.prestress) return;
  Prestress rest = *state.prestress;
  rest.axial.setZero();
  rest.axial_variation.setZero();
  sum += geometric_stiffness_forces(system, rest, state.u);
}

/// Adds the forces of supports and other constraints to `sum`, and their magnitudes to
/// `magnitudes`.
void add_constraints(const System& system, const ElasticState& state,
                     const StaticSolution& solution, VectorXd& sum, VectorXd& magnitudes) {
  const VectorXd multipliers = constraint_multipliers(system, state);
  for (std::size_t i = 0; i < system.constraints.rows.size(); ++i) {
    const ConstraintRow& row = system.constraints.rows[i];
    double force = multipliers[static_cast<Index>(i)];
    for (const auto& [coordinate, coefficient] : row.terms)
      magnitudes[coordinate] += std::abs(coefficient * force);
    // The section forces of an inextensible member include its constraint force.
    if (row.source == ConstraintRow::Source::inextensible) continue;
    if (row.source == ConstraintRow::Source::support)
      force = solution.reaction(row.index, support_component(system, row));
    for (const auto& [coordinate, coefficient] : row.terms) sum[coordinate] -= coefficient * force;
  }
}

}  // namespace

double largest_relative_imbalance(const System& system, const ElasticState& state,
                                  const StaticSolution& solution, const VectorXd& terms) {
  VectorXd sum = -acting_load(system, state);
  VectorXd magnitudes = terms;
  add_member_forces(system, state, solution, sum);
  add_other_elements(system, state, sum);
  add_constraints(system, state, solution, sum, magnitudes);
  // Constraints transfer the round-off error of a force to other coordinates, for example along a
  // chain of inextensible elements to the free end of the chain.
  const VectorXd length = length_scales(system);
  const double largest = magnitudes.cwiseQuotient(length).maxCoeff();
  return row_backward_error(sum, magnitudes.cwiseMax(kLeastFraction * largest * length));
}

}  // namespace trammel::solver
