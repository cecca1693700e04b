#include "solver/assembly/equation_rows.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/inertia.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/backward_error.h"

namespace trammel::solver {

using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

EquationRows::EquationRows(const System& system)
    : system_(system),
      sum_(VectorXcd::Zero(system.T.rows())),
      free_sum_(VectorXcd::Zero(system.T.cols())),
      terms_(VectorXd::Zero(system.T.rows())),
      free_terms_(VectorXd::Zero(system.T.cols())) {
  for (const Vector2d& position : system.mesh.positions)
    model_size_ = std::max(model_size_, (position - system.mesh.positions.front()).norm());
  if (!(model_size_ > 0)) model_size_ = 1;
}

template <class Coordinates, class Matrix>
void EquationRows::add_element(const Coordinates& coordinates, const Matrix& k, const VectorXcd& u,
                               const VectorXd& size, Complex factor) {
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (coordinates[i] < 0) continue;
    for (std::size_t j = 0; j < coordinates.size(); ++j) {
      if (coordinates[j] < 0) continue;
      const Complex coefficient = factor * k(static_cast<Index>(i), static_cast<Index>(j));
      sum_[coordinates[i]] += coefficient * u[coordinates[j]];
      terms_[coordinates[i]] += std::abs(coefficient) * size[coordinates[j]];
    }
  }
}

VectorXd EquationRows::sizes_of(const VectorXcd& u) const {
  VectorXd size = u.cwiseAbs();
  double largest = 0;
  for (Index i = 0; i < size.size(); ++i) {
    const bool rotation = system_.coordinates.is_rotation[static_cast<std::size_t>(i)];
    largest = std::max(largest, rotation ? size[i] * model_size_ : size[i]);
  }
  for (Index i = 0; i < size.size(); ++i) {
    const bool rotation = system_.coordinates.is_rotation[static_cast<std::size_t>(i)];
    size[i] = std::max(size[i], kLeastShare * largest / (rotation ? model_size_ : 1));
  }
  return size;
}

void EquationRows::add_stiffness(const VectorXcd& u, Complex factor) {
  const VectorXd size = sizes_of(u);
  for_each_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
    add_element(coordinates, (B.transpose() * c.asDiagonal() * B).eval(), u, size, factor);
  });
}

void EquationRows::add_inertia(const VectorXcd& u, Complex factor) {
  const VectorXd size = sizes_of(u);
  for_each_inertia(system_, [&](const auto& coordinates, const auto& m) {
    add_element(coordinates, m, u, size, factor);
  });
}

void EquationRows::add_load(const VectorXcd& load, Complex factor) {
  sum_ += factor * load;
  terms_ += std::abs(factor) * load.cwiseAbs();
}

void EquationRows::add(const SparseMatrix& A, const VectorXcd& q, Complex factor) {
  free_sum_ += factor * (A * q);
  free_terms_ += std::abs(factor) * (A.cwiseAbs() * q.cwiseAbs());
}

double EquationRows::backward_error() const {
  const VectorXcd rows = system_.T.transpose() * sum_ + free_sum_;
  const VectorXd terms = system_.T.cwiseAbs().transpose() * terms_ + free_terms_;
  return largest_ratio(rows.cwiseAbs(), terms);
}

double EquationRows::residual_over(const VectorXd& load) const {
  const VectorXcd rows = system_.T.transpose() * sum_ + free_sum_;
  const VectorXd scale = system_.K.diagonal().cwiseAbs().unaryExpr(
      [](double k) { return k > 0 ? 1 / std::sqrt(k) : 0; });
  const double size = scale.cwiseProduct(load).norm();
  const double residual = scale.cwiseProduct(rows.cwiseAbs()).norm();
  return residual == 0 ? 0 : residual / size;
}

double mode_backward_error(const System& system, const SparseMatrix* K_G, const VectorXd& q,
                           double w2) {
  const VectorXd u = system.T * q;
  EquationRows rows(system);
  rows.add_stiffness(u);
  rows.add_inertia(u, -w2);
  if (K_G) rows.add(*K_G, q);
  return rows.backward_error();
}

}  // namespace trammel::solver
