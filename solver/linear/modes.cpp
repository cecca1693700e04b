#include "solver/linear/modes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/eigenpairs.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/free_motions.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/statics.h"
#include "solver/linear/system.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Returns true if motions other than the zero-energy modes Z move mass. If only the zero-energy
/// modes move mass, the model cannot vibrate.
bool has_elastic_inertia(const SparseMatrix& M, const MatrixXd& Z) {
  VectorXd x = start_vectors(M.rows(), 1);
  const double total = x.dot(M * x);
  for (int pass = 0; pass < 2; ++pass) x -= Z * (Z.transpose() * (M * x));
  // The limit is well above 1e-32, the square of the round-off error of a motion.
  return x.dot(M * x) > 1e-24 * total;
}

/// Returns a shift s < 0 of the magnitude of the lowest elastic eigenvalue, for models with rigid
/// modes. The matrix K - s M is then as well-conditioned as the elastic part of K.
double shift_with_rigid_modes(const System& system, const MatrixXd& Z, Counters& counters) {
  SparseMatrix shifted = system.K;
  const VectorXd diagonal = system.K.diagonal(), squared_length = summed_squared_lengths(system);
  const auto largest = diagonal.size() > 0 ? diagonal.cwiseQuotient(squared_length).maxCoeff() : 0;
  if (!(largest > 0)) return -1;
  for (Index i = 0; i < diagonal.size(); ++i)
    shifted.coeffRef(i, i) += 1e-11 * (diagonal[i] > 0 ? diagonal[i] : largest * squared_length[i]);
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
    quotient = projected_stiffness(system, system.T * x)(0, 0);
  }
  return quotient > 0 && std::isfinite(quotient) ? -quotient : -1;
}

/// Adds the residuals of modes to the evidence: the largest backward error of (K + K_G) x = w^2 M
/// x, and the number of missing or superfluous modes. The parameter `K` contains the sum K + K_G.
/// `K_G` has no entries without prestress.
void add_evidence(const System& system, const SparseMatrix& K, const SparseMatrix& K_G,
                  ModalSolution& solution, Factorization&& spent = {}, double shift_above = 0) {
  if (!solution.outcome.solved()) return;
  const VectorXd w2 = (2 * std::numbers::pi * solution.frequency).cwiseAbs2();
  if (w2.size() > 0) {
    const MatrixXd u = system.T * solution.shape;
    RowBalance<double> rows(system, u.cols());
    rows.add_elastic_forces(u);
    rows.add_inertia_forces(u * (-w2).asDiagonal());
    if (K_G.nonZeros() > 0) rows.add(K_G, solution.shape);
    solution.evidence.add(Residual::eigenvalue_equation, rows.backward_error());
  }
  const double missed = eigenvalue_count_error(K, system.M, w2, std::move(spent), shift_above);
  const auto twice = static_cast<double>(count_dependent_vectors(system.M, solution.shape));
  solution.evidence.add(Residual::mode_count, missed + twice);
  solution.outcome = outcome_by_evidence(solution.outcome, solution.evidence);
}

