#include "solver/linear/rotating_frame.h"

#include <cmath>
#include <numbers>

#include "solver/linalg/gyroscopic.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/free_motions.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/second_order.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

const Eigen::Matrix2d& perpendicular_matrix() {
  static const Eigen::Matrix2d J = (Eigen::Matrix2d() << 0, -1, 1, 0).finished();
  return J;
}

/// Returns the matrix P that projects a vector on the plane or line perpendicular to the axis of
/// rotation.
Eigen::Matrix2d distance_projector(RotationAxis axis) {
  return Eigen::Vector2d(axis == RotationAxis::x ? 0 : 1, axis == RotationAxis::y ? 0 : 1)
      .asDiagonal();
}

/// Returns the matrix that maps (x, y, rotation) of a node to the translation of the center of its
/// point mass.
Eigen::Matrix<double, 2, 3> center_of_mass_interpolation(const PointMass& point_mass) {
  Eigen::Matrix<double, 2, 3> B;
  B << Eigen::Matrix2d::Identity(), perpendicular_matrix() * point_mass.offset;
  return B;
}

/// Returns the integral of rho N^T A N over the volume of a frame element, in element axes. The
/// symbol rho is the density. N interpolates the translations, and A is a 2 x 2 matrix. Lumped mass
/// acts on translations only.
Matrix6d mass_integral(const Eigen::Matrix2d& A, const FrameElement& e, const Member& member) {
  Matrix6d integral = Matrix6d::Zero();
  if (member.mass == MassMatrix::lumped || e.is_bar()) {
    const Matrix6d M = e.is_bar() ? bar_mass(e.section, member.mass, e.length)
                                  : frame_mass(e.section, BeamTheory::euler_bernoulli,
                                               MassMatrix::lumped, e.length);
    for (const Index i : {0, 3}) {
      for (const Index j : {0, 3}) integral.block<2, 2>(i, j) = M(i, j) * A;
    }
    return integral;
  }
  const double m = e.section.mass_per_length * e.length;
  const double phi = shear_ratio(e.section, member.theory, e.length);
  for (const LineQuadraturePoint& point : line_quadrature()) {
    const Eigen::Matrix<double, 2, 6> N = frame_interpolation(phi, e.length, point.xi).topRows<2>();
    integral += point.weight * m * N.transpose() * A * N;
  }
  return integral;
}

/// Returns the mass matrix of the rotary inertia of the sections of a frame element, in world axes.
Matrix6d rotary_mass(FrameElement e, const Member& member) {
  e.section.mass_per_length = 0;
  return world_mass_matrix(e, member);
}

/// Centrifugal effect on a section of unit rotary inertia, for an axis of rotation in the plane.
/// Points of the section at a height y are displaced by y (n cos a - d sin a) from the axis of the
/// member. d is the direction along the member, n is normal to d, and a is the rotation of the
/// section. The squared distance of these points from the rotation axis contains the additional
/// term
///
///   y^2 (2 moment a + stiffness a^2).
///
/// The section therefore rotates toward the direction perpendicular to the rotation axis.
struct SectionPull {
  double moment, stiffness;
};
SectionPull section_pull(const Eigen::Matrix2d& P, const Vector2d& d) {
  const Vector2d n = perpendicular_matrix() * d;
  return {-n.dot(P * d), d.dot(P * d) - n.dot(P * n)};
}

