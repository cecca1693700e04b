#include "solver/assembly/equation_rows.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/inertia.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/backward_error.h"
#include "solver/model/numbers.h"
#include "solver/model/plane.h"

namespace trammel::solver {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

namespace {

/// @param size  magnitudes of the coordinates; @returns them, none below a thousandth of the
///              largest motion
VectorXd sizes_of(const System& system, double model, VectorXd size) {
  const auto lever = [&](Index i) {
    return system.coordinates.is_rotation[static_cast<std::size_t>(i)] ? model : 1.0;
  };
  double largest = 0;
  for (Index i = 0; i < size.size(); ++i) largest = std::max(largest, size[i] * lever(i));
  for (Index i = 0; i < size.size(); ++i)
    size[i] = std::max(size[i], kLeastShare * largest / lever(i));
  return size;
}

}  // namespace

EquationRows::EquationRows(const System& system)
    : system_(system),
      model_size_(box_diagonal(system.mesh.positions)),
      sum_(VectorXcd::Zero(system.T.rows())),
      free_sum_(VectorXcd::Zero(system.T.cols())),
      terms_(VectorXd::Zero(system.T.rows())),
      free_terms_(VectorXd::Zero(system.T.cols())) {}

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

void EquationRows::add_stiffness(const VectorXcd& u, Complex factor) {
  const VectorXd size = sizes_of(system_, model_size_, u.cwiseAbs());
  for_each_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
    add_element(coordinates, (B.transpose() * c.asDiagonal() * B).eval(), u, size, factor);
  });
}

void EquationRows::add_inertia(const VectorXcd& u, Complex factor) {
  const VectorXd size = sizes_of(system_, model_size_, u.cwiseAbs());
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

void EquationRows::add_terms(const VectorXd& magnitudes) {
  terms_ += magnitudes;
}

double EquationRows::backward_error() const {
  const VectorXcd rows = system_.T.transpose() * sum_ + free_sum_;
  const VectorXd terms = system_.T.cwiseAbs().transpose() * terms_ + free_terms_;
  return largest_ratio(rows.cwiseAbs(), terms);
}

double EquationRows::residual_over_load() const {
  const VectorXcd rows = system_.T.transpose() * sum_ + free_sum_;
  const VectorXd scale = system_.K.diagonal().cwiseAbs().unaryExpr(
      [](double k) { return k > 0 ? 1 / std::sqrt(k) : 0; });
  const VectorXd load = system_.T.cwiseAbs().transpose() * system_.load.cwiseAbs();
  const double size = scale.cwiseProduct(load).norm();
  // Round-off errors cancel at some angles of the model and not at others.
  const VectorXd roundoff = kEps * (system_.T.cwiseAbs().transpose() * terms_ + free_terms_);
  const double residual = scale.cwiseProduct(rows.cwiseAbs().cwiseMax(roundoff)).norm();
  return residual == 0 ? 0 : residual / size;
}

double mode_backward_error(const System& system, const SparseMatrix* K_G, const MatrixXd& shapes,
                           const VectorXd& w2) {
  const MatrixXd u = system.T * shapes;
  const double model = box_diagonal(system.mesh.positions);
  MatrixXd size = u.cwiseAbs();
  for (auto column : size.colwise()) column = sizes_of(system, model, column);
  MatrixXd sum = MatrixXd::Zero(u.rows(), u.cols()), terms = sum;
  const auto add_product = [](const auto& coordinates, const auto& k, const MatrixXd& motion,
                              MatrixXd& to) {
    for (Index mode = 0; mode < motion.cols(); ++mode) {
      const auto local = (k * detail::gather(coordinates, motion.col(mode))).eval();
      for (std::size_t i = 0; i < coordinates.size(); ++i)
        if (coordinates[i] >= 0) to(coordinates[i], mode) += local[static_cast<Index>(i)];
    }
  };
  const auto add = [&](const auto& coordinates, const auto& k, const MatrixXd& motion,
                       const MatrixXd& motion_size) {
    add_product(coordinates, k, motion, sum);
    add_product(coordinates, k.cwiseAbs().eval(), motion_size, terms);
  };
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    add(coordinates, (B.transpose() * c.asDiagonal() * B).eval(), u, size);
  });
  const MatrixXd acceleration = u * (-w2).asDiagonal();
  const MatrixXd acceleration_size = size * w2.cwiseAbs().asDiagonal();
  for_each_inertia(system, [&](const auto& coordinates, const auto& m) {
    add(coordinates, m, acceleration, acceleration_size);
  });
  MatrixXd rows = system.T.transpose() * sum;
  MatrixXd magnitudes = system.T.cwiseAbs().transpose() * terms;
  if (K_G) {
    rows += *K_G * shapes;
    magnitudes += K_G->cwiseAbs() * shapes.cwiseAbs();
  }
  double largest = 0;
  for (Index mode = 0; mode < rows.cols(); ++mode)
    largest = nan_max(largest, largest_ratio(rows.col(mode).cwiseAbs(), magnitudes.col(mode)));
  return largest;
}

}  // namespace trammel::solver
