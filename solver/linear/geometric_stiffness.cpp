#include "solver/linear/geometric_stiffness.h"

#include <Eigen/Jacobi>
#include <cmath>
#include <numbers>

#include "solver/elements/triangle_element.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/system.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Returns the matrix L H of the second-order work of the axial force (see
/// `frame_chord_rotation_and_bending`). N is the mean axial force, and n the increase of the axial
/// force along the element.
Eigen::Matrix3d geometric_rigidity(const FrameElement& e, BeamTheory theory, double N, double n) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  H(0, 0) = N;
  if (!e.is_bar()) {
    const double g = 1 / (1 + shear_ratio(e.section, theory, e.length));
    H(1, 1) = N / 12;
    H(2, 2) = g * g * N / 20;
    H(0, 1) = H(1, 0) = n / 12;
    H(1, 2) = H(2, 1) = g * n / 60;
  }
  return e.length * H;
}

/// Calls visit(coordinates, B, H) at one point of a triangle. B maps nodal displacements to the
/// gradients of u and v along the principal axes of the stress. H is the diagonal matrix of
/// principal stress times volume.
template <std::size_t n, class Visit>
void visit_plate_geometric_stiffness(const std::array<Index, n>& coordinates,
                                     const TriangleInterpolation& at,
                                     const Eigen::RowVector3d& stress, double volume,
                                     Visit&& visit) {
  Eigen::Matrix2d tensor;
  tensor << stress[0], stress[2], stress[2], stress[1];
  Eigen::JacobiRotation<double> to_principal;
  to_principal.makeJacobi(tensor, 0, 1);
  tensor.applyOnTheRight(0, 1, to_principal);
  tensor.applyOnTheLeft(0, 1, to_principal.adjoint());
  Eigen::Matrix<double, 2, 6> along = at.gradient;
  along.applyOnTheLeft(0, 1, to_principal.adjoint());
  Eigen::Matrix<double, 4, static_cast<int>(n)> B = Eigen::Matrix<double, 4, n>::Zero();
  for (Index i = 0; i < at.nodes; ++i) {
    B(0, 2 * i) = B(1, 2 * i + 1) = along(0, i);
    B(2, 2 * i) = B(3, 2 * i + 1) = along(1, i);
  }
  const Vector2d s = volume * tensor.diagonal();
  visit(coordinates, B, Eigen::Matrix4d(Eigen::Vector4d(s[0], s[0], s[1], s[1]).asDiagonal()));
}

/// Calls visit(row, triangle, at, weight) for all points of triangles at which stresses are stored.
/// `row` is the row of Prestress::stress, `at` contains the area coordinates of the point, and
/// `weight` is its fraction of the triangle area.
template <class Visit>
void for_each_stress_point(const Model& model, Visit&& visit) {
  Index row = 0;
  for (const Triangle& triangle : model.triangles) {
    if (!triangle.quadratic()) {
      visit(row++, triangle, Vector3d(Vector3d::Constant(1 / 3.0)), 1.0);
      continue;
    }
    for (const TriangleQuadraturePoint& point : triangle_quadrature_of_degree_4())
      visit(row++, triangle, point.area_coordinates, point.weight);
  }
}

/// Returns a matrix of zero stresses with one row for each point of a triangle at which stresses
/// are stored.
Eigen::MatrixX3d zero_stresses_of_triangles(const Model& model) {
  Index rows = 0;
  for_each_stress_point(model, [&](Index row, const auto&...) { rows = row + 1; });
  return Eigen::MatrixX3d::Zero(rows, 3);
}