/// Calls visit(coordinates, S, G) for all elements and point masses, in world axes. S and G are the
/// element matrices of the centrifugal and Coriolis forces.
template <class Visit>
void for_each_rotating_mass(const System& system, RotationAxis axis, Visit&& visit) {
  const Model& model = system.model;
  const Eigen::Matrix2d P = distance_projector(axis);
  for (const FrameElement& e : system.mesh.frame) {
    if (e.section.mass_per_length == 0) continue;
    const Member& member = model.members[to_size(e.member)];
    const Matrix6d R = frame_transformation_matrix(e.direction);
    const auto world = [&](const Eigen::Matrix2d& A) -> Matrix6d {
      return R.transpose() * mass_integral(A, e, member) * R;
    };
    const auto r = R.topLeftCorner<2, 2>();
    Matrix6d S = world(r * P * r.transpose());
    if (axis != RotationAxis::normal)
      S += section_pull(P, e.direction).stiffness * rotary_mass(e, member);
    visit(e.coordinates, S, world(perpendicular_matrix()));
  }
  for_each_plate_mass(system, [&](const auto& coordinates, const auto& m) {
    auto S = m;
    auto G = m;
    for (Index i = 0; i < m.rows(); i += 2) {
      for (Index j = 0; j < m.cols(); j += 2) {
        S.template block<2, 2>(i, j) = m(i, j) * P;
        G.template block<2, 2>(i, j) = m(i, j) * perpendicular_matrix();
      }
    }
    visit(coordinates, S, G);
  });
  for (const PointMass& point_mass : model.masses) {
    const Eigen::Matrix<double, 2, 3> B = center_of_mass_interpolation(point_mass);
    visit(system.coordinates.node[to_size(point_mass.node)],
          (point_mass.mass * B.transpose() * P * B).eval(),
          (point_mass.mass * B.transpose() * perpendicular_matrix() * B).eval());
  }
}

}  // namespace

SparseMatrix centrifugal_softening(const System& system, RotationAxis axis) {
  Projection sum(system.constraints);
  for_each_rotating_mass(system, axis, [&](const auto& coordinates, const auto& S, const auto&) {
    sum.add(coordinates, S);
  });
  return sum.build();
}

SparseMatrix gyroscopic_matrix(const System& system) {
  std::vector<Eigen::Triplet<double>> entries;
  const RotationAxis normal = RotationAxis::normal;
  for_each_rotating_mass(system, normal, [&](const auto& coordinates, const auto&, const auto& G) {
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      for (std::size_t j = 0; j < coordinates.size(); ++j) {
        const double g = G(static_cast<Index>(i), static_cast<Index>(j));
        if (coordinates[i] >= 0 && coordinates[j] >= 0)
          entries.emplace_back(coordinates[i], coordinates[j], g);
      }
    }
  });
  SparseMatrix on_u(system.T.rows(), system.T.rows());
  on_u.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix matrix = system.T.transpose() * on_u * system.T;
  const SparseMatrix transposed = matrix.transpose();
  // Make the matrix exactly skew-symmetric.
  return 0.5 * (matrix - transposed);
}

VectorXd centrifugal_forces(const System& system, const RotatingFrame& frame, const VectorXd& u) {
  // The interpolation with the node positions and zero rotations represents the position of every
  // point exactly.
  VectorXd position = u;
  for (std::size_t node = 0; node < system.coordinates.node.size(); ++node) {
    const Vector2d arm = system.mesh.positions[node] - frame.center;
    position[system.coordinates.node[node][0]] += arm.x();
    position[system.coordinates.node[node][1]] += arm.y();
  }
  const double w2 = frame.speed * frame.speed;
  const Eigen::Matrix2d P = distance_projector(frame.axis);
  VectorXd force = VectorXd::Zero(u.size());
  for_each_rotating_mass(
      system, frame.axis, [&](const auto& coordinates, const auto& S, const auto&) {
        detail::scatter(coordinates, (w2 * (S * detail::gather(coordinates, position))).eval(),
                        force);
      });
  // Add the effect of the section height, which the interpolation of the member axis does not
  // include.
  for (const FrameElement& e : system.mesh.frame) {
    if (frame.axis == RotationAxis::normal || e.section.inertia_per_length == 0) continue;
    const Vector2d swept = e.length * (perpendicular_matrix() * e.direction);
    Vector6d unit_turn;
    unit_turn << 0, 0, 1, swept, 1;
    const Member& member = system.model.members[to_size(e.member)];
    const double moment = w2 * section_pull(P, e.direction).moment;
    detail::scatter(e.coordinates, (moment * (rotary_mass(e, member) * unit_turn)).eval(), force);
  }
  // Add the effect of the constant offset of each center of mass from its node, which the
  // interpolation does not include.
  for (const PointMass& point_mass : system.model.masses)
    detail::scatter(system.coordinates.node[to_size(point_mass.node)],
                    (w2 * point_mass.mass * center_of_mass_interpolation(point_mass).transpose() *
                     P * point_mass.offset)
                        .eval(),
                    force);
  return force;
}

