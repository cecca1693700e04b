#include "solver/linear/row_balance.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "solver/linalg/dense_eigen.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/system.h"

namespace trammel::solver {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Adds the product k u of an element to the rows `sum` of its coordinates, for each column of u.
template <class Coordinates, class Stiffness, class Matrix>
void add_product(const Coordinates& coordinates, const Stiffness& k, const Matrix& u, Matrix& sum) {
  for (Index state = 0; state < u.cols(); ++state)
    detail::scatter(coordinates, (k * detail::gather(coordinates, u.col(state))).eval(),
                    sum.col(state));
}

}  // namespace

template <class Scalar>
RowBalance<Scalar>::RowBalance(const System& system, Index states)
    : system_(system),
      length_(length_scales(system)),
      sum_(Matrix::Zero(system.T.rows(), states)),
      free_sum_(Matrix::Zero(system.T.cols(), states)),
      terms_(MatrixXd::Zero(system.T.rows(), states)),
      free_terms_(MatrixXd::Zero(system.T.cols(), states)) {}

template <class Scalar>
MatrixXd RowBalance<Scalar>::bounded_magnitudes(const Matrix& u) const {
  MatrixXd size = u.cwiseAbs();
  for (auto column : size.colwise()) {
    const double largest = column.size() > 0 ? column.cwiseProduct(length_).maxCoeff() : 0;
    column = column.cwiseMax(kLeastFraction * largest * length_.cwiseInverse());
  }
  return size;
}

template <class Scalar>
void RowBalance<Scalar>::add_elastic_forces(const Matrix& u) {
  const MatrixXd size = bounded_magnitudes(u);
  for_each_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
    const auto k = (B.transpose() * c.asDiagonal() * B).eval();
    add_product(coordinates, k, u, sum_);
    add_product(coordinates, k.cwiseAbs().eval(), size, terms_);
  });
}

template <class Scalar>
void RowBalance<Scalar>::add_inertia_forces(const Matrix& acceleration) {
  const MatrixXd size = bounded_magnitudes(acceleration);
  for_each_mass_matrix(system_, [&](const auto& coordinates, const auto& m) {
    add_product(coordinates, m, acceleration, sum_);
    add_product(coordinates, m.cwiseAbs().eval(), size, terms_);
  });
}

template <class Scalar>
void RowBalance<Scalar>::add_load(const Matrix& load) {
  sum_ += load;
  terms_ += load.cwiseAbs();
}

template <class Scalar>
void RowBalance<Scalar>::add(const SparseMatrix& A, const Matrix& q) {
  free_sum_ += A * q;
  free_terms_ += A.cwiseAbs() * q.cwiseAbs();
}

template <class Scalar>
typename RowBalance<Scalar>::Matrix RowBalance<Scalar>::row_residuals() const {
  return system_.T.transpose() * sum_ + free_sum_;
}

template <class Scalar>
MatrixXd RowBalance<Scalar>::row_term_magnitudes() const {
  return system_.T.cwiseAbs().transpose() * terms_ + free_terms_;
}

template <class Scalar>
double RowBalance<Scalar>::backward_error() const {
  const MatrixXd residual = row_residuals().cwiseAbs(), terms = row_term_magnitudes();
  double largest = 0;
  for (Index state = 0; state < residual.cols(); ++state)
    largest = nan_max(largest, row_backward_error(residual.col(state), terms.col(state)));
  return largest;
}

template <class Scalar>
double RowBalance<Scalar>::residual_over_load() const {
  const VectorXd scale = system_.K.diagonal().cwiseAbs().unaryExpr(
      [](double k) { return k > 0 ? 1 / std::sqrt(k) : 0; });
  const VectorXd load = system_.T.cwiseAbs().transpose() * system_.load.cwiseAbs();
  // Increase each residual to at least its round-off error, because round-off errors cancel at some
  // orientations of the model. The returned ratio would otherwise depend on the orientation.
  const VectorXd residual =
      row_residuals().col(0).cwiseAbs().cwiseMax(kEps * row_term_magnitudes().col(0));
  const double size = scale.cwiseProduct(residual).norm();
  return size == 0 ? 0 : size / scale.cwiseProduct(load).norm();
}

template class RowBalance<double>;
template class RowBalance<std::complex<double>>;

double damping_ratio(const RayleighDamping& damping, double omega) {
  return (damping.mass / omega + damping.stiffness * omega) / 2;
}

Eigen::VectorXd decay_rates(const RayleighDamping& damping, const Eigen::VectorXd& omega) {
  return 0.5 * (damping.mass + damping.stiffness * omega.array().square());
}

double overdamping_frequency(const RayleighDamping& damping) {
  if (damping.stiffness == 0) return std::numeric_limits<double>::infinity();
  const double product = std::min(1.0, damping.mass * damping.stiffness);
  return (1 + std::sqrt(1 - product)) / damping.stiffness;
}

SparseMatrix damping_matrix(const RayleighDamping& damping, const SparseMatrix& M,
                            const SparseMatrix& K) {
  return damping.mass * M + damping.stiffness * K;
}

SparseMatrix modal_damping_matrix(const SparseMatrix& M, const Eigen::VectorXd& omega,
                                  const Eigen::MatrixXd& shape, const Eigen::VectorXd& ratio) {
  if (shape.rows() != M.rows() || shape.cols() != omega.size() || ratio.size() != omega.size())
    throw ModelError("modal damping requires one damping ratio for each mode");
  const Eigen::MatrixXd inertia = M * shape;
  const Eigen::VectorXd factor = 2 * ratio.cwiseProduct(omega);
  const Eigen::MatrixXd C = inertia * factor.asDiagonal() * inertia.transpose();
  SparseMatrix sparse = C.sparseView();
  sparse.makeCompressed();
  return sparse;
}

Eigen::VectorXd damping_acceleration(const ViscousDamping& damping, const SparseMatrix& M,
                                     const Eigen::VectorXd& v) {
  Eigen::VectorXd a = damping.rayleigh.mass * v;
  if (damping.omega.size() == 0) return a;
  const Eigen::VectorXd amplitude = damping.shape.transpose() * (M * v);
  return a +
         damping.shape * (2 * damping.ratio.cwiseProduct(damping.omega)).cwiseProduct(amplitude);
}

}  // namespace trammel::solver
