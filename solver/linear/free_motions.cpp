#include "solver/linear/free_motions.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/eigenpairs.h"
#include "solver/linalg/factorization.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/system.h"

namespace trammel::solver {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Shift of K in inverse iteration, relative to the diagonal of K.
constexpr double kShift = 1e-12;
/// Pivot below which zero-energy modes are searched for. Pivots of a mechanism are round-off
/// errors, up to 1.2e-9 for 1152 coordinates if all errors have the same sign.
constexpr double kSmallPivot = 1e-8;
// Strain energy, relative to `strain_energy_roundoff_scale`, below which a motion is treated as a
// zero-energy mode. The value is (45 eps)^2.
constexpr double kDeformation = 1e-28;
constexpr Index kMaxModes = 48;

}  // namespace

ZeroEnergyModes find_zero_energy_modes(const System& system, const Factorization& K,
                                       Counters& counters) {
  const Index n = system.K.rows();
  ZeroEnergyModes modes{MatrixXd(n, 0), true};
  if (n == 0 || (K.is_nonsingular() && K.smallest_pivot() > kSmallPivot)) return modes;
  // Inverse iteration with K + kShift D on a block of vectors. D is the diagonal of K, and the
  // block is D-orthonormal.
  VectorXd D = system.K.diagonal();
  const double largest = D.maxCoeff();
  D = D.unaryExpr([&](double d) { return d > 0 ? d : largest > 0 ? largest : 1; }).eval();
  SparseMatrix shifted = system.K;
  for (Index i = 0; i < n; ++i) shifted.coeffRef(i, i) += kShift * D[i];
  Factorization factorization;
  factorization.compute(shifted);
  ++counters.factorizations;
  const Operator shifted_K = [&,
                              elastic = stiffness_operator(system)](const VectorXd& x) -> VectorXd {
    return elastic(x) + kShift * D.cwiseProduct(x);
  };
  const VectorXd root = D.cwiseSqrt();
  for (Index block = std::min<Index>(4, n);; block = std::min({3 * block, n, kMaxModes})) {
    MatrixXd X = start_vectors(n, block);
    for (int step = 0; step < 3; ++step) {
      for (Index j = 0; j < block; ++j) {
        const VectorXd b = D.cwiseProduct(X.col(j));
        X.col(j) = refined_solve(shifted_K, factorization, b, counters).x;
      }
      const Eigen::HouseholderQR<MatrixXd> qr(root.asDiagonal() * X);
      X = qr.householderQ() * MatrixXd::Identity(n, block);
      X = root.cwiseInverse().asDiagonal() * X;
    }
    // Compute Ritz vectors in ascending order of strain energy. They are NaN if the iteration did
    // not converge.
    X = X * symmetric_eigenpairs(projected_stiffness(system, system.T * X)).vector;
    if (!X.allFinite()) {
      modes.all_found = false;
      return modes;
    }
    Index count = 0;
    while (count < block) {
      const VectorXd u = system.T * X.col(count);
      const double energy = projected_stiffness(system, u)(0, 0);
      // The limit of the energy is relative to the larger of two values: the round-off scale and
      // x^T D x = 1. The second value is required for a motion in which both energy and round-off
      // scale are zero.
      if (!(energy <= kDeformation * std::max(1.0, strain_energy_roundoff_scale(system, u)))) break;
      ++count;
    }
    modes.basis = X.leftCols(count);
    modes.all_found = count < block || block == n;
    if (modes.all_found || block == kMaxModes) return modes;
  }
}

namespace {

// Number of displacements in the description of a mode.
constexpr std::size_t kMaxEntries = 3;
constexpr Index kMaxMotions = 6;
/// Fraction of the largest entry of a mode below which entries are round-off errors. Entries with a
/// smaller relative difference are treated as equal.
constexpr double kRoundoff = 1e-6;

using NamedRows = std::vector<std::pair<std::string, Index>>;

/// Returns the names of the coordinates of the model, such as "node B along x", with their indices
/// in u.
NamedRows names_of_coordinates(const System& system) {
  const Model& model = system.model;
  NamedRows rows;
  const auto add = [&rows](const std::string& name, Index row) {
    if (row >= 0) rows.emplace_back(name, row);
  };
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const std::string node = "node " + model.nodes[i].name;
    const std::array<Index, 3>& of_node = system.coordinates.node[i];
    add(node + " along x", of_node[0]);
    add(node + " along y", of_node[1]);
    add("rotation of " + node, of_node[2]);
  }
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const std::array<Index, 2>& ends = system.coordinates.member_end[i];
    add("rotation of the start of member " + model.members[i].name, ends[0]);
    add("rotation of the end of member " + model.members[i].name, ends[1]);
  }
  return rows;
}

/// Returns the index of the first entry whose magnitude equals the largest magnitude up to
/// round-off errors.
Index index_of_first_largest(const VectorXd& x) {
  const double enough = (1 - kRoundoff) * x.cwiseAbs().maxCoeff();
  Index i = 0;
  while (std::abs(x[i]) < enough) ++i;
  return i;
}

/// Transforms the columns to reduced echelon form: the pivot row of each column has 1 in this
/// column and 0 in all others.
void reduce(MatrixXd& U) {
  for (Index j = 0; j < U.cols(); ++j) {
    const Index pivot = index_of_first_largest(U.col(j));
    if (U(pivot, j) == 0) continue;
    U.col(j) /= U(pivot, j);
    for (Index k = 0; k < U.cols(); ++k)
      if (k != j) U.col(k) -= U(pivot, k) * U.col(j);
  }
}

std::string describe(const VectorXd& mode, const NamedRows& rows) {
  VectorXd left = mode / mode[index_of_first_largest(mode)];
  std::string text;
  for (std::size_t entry = 0; entry < std::min(kMaxEntries, rows.size()); ++entry) {
    const Index i = index_of_first_largest(left);
    if (std::abs(left[i]) < kRoundoff) break;
    char value[32];
    std::snprintf(value, sizeof value, " %.3g", left[i]);
    text += (entry > 0 ? ", " : "free motion: ") + rows[to_size(i)].first + value;
    left[i] = 0;
  }
  return text;
}

}  // namespace

std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes) {
  const NamedRows rows = names_of_coordinates(system);
  const MatrixXd u = free_to_length_matrix(system) * modes.basis;
  MatrixXd U(std::ssize(rows), u.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    U.row(static_cast<Index>(i)) = u.row(rows[i].second);
  if (U.size() > 0) reduce(U);
  std::string text;
  for (Index j = 0; j < std::min(U.cols(), kMaxMotions); ++j)
    text += (j > 0 ? "; " : "") + describe(U.col(j), rows);
  if (U.cols() > kMaxMotions) text += "; and " + std::to_string(U.cols() - kMaxMotions) + " more";
  if (!modes.all_found) text += "; and others";
  return text;
}

Outcome require_no_mechanism(const System& system, const Factorization& K, Counters& counters) {
  const ZeroEnergyModes free = find_zero_energy_modes(system, K, counters);
  if (free.count() == 0) return {};
  return {Status::singular, describe_mechanism(system, free)};
}

}  // namespace trammel::solver
