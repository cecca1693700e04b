#include "solver/sensitivity/set_derivative.h"

#include "solver/assembly/inertia.h"
#include "solver/assembly/strain.h"

namespace trammel::solver {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Rows of the coordinates, zero where there is none.
template <std::size_t n>
Eigen::Matrix<double, static_cast<int>(n), Eigen::Dynamic> gather_modes(
    const std::array<Index, n>& coordinates, const MatrixXd& U) {
  Eigen::Matrix<double, static_cast<int>(n), Eigen::Dynamic> local(n, U.cols());
  for (Index j = 0; j < U.cols(); ++j) local.col(j) = detail::gather(coordinates, U.col(j));
  return local;
}

}  // namespace

SetDerivative::SetDerivative(const System& system, const MatrixXd& U, double omega_squared)
    : system_(system), U_(U), omega_squared_(omega_squared) {
  for (const Member& member : system.model.members) {
    if (!member.axially_flexible) inextensible_ = true;
  }
  if (!inextensible_) return;
  multipliers_.resize(static_cast<Index>(system.constraints.rows.size()), U.cols());
  for (Index j = 0; j < U.cols(); ++j) {
    const VectorXd u = U.col(j);
    multipliers_.col(j) = system.constraints.multipliers(internal_forces(system, u) -
                                                         omega_squared * inertia_forces(system, u));
  }
}

MatrixXd SetDerivative::of(const SeededDesign& design) const {
  MatrixXd sum = MatrixXd::Zero(U_.cols(), U_.cols());
  for (const FrameElement& e : system_.mesh.frame) add_element(e, design.link(e.member), sum);
  if (inextensible_) add_constraints(design, sum);
  add_platform(design, sum);
  return (sum + sum.transpose()) / 2;
}

void SetDerivative::add_element(const FrameElement& e, const SeededLink& link,
                                MatrixXd& sum) const {
  const Member& member = system_.model.members[static_cast<std::size_t>(e.member)];
  const Eigen::Matrix<double, 6, Eigen::Dynamic> local = gather_modes(e.coordinates, U_);
  const Dual length = link.length / static_cast<double>(member.elements);
  Eigen::Vector3<Dual> c = frame_rigidity(link.section, member.theory, length);
  if (!member.axially_flexible) c[0] = 0;
  const Matrix36<Dual> B = frame_deformation_matrix(link.direction, length);
  const Matrix6<Dual> R = frame_rotation(link.direction);
  const Matrix6<Dual> m = frame_mass(link.section, member.theory, member.mass, length);
  const Index k = U_.cols();
  Eigen::Matrix<Dual, 3, Eigen::Dynamic> d(3, k);
  Eigen::Matrix<Dual, 6, Eigen::Dynamic> v(6, k);
  for (Index j = 0; j < k; ++j) {
    const Eigen::Matrix<Dual, 6, 1> u = local.col(j).cast<Dual>();
    d.col(j) = B * u;
    v.col(j) = R * u;
  }
  for (Index j = 0; j < k; ++j) {
    const Eigen::Vector3<Dual> s = c.cwiseProduct(d.col(j));
    const Eigen::Matrix<Dual, 6, 1> f = m * v.col(j);
    for (Index i = 0; i < k; ++i) {
      Dual strain(0);
      Dual inertia(0);
      for (Index n = 0; n < 3; ++n) strain += d(n, i) * s[n];
      for (Index n = 0; n < 6; ++n) inertia += v(n, i) * f[n];
      sum(i, j) += derivative(strain) - omega_squared_ * derivative(inertia);
    }
  }
}

/// With C u = 0 and C depending on p, the eliminated coordinates move: - mu^T dC/dp u, twice.
void SetDerivative::add_constraints(const SeededDesign& design, MatrixXd& sum) const {
  for (std::size_t r = 0; r < system_.constraints.rows.size(); ++r) {
    const ConstraintRow& row = system_.constraints.rows[r];
    if (row.source != ConstraintRow::Source::inextensible) continue;
    const FrameElement& e = system_.mesh.frame[static_cast<std::size_t>(row.index)];
    const SeededLink& link = design.link(e.member);
    const Vector2d turn(derivative(link.direction.x()), derivative(link.direction.y()));
    const Eigen::Matrix<double, 6, Eigen::Dynamic> u = gather_modes(e.coordinates, U_);
    const Eigen::RowVectorXd gap = turn.transpose() * (u.middleRows<2>(3) - u.topRows<2>());
    const Eigen::RowVectorXd mu = multipliers_.row(static_cast<Index>(r));
    sum -= mu.transpose() * gap + gap.transpose() * mu;
  }
}

void SetDerivative::add_platform(const SeededDesign& design, MatrixXd& sum) const {
  const double stiffness = design.log_stiffness_derivative();
  const double mass = design.log_mass_derivative();
  if (stiffness == 0 && mass == 0) return;
  for (const PointMass& lump : system_.model.masses) {
    const Eigen::Matrix3<Dual> m =
        point_inertia(design.platform_mass().mass, design.platform_mass().inertia, lump.offset);
    Eigen::Matrix3d dm;
    for (Index i = 0; i < 9; ++i) dm(i) = derivative(m(i));
    const auto u = gather_modes(system_.coordinates.node[static_cast<std::size_t>(lump.node)], U_);
    sum -= omega_squared_ * (u.transpose() * dm * u);
  }
  // From the strains, which stay small beside the rigid motion of a stiff plate.
  for_each_plate_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
    const Eigen::MatrixXd strain = B * gather_modes(coordinates, U_);
    sum += stiffness * (strain.transpose() * c.asDiagonal() * strain);
  });
  for_each_plate_mass(system_, [&](const auto& coordinates, const auto& m) {
    const auto u = gather_modes(coordinates, U_);
    sum -= mass * omega_squared_ * (u.transpose() * m * u);
  });
}

}  // namespace trammel::solver