/// Computes the modes of (K + K_G) x = w^2 M x. K_G follows from the internal forces of `state` and
/// is omitted if `state` is null.
ModalSolution solve(const System& system, const ModesOptions& options,
                    const StaticSolution* state) {
  ModalSolution solution;
  solution.counters = system.counters;
  Counters& counters = solution.counters;
  SparseMatrix K_G(system.K.rows(), system.K.cols()), stiffened;
  // The model has no free coordinates and therefore no modes.
  if (system.K.rows() == 0) {
    add_evidence(system, system.K, K_G, solution);
    return solution;
  }
  if (state) K_G = geometric_stiffness(system, state->forces);
  if (state) stiffened = system.K + K_G;
  const SparseMatrix& K = state ? stiffened : system.K;
  Factorization factorization;
  factorization.compute(shifted_matrix(K, system.M, 0));
  ++counters.factorizations;
  ZeroEnergyModes free{MatrixXd(K.rows(), 0)};
  if (!state) {
    free = find_zero_energy_modes(system, factorization, counters);
    solution.zero_energy_mode_count = free.count();
    if (!mass_orthonormalize(system, free.basis)) {
      solution.outcome = {Status::singular,
                          "massless coordinate moves freely: " + describe_mechanism(system, free)};
      return solution;
    }
  } else if (!factorization.is_nonsingular() || factorization.smallest_pivot() <= 0) {
    solution.outcome = {Status::singular, "the loads reach or exceed the buckling load"};
    return solution;
  }
  Eigenpairs pairs;
  if (free.count() == 0 || has_elastic_inertia(system.M, free.basis)) {
    Pencil pencil;
    pencil.K = &K;
    pencil.B = &system.M;
    if (free.count() > 0) {
      pencil.shift = shift_with_rigid_modes(system, free.basis, counters);
      factorization.compute(shifted_matrix(system.K, system.M, pencil.shift));
      ++counters.factorizations;
    }
    pencil.K_times = [&, elastic = stiffness_operator(system)](const VectorXd& x) -> VectorXd {
      return state ? VectorXd(elastic(x) + K_G * x) : elastic(x);
    };
    pencil.K_products = [&](const MatrixXd& X) -> MatrixXd {
      const MatrixXd elastic = projected_stiffness(system, system.T * X);
      return state ? MatrixXd(elastic + X.transpose() * (K_G * X)) : elastic;
    };
    const Index elastic = std::max<Index>(0, options.count - free.count());
    pairs = lowest_eigenpairs(pencil, free.basis, elastic, options.method, factorization, counters);
  }
  solution.outcome = pairs.outcome;
  const Index rigid = std::min(free.count(), options.count);
  const Index elastic = std::min(pairs.value.size(), options.count - rigid);
  solution.frequency.setZero(rigid + elastic);
  solution.roundoff.setZero(rigid + elastic);
  solution.shape.resize(K.rows(), rigid + elastic);
  solution.shape.leftCols(rigid) = free.basis.leftCols(rigid);
  const Prestress of_forces = state ? prestress_roundoff(system, state->q) : Prestress();
  for (Index j = 0; j < elastic; ++j) {
    const double w2 = pairs.value[j];
    const VectorXd x = pairs.vector.col(j);
    double rounding = strain_energy_roundoff(system, system.T * x);
    if (state) rounding += geometric_energy_roundoff(system, K_G, of_forces, x);
    solution.frequency[rigid + j] = std::sqrt(w2) / (2 * std::numbers::pi);
    solution.roundoff[rigid + j] = 0.5 * (rounding / w2 + pairs.error[j]) + 4 * kEps;
    solution.shape.col(rigid + j) = x;
  }
  add_evidence(system, K, K_G, solution, std::move(factorization), pairs.check_shift);
  return solution;
}

}  // namespace

bool mass_orthonormalize(const System& system, MatrixXd& Z) {
  if (Z.cols() == 0) return true;
  const SparseMatrix& M = system.M;
  // Divide rotary inertia by the square of the model size, so that it is comparable with mass.
  const VectorXd squared_length = summed_squared_lengths(system);
  VectorXd mass = M.diagonal().cwiseQuotient(squared_length);
  const double largest = mass.maxCoeff();
  if (!(largest > 0)) return false;
  mass = mass.unaryExpr([largest](double m) { return m > 0 ? m : largest; });
  const VectorXd weight = mass.cwiseProduct(squared_length);
  const MatrixXd gram = Z.transpose() * (M * Z);
  const MatrixXd size = Z.transpose() * weight.asDiagonal() * Z;
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(gram, size);
  // The limit is well above 1e-32, the square of the round-off error of a motion.
  if (!(pairs.value[0] > 1e-18)) return false;
  const VectorXd inverse = pairs.value.cwiseSqrt().cwiseInverse();
  Z = Z * pairs.vector * inverse.asDiagonal();
  return true;
}

ModalSolution solve_modes(const System& system, const ModesOptions& options) {
  return solve(system, options, nullptr);
}

ModalSolution solve_prestressed_modes(const System& system, const ModesOptions& options) {
  const StaticSolution state = solve_statics(system, {.second_order = true});
  ModalSolution modes;
  modes.outcome = state.outcome;
  modes.counters = state.counters;
  if (!state.outcome.solved()) return modes;
  modes = solve(system, options, &state);
  modes.evidence.add(state.evidence);
  const Counters solved = std::exchange(modes.counters, state.counters);
  modes.counters.factorizations += solved.factorizations;
  modes.counters.solves += solved.solves;
  return modes;
}

std::optional<Index> sturm_count(const System& system, double frequency) {
  const double w = 2 * std::numbers::pi * frequency;
  return Factorization().sturm_count(system.K - w * w * system.M);
}

}  // namespace trammel::solver