/// Returns the second-order work of a slider on a rail with direction t and normal n. The vector
/// from the node that rotates the rail to the slider is d. Let θ be the rotation of the node. Small
/// displacements w of the slider relative to the node satisfy
///
///   n . w - θ t . d = 0,
///
/// and to the second order
///
///   n . w - θ t . (d + w) - θ^2 n . d / 2 = 0.
///
/// The work is the force of the rail times the left-hand side of the second equation.
TurningPart rail_part(const System& system, const LinearConstraint::Rail& rail, double force) {
  const auto& node = system.coordinates.node[to_size(rail.node)];
  const auto& slider = system.coordinates.node[to_size(rail.slider)];
  const Vector2d& t = rail.direction;
  const Vector2d d =
      system.mesh.positions[to_size(rail.slider)] - system.mesh.positions[to_size(rail.node)];
  TurningPart part;
  part.coordinates = {node[2], slider[0], slider[1], node[0], node[1]};
  part.B << 1, 0, 0, 0, 0, 0, t.x(), t.y(), -t.x(), -t.y();
  part.H << force * perpendicular(t).dot(d), force, force, 0;
  return part;
}

/// Calls visit(coordinates, B, H) for every term B^T H B of the geometric stiffness matrix K_G.
template <class Visit>
void for_each_geometric_stiffness(const System& system, const Prestress& state, Visit&& visit) {
  const Model& model = system.model;
  for (Index i = 0; i < state.axial.size(); ++i) {
    const FrameElement& e = system.mesh.frame[to_size(i)];
    const double axial = state.axial[i], axial_variation = state.axial_variation[i];
    if (axial == 0 && axial_variation == 0) continue;
    const BeamTheory theory = model.members[to_size(e.member)].theory;
    visit(e.coordinates, frame_chord_rotation_and_bending(e.direction, e.length),
          geometric_rigidity(e, theory, axial, axial_variation));
  }
  for_each_stress_point(
      model, [&](Index row, const Triangle& triangle, const Vector3d& at, double weight) {
        if (row >= state.stress.rows() || state.stress.row(row).isZero(0)) return;
        const Eigen::RowVector3d stress = state.stress.row(row);
        const TriangleInterpolation point = evaluate_shape_functions(model, triangle, at);
        const double volume = model.plates[to_size(triangle.plate)].thickness * point.area * weight;
        visit_nodes(model, triangle, [&]<std::size_t n>(const TriangleNodes<n>&) {
          visit_plate_geometric_stiffness(system.coordinates.triangle_dofs<2 * n>(triangle), point,
                                          stress, volume, visit);
        });
      });
  for (const TurningPart& part : state.turning) visit(part.coordinates, part.B, part.H);
}

void add_turning(Index rotation, double moment, std::vector<TurningPart>& parts) {
  if (moment == 0) return;
  parts.emplace_back().coordinates[0] = rotation;
  parts.back().H(0, 0) = moment;
}

/// Returns the moment F R of a constraint row, or 0 if the row does not describe the end of a rigid
/// arm. R is the x or y component of the arm. A rotation θ shifts the end of the arm by -R θ^2 / 2
/// to the second order. The force F on the end of the arm therefore does the work -F R θ^2 / 2. The
/// multiplier of the constraint is -F.
double rigid_arm_moment(const System& system, const ConstraintRow& row, double multiplier) {
  if (row.source != ConstraintRow::Source::rigid_body || row.terms.size() != 3) return 0;
  const Index attached = row.terms[0].first;
  const Index node = system.coordinates.node_of[to_size(attached)];
  const Index reference = system.coordinates.node_of[to_size(row.terms[1].first)];
  const Vector2d R =
      system.mesh.positions[to_size(node)] - system.mesh.positions[to_size(reference)];
  const bool x = system.coordinates.node[to_size(node)][0] == attached;
  return -multiplier * (x ? R.x() : R.y());
}

}  // namespace

FrameDeformation frame_chord_rotation_and_bending(const Vector2d& direction, double length) {
  const double c = direction.x() / length, s = direction.y() / length;
  FrameDeformation B = frame_deformation_matrix(direction, length);
  B.row(0) << s, -c, 0, -s, c, 0;
  return B;
}