BodyForces body_forces(const System& system, const RotatingFrame& frame, const VectorXd& u) {
  BodyForces body = body_forces(system);
  const Eigen::Matrix2d w2 = frame.speed * frame.speed * distance_projector(frame.axis);
  for (std::size_t i = 0; i < system.mesh.frame.size(); ++i) {
    const FrameElement& e = system.mesh.frame[i];
    const auto position = [&](std::size_t end) -> Vector2d {
      return system.mesh.positions[to_size(e.nodes[end])] +
             Vector2d(u[e.coordinates[3 * end]], u[e.coordinates[3 * end + 1]]);
    };
    const Vector2d middle = (position(0) + position(1)) / 2;
    body.element[i] += e.section.mass_per_length * w2 * (middle - frame.center);
  }
  for (std::size_t i = 0; i < system.model.masses.size(); ++i) {
    const PointMass& point_mass = system.model.masses[i];
    const Vector2d position =
        system.model.nodes[to_size(point_mass.node)].position + point_mass.offset +
        center_of_mass_interpolation(point_mass) *
            detail::gather(system.coordinates.node[to_size(point_mass.node)], u);
    body.point_mass[i] += point_mass.mass * w2 * (position - frame.center);
  }
  return body;
}

namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// Computes the steady state of the rotating frame. Returns false if the internal forces do not
/// converge or no steady state exists.
bool find_steady_state(const System& system, const RotatingOptions& options,
                       StiffenedEquilibrium& steady, StaticState& state, Counters& counters) {
  const RotatingFrame& frame = options.frame;
  const VectorXd undeformed = VectorXd::Zero(system.T.rows());
  const VectorXd rhs =
      system.f + system.T.transpose() * centrifugal_forces(system, frame, undeformed);
  // Returns the internal forces of a state q. The displacements u determine the centrifugal forces.
  const auto forces = [&](const VectorXd& q, const VectorXd& u, const Prestress* before) {
    return prestress_of(system, system.T * q, system.load + centrifugal_forces(system, frame, u),
                        body_forces(system, frame, u), before);
  };
  if (options.stiffening && options.prestress_at_steady_state) {
    steady.iterate(
        rhs,
        [&](const VectorXd& q, const Prestress* before) { return forces(q, system.T * q, before); },
        state);
    return state.outcome.solved();
  }
  if (options.stiffening) {
    if (!StiffenedEquilibrium(system, counters).solve(rhs, state)) return false;
    state.forces = forces(state.q, undeformed, nullptr);
  }
  return steady.solve(rhs, state);
}

/// Returns the backward error of the steady state, (K + K_G - W^2 S) q = f + W^2 f_c, at the
/// angular speed W of the frame.
double steady_backward_error(const System& system, const SparseMatrix& added, const VectorXd& q,
                             const RotatingFrame& frame) {
  RowBalance<double> rows(system);
  rows.add_elastic_forces(system.T * q);
  rows.add(added, q);
  rows.add_load(-system.load);
  rows.add_load(-centrifugal_forces(system, frame, VectorXd::Zero(system.T.rows())));
  return rows.backward_error();
}

/// Returns the largest backward error of the modes, (K + K_G - W^2 S + s 2 W G + s^2 M) x = 0 with
/// s = growth rate + i w. W is the angular speed of the frame, and w the angular frequency of a
/// mode.
double mode_backward_error(const System& system, const SparseMatrix& added, const SparseMatrix& C,
                           const MatrixXcd& x, const VectorXcd& s) {
  const MatrixXcd u = system.T * x;
  RowBalance<std::complex<double>> rows(system, x.cols());
  rows.add_elastic_forces(u);
  rows.add_inertia_forces(u * s.cwiseProduct(s).asDiagonal());
  rows.add(added, x);
  rows.add(C, x * s.asDiagonal());
  return rows.backward_error();
}

