#include "solver/assembly/rotating_frame.h"

#include "solver/assembly/element_mass.h"
#include "solver/assembly/projection.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

const Eigen::Matrix2d& perpendicular_matrix() {
  static const Eigen::Matrix2d J = (Eigen::Matrix2d() << 0, -1, 1, 0).finished();
  return J;
}

/// The part of a vector that leads away from the axis.
Eigen::Matrix2d distance_projector(RotationAxis axis) {
  return Eigen::Vector2d(axis == RotationAxis::x ? 0 : 1, axis == RotationAxis::y ? 0 : 1)
      .asDiagonal();
}

/// Translation of a point mass's centre from (x, y, rotation) of its node.
Eigen::Matrix<double, 2, 3> centre_of_mass_interpolation(const PointMass& point_mass) {
  Eigen::Matrix<double, 2, 3> B;
  B << Eigen::Matrix2d::Identity(), perpendicular_matrix() * point_mass.offset;
  return B;
}

/// integral rho N^T A N of a frame element in its axes; lumped mass turns nothing.
Matrix6d frame_mass_with(const Eigen::Matrix2d& A, const FrameElement& e, const Member& member) {
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

/// integral rho I N^T N of the rotation of a frame element's sections, in world axes.
Matrix6d rotary_mass(FrameElement e, const Member& member) {
  e.section.mass_per_length = 0;
  return world_mass(e, member);
}

/// What a section of unit rotary inertia feels about an axis in the plane. Its points at a height y
/// stand y (n cos a - d sin a) beside the axis of the member, d along and n across it, so that the
/// square of their distance adds y^2 (2 moment a + stiffness a^2): the section turns across the
/// axis.
struct SectionPull {
  double moment, stiffness;
};
SectionPull section_pull(const Eigen::Matrix2d& P, const Vector2d& d) {
  const Vector2d n = perpendicular_matrix() * d;
  return {-n.dot(P * d), d.dot(P * d) - n.dot(P * n)};
}

/// Calls visit(coordinates, S, G) for everything that has mass, in world axes.
template <class Visit>
void for_each_rotating_mass(const System& system, RotationAxis axis, Visit&& visit) {
  const Model& model = system.model;
  const Eigen::Matrix2d P = distance_projector(axis);
  for (const FrameElement& e : system.mesh.frame) {
    if (e.section.mass_per_length == 0) continue;
    const Member& member = model.members[static_cast<std::size_t>(e.member)];
    const Matrix6d R = frame_rotation(e.direction);
    const auto world = [&](const Eigen::Matrix2d& A) -> Matrix6d {
      return R.transpose() * frame_mass_with(A, e, member) * R;
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
    const Eigen::Matrix<double, 2, 3> B = centre_of_mass_interpolation(point_mass);
    visit(system.coordinates.node[static_cast<std::size_t>(point_mass.node)],
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
  return 0.5 * (matrix - transposed);  // skew to the last bit
}

VectorXd centrifugal_forces(const System& system, const RotatingFrame& frame, const VectorXd& u) {
  // The interpolation holds the position of every point: the nodes' positions with no rotation.
  VectorXd position = u;
  for (std::size_t node = 0; node < system.coordinates.node.size(); ++node) {
    const Vector2d arm = system.mesh.positions[node] - frame.centre;
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
  for (const FrameElement& e : system.mesh.frame) {  // but for the sections' heights
    if (frame.axis == RotationAxis::normal || e.section.inertia_per_length == 0) continue;
    const Vector2d swept = e.length * (perpendicular_matrix() * e.direction);
    Vector6d unit_turn;
    unit_turn << 0, 0, 1, swept, 1;
    const Member& member = system.model.members[to_size(e.member)];
    const double moment = w2 * section_pull(P, e.direction).moment;
    detail::scatter(e.coordinates, (moment * (rotary_mass(e, member) * unit_turn)).eval(), force);
  }
  for (const PointMass& point_mass : system.model.masses) {  // nor for the offset itself
    detail::scatter(system.coordinates.node[to_size(point_mass.node)],
                    (w2 * point_mass.mass * centre_of_mass_interpolation(point_mass).transpose() *
                     P * point_mass.offset)
                        .eval(),
                    force);
  }
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
    body.element[i] += e.section.mass_per_length * w2 * (middle - frame.centre);
  }
  for (std::size_t i = 0; i < system.model.masses.size(); ++i) {
    const PointMass& point_mass = system.model.masses[i];
    const Vector2d position =
        system.model.nodes[to_size(point_mass.node)].position + point_mass.offset +
        centre_of_mass_interpolation(point_mass) *
            detail::gather(system.coordinates.node[to_size(point_mass.node)], u);
    body.point_mass[i] += point_mass.mass * w2 * (position - frame.centre);
  }
  return body;
}

}  // namespace trammel::solver