BodyForces body_forces(const System& system) {
  const Model& model = system.model;
  BodyForces body;
  for (const FrameElement& e : system.mesh.frame) {
    const Vector2d& load = model.members[to_size(e.member)].load;
    body.element.emplace_back(load + e.section.mass_per_length * model.gravity);
  }
  for (const PointMass& point_mass : model.masses)
    body.point_mass.emplace_back(point_mass.mass * model.gravity);
  return body;
}

VectorXd axial_forces(const System& system, const VectorXd& u, const VectorXd& multipliers) {
  VectorXd axial(static_cast<Index>(system.mesh.frame.size()));
  for (Index i = 0; i < axial.size(); ++i) {
    const FrameElement& e = system.mesh.frame[to_size(i)];
    const Vector2d shift(u[e.coordinates[3]] - u[e.coordinates[0]],
                         u[e.coordinates[4]] - u[e.coordinates[1]]);
    axial[i] = e.section.EA / e.length * e.direction.dot(shift);
  }
  for (std::size_t i = 0; i < system.constraints.rows.size(); ++i) {
    const ConstraintRow& row = system.constraints.rows[i];
    if (row.source == ConstraintRow::Source::inextensible)
      axial[row.index] = -multipliers[static_cast<Index>(i)];
  }
  return axial;
}

Prestress prestress(const System& system, const VectorXd& u, const VectorXd& multipliers,
                    const BodyForces& body) {
  Prestress state;
  state.axial = axial_forces(system, u, multipliers);
  state.axial_variation.resize(state.axial.size());
  for (Index i = 0; i < state.axial_variation.size(); ++i) {
    const FrameElement& e = system.mesh.frame[to_size(i)];
    state.axial_variation[i] = -e.length * e.direction.dot(body.element[to_size(i)]);
  }
  state.stress = zero_stresses_of_triangles(system.model);
  for_each_stress_point(system.model,
                        [&](Index row, const Triangle& triangle, const Vector3d& at, double) {
                          state.stress.row(row) = plate_stress(system, triangle, at, u);
                        });
  for (Index i = 0; i < multipliers.size(); ++i) {
    const ConstraintRow& row = system.constraints.rows[to_size(i)];
    const double moment = rigid_arm_moment(system, row, multipliers[i]);
    if (moment != 0) add_turning(row.terms[2].first, moment, state.turning);
    if (row.source != ConstraintRow::Source::linear) continue;
    const auto& rail = system.model.constraints[to_size(row.index)].rail;
    if (rail && system.coordinates.node[to_size(rail->node)][2] >= 0)
      state.turning.push_back(rail_part(system, *rail, multipliers[i]));
  }
  for (std::size_t i = 0; i < system.model.masses.size(); ++i) {
    const PointMass& point_mass = system.model.masses[i];
    add_turning(system.coordinates.node[to_size(point_mass.node)][2],
                body.point_mass[i].dot(point_mass.offset), state.turning);
  }
  return state;
}

Prestress prestress_roundoff(const System& system, const VectorXd& q) {
  const VectorXd u = system.T.cwiseAbs() * q.cwiseAbs();
  Prestress roundoff;
  const std::vector<FrameElement>& frame = system.mesh.frame;
  roundoff.axial.setZero(std::ssize(frame));
  roundoff.axial_variation.setZero(std::ssize(frame));
  for (Index i = 0; i < roundoff.axial.size(); ++i) {
    const FrameElement& e = frame[to_size(i)];
    if (!system.model.members[to_size(e.member)].axially_flexible) continue;
    // The elongation is a difference of displacements. The round-off errors of the displacements do
    // not cancel, so that the error is proportional to the sum of their magnitudes.
    const Vector2d size(u[e.coordinates[3]] + u[e.coordinates[0]],
                        u[e.coordinates[4]] + u[e.coordinates[1]]);
    roundoff.axial[i] = kEps * e.section.EA / e.length * e.direction.cwiseAbs().dot(size);
  }
  roundoff.stress = zero_stresses_of_triangles(system.model);
  for_each_stress_point(system.model, [&](Index row, const Triangle& triangle, const Vector3d& at,
                                          double) {
    roundoff.stress.row(row).head<2>().setConstant(plate_stress_roundoff(system, triangle, at, u));
  });
  const VectorXd force = internal_force_roundoff(system, u);
  for (const ConstraintRow& row : system.constraints.rows) {
    const double moment = std::abs(rigid_arm_moment(system, row, force[row.terms.front().first]));
    if (moment != 0) add_turning(row.terms[2].first, moment, roundoff.turning);
  }
  return roundoff;
}