/// Returns the number of missing or superfluous modes. In a stable state, the modes below the last
/// clear gap between frequencies are counted by a factorization. In an unstable state, the number
/// of modes must be the rank of the mass matrix.
double miscounted_modes(const GyroscopicPencil& pencil, const GyroscopicModes& modes, bool stable) {
  const VectorXd& w = modes.omega;
  if (stable) {
    return eigenvalue_count_error(
        w, [&pencil](double omega) { return gyroscopic_sturm_count(pencil, omega); });
  }
  const double last = w.cwiseAbs2().maxCoeff() + modes.growth_rate.cwiseAbs2().maxCoeff();
  const auto count = Factorization().sturm_count(shifted_matrix(pencil.K, pencil.M, 1e4 * last));
  return count ? std::abs(static_cast<double>(*count - w.size())) : kNaN;
}

GyroscopicModes gyroscopic_modes(const GyroscopicPencil& pencil, bool stable,
                                 const RotatingOptions& options, Counters& counters) {
  constexpr Index kLargestUnstable = 400;
  if (stable) return stable_gyroscopic_modes(pencil, options.count, options.method, counters);
  if (pencil.K.rows() <= kLargestUnstable) return all_gyroscopic_modes(pencil);
  GyroscopicModes modes;
  modes.outcome = {Status::not_converged,
                   "the stiffness of the rotating frame is not positive definite; this requires a "
                   "dense solution, for which the model is too large"};
  return modes;
}

}  // namespace

RotatingModes solve_rotating_modes(const System& system, const RotatingOptions& options) {
  RotatingModes result;
  result.counters = system.counters;
  if (system.K.rows() == 0) return result;
  Factorization K;
  K.compute(system.K);
  ++result.counters.factorizations;
  result.outcome = require_no_mechanism(system, K, result.counters);
  if (result.outcome.solved() && options.stiffening)
    result.outcome = require_determinate_prestress(system);
  if (!result.outcome.solved()) return result;
  const double speed = options.frame.speed;
  const SparseMatrix softening = -speed * speed * centrifugal_softening(system, options.frame.axis);
  StiffenedEquilibrium steady(system, result.counters, &softening);
  StaticState state{{}, VectorXd::Zero(system.K.rows()), {}, 0};
  if (!find_steady_state(system, options, steady, state, result.counters)) {
    result.outcome = {Status::not_converged, "no steady state of the rotating frame was found"};
    return result;
  }
  result.q = state.q;
  const SparseMatrix& added = steady.added_stiffness();
  result.evidence.add(Residual::equilibrium,
                      steady_backward_error(system, added, state.q, options.frame));
  const bool is_gyroscopic = options.gyroscopic && options.frame.axis == RotationAxis::normal;
  SparseMatrix C(system.K.rows(), system.K.cols());
  if (is_gyroscopic) {
    C = 2 * speed * gyroscopic_matrix(system);
    result.counters.add(Effect::gyroscopic, 1);
  }
  const GyroscopicPencil pencil{
      system.K + added, C, system.M, [&](const VectorXd& x) { return steady.restoring_forces(x); },
      [&](const MatrixXd& X) -> MatrixXd {
        return projected_stiffness(system, system.T * X) + X.transpose() * (added * X);
      }};
  // A model without mass has no vibration modes.
  if (system.M.coeffs().isZero(0)) return result;
  const bool stable = steady.is_stable();
  const GyroscopicModes modes = gyroscopic_modes(pencil, stable, options, result.counters);
  result.outcome = modes.outcome;
  const Index kept = std::min(options.count, modes.omega.size());
  result.frequency = modes.omega.head(kept) / (2 * std::numbers::pi);
  result.growth_rate = modes.growth_rate.head(kept);
  result.shape = modes.shape.leftCols(kept);
  result.stable = modes.growth_rate.size() == 0 || modes.growth_rate.maxCoeff() <= 0;
  if (!result.outcome.solved()) return result;
  if (kept > 0) {
    VectorXcd exponent(kept);
    exponent.real() = modes.growth_rate.head(kept);
    exponent.imag() = modes.omega.head(kept);
    result.evidence.add(Residual::eigenvalue_equation,
                        mode_backward_error(system, added, C, result.shape, exponent));
  }
  result.evidence.add(Residual::mode_count, miscounted_modes(pencil, modes, stable));
  result.outcome = outcome_by_evidence(result.outcome, result.evidence);
  return result;
}

}  // namespace trammel::solver
