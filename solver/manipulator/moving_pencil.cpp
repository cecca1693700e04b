#include "solver/manipulator/moving_pencil.h"

#include <algorithm>
#include <cmath>

#include "solver/linalg/dense_eigen.h"

namespace trammel::solver {

bool DenseLdlt::compute(const Eigen::MatrixXd& A) {
  const Index n = A.rows();
  L_.resize(n, n);
  pivots_.resize(n);
  scale_.resize(n);
  for (Index i = 0; i < n; ++i) {
    const double size = std::abs(A(i, i));
    scale_[i] = size > 0 ? 1 / std::sqrt(size) : 1;
  }
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) L_(i, j) = scale_[i] * scale_[j] * A(i, j);
  }
  growth_ = 0;
  for (Index k = 0; k < n; ++k) {
    const double pivot = pivots_[k] = L_(k, k);
    if (pivot == 0 || !std::isfinite(pivot)) return false;
    for (Index j = k + 1; j < n; ++j) {
      if (L_(j, k) == 0) continue;
      const double factor = L_(j, k) / pivot;
      const double* const from = &L_(0, k);
      double* const to = &L_(0, j);
      for (Index i = j; i < n; ++i) to[i] -= factor * from[i];
    }
    for (Index i = k + 1; i < n; ++i) {
      L_(i, k) /= pivot;
      growth_ = std::max(growth_, std::abs(L_(i, k)));
    }
  }
  return true;
}

MovingPencil::MovingPencil(const Model& model, const ManipulatorGeometry& geometry,
                           const Pose& pose)
    : system_(model, {.condensed = true}),
      start_posture_(inverse_kinematics(geometry, pose)),
      start_phi_(pose.phi) {
  next_.part.resize(system_.motion().part.size());
  const System& start = system_.start();
  const Index n = start.K.rows();
  free_coordinates_ = n;
  for (std::size_t l = 0; l < system_.links().size(); ++l) {
    const LinkSuperelement& condensed = system_.links()[l];
    Link& link = links_.emplace_back();
    link.first = mu_.size();
    link.last = link.first + condensed.mu.size();
    for (const Index u : system_.elements()[l].coordinates) {
      for (RowMajorMatrix::InnerIterator entry(system_.constraints().T, u); entry; ++entry)
        link.ends.push_back(entry.col());
    }
    std::ranges::sort(link.ends);
    link.ends.erase(std::unique(link.ends.begin(), link.ends.end()), link.ends.end());
    mu_.conservativeResize(link.last);
    mu_.tail(condensed.mu.size()) = condensed.mu;
    free_coordinates_ += condensed.inside;
    coupling_ = std::max(coupling_, condensed.coupling);
  }
  double size = 0;
  for (const Vector2d& position : start.mesh.positions)
    size = std::max(size, (position - start.mesh.positions.front()).norm());
  length_.setOnes(n);
  for (Index u = 0; u < start.coordinates.size; ++u) {
    const Index q = start.constraints.free[to_size(u)];
    if (q >= 0 && start.coordinates.is_rotation[to_size(u)]) length_[q] = size;
  }
  P_.setZero(n, interior_mode_count());
  static_cast<void>(move_to(start_posture_, pose));
}

Outcome MovingPencil::move_to(const Posture& posture, const Pose& pose) {
  for (std::size_t i = 0; i < 3; ++i) {
    next_.part[2 * i].angle = posture.active[i] - start_posture_.active[i];
    next_.part[2 * i + 1].angle = posture.passive[i] - start_posture_.passive[i];
  }
  for (std::size_t part = 6; part < next_.part.size(); ++part)
    next_.part[part].angle = pose.phi - start_phi_;
  Outcome outcome = system_.move_to(next_);
  if (!outcome.solved()) return outcome;
  K_ = system_.K();
  M_ = system_.M();
  const RowMajorMatrix& T = system_.constraints().T;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const MovingElement& element = system_.elements()[l];
    const Vector2d direction = element.axis_direction(next_);
    const auto& P = system_.links()[l].P;
    for (Index j = 0; j < P.rows(); ++j) {
      Eigen::Matrix<double, 1, 6> row = P.row(j);
      element.to_world(row, direction);
      double* const column = &P_(0, links_[l].first + j);
      for (const Index q : links_[l].ends) column[q] = 0;
      for (Index i = 0; i < 6; ++i) {
        const Index u = element.coordinates[to_size(i)];
        for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a)
          column[T.innerIndexPtr()[a]] += T.valuePtr()[a] * row[i];
      }
    }
  }
  return {};
}

Index MovingPencil::eigenvalues_below(double shift) {
  shifted_.noalias() = K_ - shift * M_;
  Index below = 0;
  for (const Link& link : links_) {
    for (Index j = link.first; j < link.last; ++j) {
      const double* const P = &P_(0, j);
      const double pivot = 1 - shift * mu_[j];
      if (pivot == 0) return -1;
      if (pivot < 0) ++below;
      for (auto q = link.ends.begin(); q != link.ends.end(); ++q) {
        const double factor = shift * shift / pivot * P[*q];
        for (auto p = q; p != link.ends.end(); ++p) shifted_(*p, *q) -= factor * P[*p];
      }
    }
  }
  const bool reliable = count_.compute(shifted_) && count_.element_growth() < 1e8;
  return reliable ? below + count_.negative_pivots() : -1;
}

