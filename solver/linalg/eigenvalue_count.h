#pragma once

#include <Eigen/Core>

#include "solver/linalg/factorization.h"
#include "solver/model/counters.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// How many eigenvalues of A x = t B x, A positive semidefinite, are missing or too many among
/// those found: their number below a shift in the last clear gap less the negative pivots of A -
/// shift B (Sylvester). Infinite where no shift leaves the factorization its digits.
/// @param found  ascending, >= 0; 0 of free motions
/// @param spent  a factorization that is needed no more, for its ordering
[[nodiscard]] double miscounted_eigenvalues(const SparseMatrix& A, const SparseMatrix& B,
                                            const Eigen::VectorXd& found,
                                            Factorization&& spent = {});

/// How many of the eigenvectors depend on the others, by their products in a metric in which they
/// are orthogonal: a mode that was found twice counts once.
[[nodiscard]] Index dependent_vectors(const SparseMatrix& metric, const Eigen::MatrixXd& X);

}  // namespace trammel::solver
