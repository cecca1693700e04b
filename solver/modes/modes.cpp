#include "solver/modes/modes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "solver/assembly/equation_rows.h"
#include "solver/assembly/length_scales.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/eigenvalue_count.h"
#include "solver/linalg/lanczos.h"
#include "solver/statics/describe_mechanism.h"
#include "solver/statics/zero_energy_modes.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// M-orthonormal basis of the free motions; false where one of them moves no mass.
bool orthonormalise(const System& system, MatrixXd& Z) {
  if (Z.cols() == 0) return true;
  const SparseMatrix& M = system.M;
  // Masses of rotations are counted as inertia over the square of the model's size.
  const VectorXd squared_length = squared_lengths(system);
  VectorXd mass = M.diagonal().cwiseQuotient(squared_length);
  const double largest = mass.maxCoeff();
  if (!(largest > 0)) return false;
  mass = mass.unaryExpr([largest](double m) { return m > 0 ? m : largest; });
  const VectorXd weight = mass.cwiseProduct(squared_length);
  const MatrixXd gram = Z.transpose() * (M * Z);
  const MatrixXd size = Z.transpose() * weight.asDiagonal() * Z;
  const SymmetricEigenpairs<MatrixXd> pairs = symmetric_eigenpairs(gram, size);
  if (!(pairs.value[0] > 1e-18)) return false;  // rounding of a motion squared: 1e-32
  const VectorXd inverse = pairs.value.cwiseSqrt().cwiseInverse();
  Z = Z * pairs.vector * inverse.asDiagonal();
  return true;
}

/// Whether a motion beyond the free ones moves mass: otherwise there is nothing that swings.
bool has_elastic_inertia(const SparseMatrix& M, const MatrixXd& Z) {
  VectorXd x = start_vectors(M.rows(), 1);
  const double total = x.dot(M * x);
  for (int pass = 0; pass < 2; ++pass) x -= Z * (Z.transpose() * (M * x));
  return x.dot(M * x) > 1e-24 * total;  // rounding of a motion squared: 1e-32
}

/// A shift s < 0 of the size of the lowest elastic eigenvalue, for models that float: K - s M is
/// then as well-conditioned as the elastic part of K.
double floating_shift(const System& system, const MatrixXd& Z, Counters& counters) {
  SparseMatrix shifted = system.K;
  const VectorXd diagonal = system.K.diagonal(), squared_length = squared_lengths(system);
  const double largest =
      diagonal.size() > 0 ? diagonal.cwiseQuotient(squared_length).maxCoeff() : 0;
  if (!(largest > 0)) return -1;
  for (Index i = 0; i < diagonal.size(); ++i) {
    shifted.coeffRef(i, i) += 1e-11 * (diagonal[i] > 0 ? diagonal[i] : largest * squared_length[i]);
  }
  Factorization factorization;
  factorization.compute(shifted);
  ++counters.factorizations;
  VectorXd x = start_vectors(system.K.rows(), 1);
  double quotient = 0;
  for (int step = 0; step < 8; ++step) {
    x -= Z * (Z.transpose() * (system.M * x));
    const VectorXd y = factorization.solve(system.M * x);
    ++counters.solves;
    x = y - Z * (Z.transpose() * (system.M * y));
    const double mass = x.dot(system.M * x);
    if (!(mass > 0)) break;
    x /= std::sqrt(mass);
    quotient = strain_products(system, system.T * x)(0, 0);
  }
  return quotient > 0 && std::isfinite(quotient) ? -quotient : -1;
}