template <int rows>
void MovingPencil::mass_times(const VectorBlock<rows>& X, VectorBlock<rows>& Y) const {
  using Vector = Eigen::Matrix<double, rows, 1>;
  const Index n = joint_coordinate_count();
  Y.ends.setZero(rows, n);
  for (Index j = 0; j < n; ++j) {
    const Vector x = X.ends.col(j);
    Vector y = Y.ends.col(j) + M_(j, j) * x;
    for (Index i = j + 1; i < n; ++i) {
      const double m = M_(i, j);
      if (m == 0) continue;
      Y.ends.col(i) += m * x;
      y += m * X.ends.col(i);
    }
    Y.ends.col(j) = y;
  }
  Y.inside.resize(rows, interior_mode_count());
  if (interior_mode_count() == 0) return;
  for (const Link& link : links_) {
    for (Index j = link.first; j < link.last; ++j) {
      Vector y = mu_[j] * X.inside.col(j);
      for (const Index q : link.ends) y += P_(q, j) * X.ends.col(q);
      Y.inside.col(j) = y;
    }
    for (const Index q : link.ends) {
      Vector y = Y.ends.col(q);
      for (Index j = link.first; j < link.last; ++j) y += P_(q, j) * X.inside.col(j);
      Y.ends.col(q) = y;
    }
  }
}

template <int rows>
void MovingPencil::measure_strain(const VectorBlock<rows>& X,
                                  const Eigen::Matrix<double, rows, Eigen::Dynamic>& U,
                                  ModeMeasures<rows>& measures) const {
  measures.strain = X.inside.array().square().rowwise().sum();
  measures.rounding = measures.strain;
  for (const MovingElement& element : system_.elements()) {
    if (element.c.isZero(0)) continue;
    Eigen::Matrix<double, rows, 6> v = Eigen::Matrix<double, rows, 6>::Zero();
    for (Index i = 0; i < 6; ++i) {
      const Index u = element.coordinates[to_size(i)];
      if (u >= 0) v.col(i) = U.col(u);
    }
    element.to_element_axes(v, element.axis_direction(system_.motion()));
    for (Index k = 0; k < 3; ++k) {
      if (element.c[k] == 0) continue;
      Eigen::Array<double, rows, 1> d = Eigen::Array<double, rows, 1>::Zero(), magnitude = d;
      for (Index i = 0; i < 6; ++i) {
        if (element.B(k, i) == 0) continue;
        d += element.B(k, i) * v.col(i).array();
        magnitude += std::abs(element.B(k, i)) * v.col(i).array().abs();
      }
      measures.strain += element.c[k] * d.square();
      measures.rounding += element.c[k] * d.abs() * magnitude;
    }
  }
  measures.rounding *= 2 * kEps;
}

/// Computes the backward error of each mode as the largest ratio of a residual to the magnitudes of
/// its terms. Joint coordinates that may be only round-off errors have a larger minimum magnitude
/// (dense_eigen.h). The residuals of interior modes are divided by the square root of the strain
/// energy.
template <int rows>
void MovingPencil::measure_residual(const VectorBlock<rows>& X, const VectorBlock<rows>& MX,
                                    Workspace<rows>& space, ModeMeasures<rows>& measures) const {
  using Numbers = Eigen::Array<double, rows, 1>;
  const Numbers w2 = measures.strain / measures.inertia;
  space.sizes = X.ends.cwiseAbs();
  Numbers largest = Numbers::Zero();
  for (Index i = 0; i < joint_coordinate_count(); ++i)
    largest = largest.max(length_[i] * space.sizes.col(i).array());
  for (Index i = 0; i < joint_coordinate_count(); ++i)
    space.sizes.col(i) = space.sizes.col(i).array().max(kLeastFraction / length_[i] * largest);
  measures.backward_error.setZero();
  for (Index i = 0; i < joint_coordinate_count(); ++i) {
    Numbers sum = -w2 * MX.ends.col(i).array(), terms = sum.abs();
    for (Index j = 0; j < joint_coordinate_count(); ++j) {
      const double k = K_(j, i);
      if (k == 0) continue;
      sum += k * X.ends.col(j).array();
      terms += std::abs(k) * space.sizes.col(j).array();
    }
    measures.backward_error = measures.backward_error.max(sum.abs() / terms);
  }
  // Scale of the residuals of interior modes, which have stiffness 1.
  const Numbers size = measures.strain.sqrt();
  for (Index j = 0; j < interior_mode_count(); ++j) {
    const Numbers force = w2 * MX.inside.col(j).array();
    measures.backward_error =
        measures.backward_error.max((X.inside.col(j).array() - force).abs() / size);
  }
}

template <int rows>
ModeMeasures<rows> MovingPencil::measure_modes(const VectorBlock<rows>& X,
                                               const VectorBlock<rows>& MX,
                                               Workspace<rows>& space) const {
  ModeMeasures<rows> measures;
  measures.inertia = X.ends.cwiseProduct(MX.ends).rowwise().sum() +
                     X.inside.cwiseProduct(MX.inside).rowwise().sum();
  const RowMajorMatrix& T = system_.constraints().T;
  space.U.setZero(rows, T.rows());
  for (Index u = 0; u < T.rows(); ++u) {
    for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a)
      space.U.col(u) += T.valuePtr()[a] * X.ends.col(T.innerIndexPtr()[a]);
  }
  measure_strain(X, space.U, measures);
  measure_residual(X, MX, space, measures);
  return measures;
}

template void MovingPencil::mass_times(const VectorBlock<6>&, VectorBlock<6>&) const;
template void MovingPencil::mass_times(const VectorBlock<16>&, VectorBlock<16>&) const;
template ModeMeasures<6> MovingPencil::measure_modes(const VectorBlock<6>&, const VectorBlock<6>&,
                                                     Workspace<6>&) const;
template ModeMeasures<16> MovingPencil::measure_modes(const VectorBlock<16>&,
                                                      const VectorBlock<16>&, Workspace<16>&) const;

}  // namespace trammel::solver
