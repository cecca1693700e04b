#include "solver/manipulator/link_superelement.h"

#include <vector>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Chain of the equal elements of a member, with the coordinates (u v θ) at each of its n + 1
/// nodes.
struct ElementChain {
  Index elements;
  FrameDeformation B;
  Vector3d c;
  Matrix6d m;

  [[nodiscard]] MatrixXd mass_times(const MatrixXd& U) const {
    MatrixXd F = MatrixXd::Zero(U.rows(), U.cols());
    for (Index e = 0; e < elements; ++e) F.middleRows<6>(3 * e) += m * U.middleRows<6>(3 * e);
    return F;
  }
  /// Returns U^T K U for the motions in the columns of U, where K is the stiffness matrix of the
  /// chain. The product is computed from the deformations of the elements, which are accurate for
  /// long-wave modes.
  [[nodiscard]] MatrixXd projected_stiffness(const MatrixXd& U) const {
    MatrixXd D(3 * elements, U.cols());
    for (Index e = 0; e < elements; ++e)
      D.middleRows<3>(3 * e) = c.cwiseSqrt().asDiagonal() * B * U.middleRows<6>(3 * e);
    return D.transpose() * D;
  }
};

/// Returns motions of all nodes, one per column, with the given values at the given coordinates and
/// zero elsewhere.
MatrixXd node_motions(const std::vector<Index>& coordinates, const MatrixXd& values, Index size) {
  MatrixXd U = MatrixXd::Zero(size, values.cols());
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    U.row(coordinates[i]) = values.row(static_cast<Index>(i));
  return U;
}

/// Returns the modes X of the given coordinates as motions of all nodes, with all other coordinates
/// fixed. The modes satisfy X^T K X = I and are in descending order of the period. Bending and
/// axial modes are computed in separate calls, so that the couplings between bending and axial
/// modes are exactly zero.
MatrixXd modes_of_coordinates(const ElementChain& chain, const std::vector<Index>& coordinates) {
  const Index size = 3 * (chain.elements + 1);
  const auto count = static_cast<Index>(coordinates.size());
  const MatrixXd unit = node_motions(coordinates, MatrixXd::Identity(count, count), size);
  const MatrixXd K = chain.projected_stiffness(unit);
  const MatrixXd M = unit.transpose() * chain.mass_times(unit);
  const VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(
      scale.asDiagonal() * M * scale.asDiagonal(), scale.asDiagonal() * K * scale.asDiagonal());
  const double zero = 1e-13 * pairs.value.cwiseAbs().maxCoeff();
  const Index kept = (pairs.value.array() > zero).count();
  return node_motions(coordinates,
                      scale.asDiagonal() * pairs.vector.rightCols(kept).rowwise().reverse(), size);
}

double largest_off_diagonal(const MatrixXd& A) {
  const VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
  MatrixXd scaled = scale.asDiagonal() * A * scale.asDiagonal();
  scaled.diagonal().setZero();
  return scaled.size() > 0 ? scaled.cwiseAbs().maxCoeff() : 0;
}

}  // namespace

LinkSuperelement condense_member(const Member& member, double length) {
  const Index n = member.elements;
  const double part = length / static_cast<double>(n);
  const Section& section = member.section;
  LinkSuperelement link;
  ElementChain chain{n, frame_deformation_matrix(Vector2d(Vector2d::UnitX()), part),
                     frame_deformation_stiffness(section, member.theory, part),
                     frame_mass(section, member.theory, member.mass, part)};
  if (!member.axially_flexible) chain.c[0] = 0;
  // The static response of the interior of a prismatic member equals the interpolation of a single
  // element with the length of the member.
  MatrixXd follows(3 * (n + 1), 6);
  const double phi = shear_ratio(section, member.theory, length);
  for (Index k = 0; k <= n; ++k)
    follows.middleRows<3>(3 * k) =
        frame_interpolation(phi, length, static_cast<double>(k) / static_cast<double>(n));
  std::vector<Index> axial, bending;
  for (Index k = 1; k < n; ++k) {
    if (member.axially_flexible) axial.push_back(3 * k);
    bending.insert(bending.end(), {3 * k + 1, 3 * k + 2});
  }
  link.inside = std::ssize(axial) + std::ssize(bending);
  MatrixXd X(3 * (n + 1), 0);
  for (const auto& coordinates : {axial, bending}) {
    if (coordinates.empty()) continue;
    const MatrixXd modes = modes_of_coordinates(chain, coordinates);
    X.conservativeResize(Eigen::NoChange, X.cols() + modes.cols());
    X.rightCols(modes.cols()) = modes;
  }
  const MatrixXd energy = chain.projected_stiffness(X);
  X = X * energy.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
  const MatrixXd images = chain.mass_times(X), inertia = X.transpose() * images;
  link.coupling = std::max(largest_off_diagonal(energy), largest_off_diagonal(inertia));
  link.mu = inertia.diagonal();
  link.P = images.transpose() * follows;
  link.m = follows.transpose() * chain.mass_times(follows);
  return link;
}

}  // namespace trammel::solver
