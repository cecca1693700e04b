#include "solver/time/equation_of_motion.h"

#include <algorithm>
#include <cmath>

#include "solver/linalg/eigenpairs.h"
#include "solver/model/model.h"

namespace trammel::solver {

namespace {

/// Largest column sum of magnitudes.
double matrix_norm(const SparseMatrix& A) {
  double norm = 0;
  for (Index column = 0; column < A.outerSize(); ++column) {
    double sum = 0;
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) sum += std::abs(it.value());
    norm = std::max(norm, sum);
  }
  return norm;
}

void check(const EquationOfMotion& e) {
  const Index n = e.M.rows();
  const auto fits = [n](const SparseMatrix& A) { return A.rows() == n && A.cols() == n; };
  if (!fits(e.M) || !fits(e.K) || !(e.C.size() == 0 || fits(e.C))) {
    throw ModelError("M, C and K of an equation of motion are square and of one size");
  }
  if (e.update && !(same_pattern(e.M, e.K) && (e.C.size() == 0 || same_pattern(e.M, e.C)))) {
    throw ModelError("matrices that change with time share one pattern");
  }
}

}  // namespace

EquationMatrices::EquationMatrices(const EquationOfMotion& equation)
    : equation_(equation), M_(equation.M), C_(equation.C), K_(equation.K) {
  check(equation);
  const Index n = M_.rows();
  if (C_.size() == 0) C_.resize(n, n);
  if (!equation.update) {
    SparseMatrix pattern = M_ + C_ + K_;
    pattern += SparseMatrix(pattern.transpose());
    std::fill(pattern.valuePtr(), pattern.valuePtr() + pattern.nonZeros(), 0.0);
    for (SparseMatrix* A : {&M_, &C_, &K_}) {
      *A = SparseMatrix(*A + pattern);
      A->makeCompressed();
    }
  }
  if (equation.update && equation.C.size() == 0) {
    C_ = M_;
    C_.coeffs().setZero();
  }
}

void EquationMatrices::update(double time) {
  if (equation_.update) {
    equation_.update(time, M_, C_, K_);
  } else if (norm_M_ > 0) {
    return;
  }
  norm_M_ = matrix_norm(M_);
  norm_C_ = matrix_norm(C_);
  norm_K_ = matrix_norm(K_);
}

void EquationMatrices::load(double time, Eigen::VectorXd& f) const {
  if (equation_.load) {
    equation_.load(time, f);
  } else {
    f.setZero();
  }
}

}  // namespace trammel::solver