void fill(const System& system, const Eigenpairs& pairs, const MatrixXd& Z, Index count,
          ModalSolution& solution) {
  const Index rigid = std::min(Z.cols(), count);
  const Index elastic = std::min(pairs.value.size(), count - rigid);
  solution.frequency.setZero(rigid + elastic);
  solution.roundoff.setZero(rigid + elastic);
  solution.shape.resize(system.K.rows(), rigid + elastic);
  solution.shape.leftCols(rigid) = Z.leftCols(rigid);
  for (Index j = 0; j < elastic; ++j) {
    const double w2 = pairs.value[j];
    solution.frequency[rigid + j] = std::sqrt(w2) / (2 * std::numbers::pi);
    const double rounding = strain_roundoff(system, system.T * pairs.vector.col(j)) / w2;
    solution.roundoff[rigid + j] =
        0.5 * (rounding + pairs.error[j]) + 4 * std::numeric_limits<double>::epsilon();
    solution.shape.col(rigid + j) = pairs.vector.col(j);
  }
}

}  // namespace

ModalSolution solve_modes(const System& system, const ModesOptions& options) {
  ModalSolution solution;
  solution.counters = system.counters;
  Counters& counters = solution.counters;
  if (system.K.rows() == 0) {  // nothing can move
    judge_modes(system, nullptr, solution);
    return solution;
  }
  Factorization factorization;
  factorization.compute(shifted(system.K, system.M, 0));
  ++counters.factorizations;
  ZeroEnergyModes free = find_zero_energy_modes(system, factorization, counters);
  solution.zero_energy_mode_count = free.count();
  solution.zero_energy_mode_text = describe_mechanism(system, free);
  if (!orthonormalise(system, free.basis)) {
    solution.outcome = {Status::singular,
                        "a part without mass moves freely: " + solution.zero_energy_mode_text};
    return solution;
  }
  if (free.count() > 0 && !has_elastic_inertia(system.M, free.basis)) {
    solution.inertia_count = free.count();
    fill(system, {}, free.basis, options.count, solution);
    judge_modes(system, nullptr, solution);
    return solution;
  }
  Pencil pencil;
  pencil.K = &system.K;
  pencil.B = &system.M;
  if (free.count() > 0) {
    pencil.shift = floating_shift(system, free.basis, counters);
    factorization.compute(shifted(system.K, system.M, pencil.shift));
    ++counters.factorizations;
  }
  pencil.K_times = stiffness_operator(system);
  pencil.K_products = [&system](const MatrixXd& X) {
    return strain_products(system, system.T * X);
  };
  const Index elastic = std::max<Index>(0, options.count - free.count());
  const Eigenpairs pairs =
      lowest_eigenpairs(pencil, free.basis, elastic, options.method, factorization, counters);
  solution.outcome = pairs.outcome;
  solution.inertia_count = pairs.inertia_count;
  fill(system, pairs, free.basis, options.count, solution);
  judge_modes(system, nullptr, solution, std::move(factorization), pairs.check_shift);
  return solution;
}

void judge_modes(const System& system, const SparseMatrix* K_G, ModalSolution& solution,
                 Factorization&& spent, double shift_above) {
  if (!solution.outcome.solved()) return;
  const VectorXd w2 = (2 * std::numbers::pi * solution.frequency).cwiseAbs2();
  if (w2.size() > 0)
    solution.evidence.add(Residual::eigenvalue_equation,
                          mode_backward_error(system, K_G, solution.shape, w2));
  const SparseMatrix loaded = K_G ? SparseMatrix(system.K + *K_G) : SparseMatrix();
  const double missed =
      miscounted_eigenvalues(K_G ? loaded : system.K, system.M, w2, std::move(spent), shift_above);
  const auto twice = static_cast<double>(dependent_vectors(system.M, solution.shape));
  solution.evidence.add(Residual::mode_count, missed + twice);
  solution.outcome = outcome_by_evidence(solution.outcome, solution.evidence);
}

std::optional<Index> sturm_count(const System& system, double frequency) {
  const double w = 2 * std::numbers::pi * frequency;
  Factorization factorization;
  factorization.compute(system.K - w * w * system.M);
  if (!factorization.is_reliable()) return std::nullopt;
  return factorization.negative_pivots();
}

}  // namespace trammel::solver
