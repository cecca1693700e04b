#pragma once

#include <Eigen/Core>

#include "solver/linalg/factorization.h"
#include "solver/model/counters.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// How many eigenvalues of A x = t B x, A positive semidefinite, are missing or too many among
/// those found: their number below a shift less the negative pivots of A - shift B (Sylvester).
/// None where the two agree at the shift given, above all found; otherwise as the last clear gap
/// among them has it. Infinite where no shift leaves the factorization its digits.
/// @param found  ascending, >= 0; 0 of free motions
/// @param spent  a factorization that is needed no more, for its ordering, and for its factors
/// where
///               they are of A - shift_above B
[[nodiscard]] double miscounted_eigenvalues(const SparseMatrix& A, const SparseMatrix& B,
                                            const Eigen::VectorXd& found,
                                            Factorization&& spent = {}, double shift_above = 0);

/// How many of the eigenvectors depend on the others, by their products in a metric in which they
/// are orthogonal: a mode that was found twice counts once.
[[nodiscard]] Index dependent_vectors(const SparseMatrix& metric, const Eigen::MatrixXd& X);

}  // namespace trammel::solver