Outcome require_determinate_prestress(const System& system) {
  const Constraints& constraints = system.constraints;
  VectorXd selfstress = VectorXd::Zero(std::ssize(constraints.rows));
  VectorXd force = VectorXd::Zero(system.T.rows());
  // Use different forces in redundant constraints, so that their effects do not cancel.
  double amount = 1;
  for (Index i = 0; i < selfstress.size(); ++i) {
    if (constraints.pivot[to_size(i)] >= 0) continue;
    selfstress[i] = amount;
    for (const auto& [u, c] : constraints.rows[to_size(i)].terms) force[u] -= c * amount;
    amount = std::fmod(amount + std::numbers::phi, 1.0) + 0.5;
  }
  if (selfstress.isZero(0)) return {};
  selfstress += constraints.lagrange_multipliers(force);
  const BodyForces none{std::vector<Vector2d>(system.mesh.frame.size(), Vector2d::Zero()),
                        std::vector<Vector2d>(system.model.masses.size(), Vector2d::Zero())};
  const VectorXd at_rest = VectorXd::Zero(system.T.rows());
  SparseMatrix K_G = geometric_stiffness(system, prestress(system, at_rest, selfstress, none));
  const double size = box_diagonal(system.mesh.positions);
  const VectorXd length =
      (free_to_length_matrix(system).cwiseAbs().transpose() * VectorXd::Ones(system.T.rows()));
  K_G = length.cwiseInverse().asDiagonal() * K_G * length.cwiseInverse().asDiagonal();
  const double stiffening = K_G.nonZeros() > 0 ? K_G.coeffs().abs().maxCoeff() : 0;
  if (stiffening * size <= 1e-9 * selfstress.cwiseAbs().maxCoeff()) return {};
  return {Status::singular,
          "forces of redundant constraints, which statics does not determine, stiffen or soften "
          "the model: make a member or body between these constraints flexible"};
}

SparseMatrix geometric_stiffness(const System& system, const Prestress& state) {
  Projection sum(system.constraints);
  for_each_geometric_stiffness(system, state,
                               [&](const auto& coordinates, const auto& B, const auto& H) {
                                 sum.add(coordinates, (B.transpose() * H * B).eval());
                               });
  return sum.build();
}

VectorXd geometric_stiffness_forces(const System& system, const Prestress& state,
                                    const VectorXd& u) {
  VectorXd force = VectorXd::Zero(u.size());
  for_each_geometric_stiffness(
      system, state, [&](const auto& coordinates, const auto& B, const auto& H) {
        const auto local = (B.transpose() * (H * (B * detail::gather(coordinates, u)))).eval();
        detail::scatter(coordinates, local, force);
      });
  return force;
}

double geometric_energy_roundoff(const System& system, const SparseMatrix& K_G,
                                 const Prestress& roundoff, const VectorXd& x) {
  const VectorXd u = system.T * x, size = x.cwiseAbs();
  return kEps * size.dot(K_G.cwiseAbs() * size) +
         u.dot(geometric_stiffness_forces(system, roundoff, u));
}

Vector6d geometric_stiffness_forces(const FrameElement& element, BeamTheory theory, double axial,
                                    double axial_variation, const Vector6d& u) {
  const Vector3d d = frame_chord_rotation_and_bending(element.direction, element.length) * u;
  return frame_chord_rotation_and_bending(Vector2d::UnitX(), element.length).transpose() *
         (geometric_rigidity(element, theory, axial, axial_variation) * d);
}

}  // namespace trammel::solver
