#include "solver/linear/reduction.h"

#include <cmath>
#include <map>
#include <numbers>

#include "solver/linalg/eigenpairs.h"
#include "solver/linalg/factorization.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Returns the free coordinates of the nodes that divide members into elements, one set per member.
/// The sets are not coupled with each other.
std::vector<std::vector<Index>> interior_coordinates_of_members(const System& system) {
  const auto free_coordinate = [&system](Index u) {
    return u < 0 ? Index{-1} : system.constraints.free[to_size(u)];
  };
  // Root of the set (disjoint-set forest) of each coordinate; -1: boundary.
  std::vector<Index> root(to_size(system.K.rows()), -1);
  for (std::size_t n = system.model.nodes.size(); n < system.coordinates.node.size(); ++n) {
    for (const Index u : system.coordinates.node[n]) {
      const Index q = free_coordinate(u);
      if (q >= 0) root[to_size(q)] = q;
    }
  }
  const auto find = [&root](Index i) {
    while (root[to_size(i)] != i) i = root[to_size(i)] = root[to_size(root[to_size(i)])];
    return i;
  };
  const auto join = [&](Index i, Index j) {
    if (root[to_size(i)] >= 0 && root[to_size(j)] >= 0) root[to_size(find(i))] = find(j);
  };
  for (const SparseMatrix* matrix : {&system.K, &system.M}) {
    for (Index j = 0; j < matrix->outerSize(); ++j)
      for (SparseMatrix::InnerIterator entry(*matrix, j); entry; ++entry) join(entry.row(), j);
  }
  // Bending and stretching of a member along a coordinate axis are uncoupled. Both are therefore
  // joined to a single set.
  std::vector<Index> first(system.model.members.size(), -1);
  for (const FrameElement& element : system.mesh.frame) {
    Index& own = first[to_size(element.member)];
    for (const Index u : element.coordinates) {
      const Index q = free_coordinate(u);
      if (q < 0 || root[to_size(q)] < 0) continue;
      if (own < 0) own = q;
      join(q, own);
    }
  }
  std::map<Index, std::vector<Index>> set_of;
  for (Index q = 0; q < std::ssize(root); ++q)
    if (root[to_size(q)] >= 0) set_of[find(q)].push_back(q);
  std::vector<std::vector<Index>> sets;
  for (const auto& entry : set_of) sets.push_back(entry.second);
  return sets;
}

/// Returns the columns of the identity matrix whose indices are in `chosen`.
SparseMatrix selection(Index size, const std::vector<Index>& chosen) {
  SparseMatrix S(size, std::ssize(chosen));
  for (Index j = 0; j < S.cols(); ++j) S.insert(chosen[to_size(j)], j) = 1;
  S.makeCompressed();
  return S;
}

/// Returns the lowest modes of the interior of a member with fixed boundary coordinates.
MatrixXd fixed_interface_modes(const SparseMatrix& K, const SparseMatrix& M, Index modes,
                               Factorization& factorization, Counters& counters) {
  Pencil pencil;
  pencil.K = &K;
  pencil.B = &M;
  pencil.K_times = [&K](const VectorXd& x) -> VectorXd { return K * x; };
  pencil.K_products = [&K](const MatrixXd& X) -> MatrixXd { return X.transpose() * (K * X); };
  const MatrixXd no_null(K.rows(), 0);
  return lowest_eigenpairs(pencil, no_null, modes, EigenMethod::automatic, factorization, counters)
      .vector;
}

void add_column(const VectorXd& values, const std::vector<Index>& set, Index column,
                Triplets& entries) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double value = values[static_cast<Index>(i)];
    if (value != 0) entries.emplace_back(set[i], column, value);
  }
}

/// Limit for the part of a load or static response that the modes do not represent. A part with a
/// smaller relative norm (load) or strain energy (response) is treated as a round-off error.
constexpr double kCarried = 1e-10;

/// Returns the components of static responses that the modes do not represent. Each component has
/// unit strain energy and is K-orthogonal to all preceding components.
MatrixXd residual_responses(const SparseMatrix& K, const SparseMatrix& M, const MatrixXd& modes,
                            const std::vector<VectorXd>& responses) {
  MatrixXd parts(K.rows(), 0);
  for (VectorXd part : responses) {
    const double energy = part.dot(K * part);
    part -= modes * (modes.transpose() * (M * part));
    part -= parts * (parts.transpose() * (K * part));
    const double rest = part.dot(K * part);
    if (!(rest > kCarried * energy)) continue;
    parts.conservativeResize(Eigen::NoChange, parts.cols() + 1);
    parts.rightCols<1>() = part / std::sqrt(rest);
  }
  return parts;
}

/// Returns the matrix R of the reduction q = R p. The components of p are the boundary coordinates,
/// followed by the amplitudes of modes and static responses of each interior set.
SparseMatrix reduction_matrix(const System& system, Index modes, const std::vector<VectorXd>& loads,
                              Counters& counters) {
  const std::vector<std::vector<Index>> sets = interior_coordinates_of_members(system);
  const Index size = system.K.rows();
  std::vector<bool> interior(to_size(size), false);
  for (const std::vector<Index>& set : sets)
    for (const Index q : set) interior[to_size(q)] = true;
  std::vector<Index> boundary;
  Triplets entries;
  for (Index q = 0; q < size; ++q) {
    if (interior[to_size(q)]) continue;
    entries.emplace_back(q, boundary.size(), 1.0);
    boundary.push_back(q);
  }
  const SparseMatrix to_boundary = selection(size, boundary).transpose();
  Index columns = std::ssize(boundary);
  for (const std::vector<Index>& set : sets) {
    if (modes >= std::ssize(set)) {
      for (const Index q : set) entries.emplace_back(q, columns++, 1.0);
      continue;
    }
    const SparseMatrix S = selection(size, set), K_of_set = system.K * S;
    const SparseMatrix K = S.transpose() * K_of_set, M = S.transpose() * (system.M * S);
    const SparseMatrix coupling = SparseMatrix(to_boundary * K_of_set).transpose();
    Factorization factorization;
    factorization.compute(shifted_matrix(K, M, 0));
    ++counters.factorizations;
    for (Index j = 0; j < coupling.cols(); ++j) {
      if (coupling.col(j).nonZeros() == 0) continue;
      add_column(-factorization.solve(coupling.col(j)), set, j, entries);
      ++counters.solves;
    }
    std::vector<VectorXd> responses;
    for (const VectorXd& load : loads) {
      responses.emplace_back(factorization.solve(load(set)));
      ++counters.solves;
    }
    MatrixXd shapes(K.rows(), 0);
    if (modes > 0) shapes = fixed_interface_modes(K, M, modes, factorization, counters);
    for (const MatrixXd& block : {shapes, residual_responses(K, M, shapes, responses)}) {
      for (Index j = 0; j < block.cols(); ++j) add_column(block.col(j), set, columns++, entries);
    }
  }
  SparseMatrix R(size, columns);
  R.setFromTriplets(entries.begin(), entries.end());
  return R;
}

SparseMatrix project_matrix(const SparseMatrix& matrix, const SparseMatrix& R) {
  const SparseMatrix product = R.transpose() * (matrix * R);
  // Make the product symmetric in all digits, because the factorization requires exact symmetry.
  return 0.5 * (product + SparseMatrix(product.transpose()));
}

/// Returns the system in the reduced coordinates p, with q = R p.
System projected_system(const System& system, const SparseMatrix& R) {
  System reduced = system;
  reduced.T = system.T * R;
  reduced.K = project_matrix(system.K, R);
  reduced.M = project_matrix(system.M, R);
  reduced.f = R.transpose() * system.f;
  return reduced;
}

}  // namespace

System reduce_members(const System& system, Index modes, const std::vector<VectorXd>& loads) {
  if (modes < 0) throw ModelError("the number of modes of a reduction must not be negative");
  Counters counters = system.counters;
  System reduced = projected_system(system, reduction_matrix(system, modes, loads, counters));
  reduced.counters = counters;
  return reduced;
}

System reduce_to_modes(const System& system, const ModalSolution& modes,
                       const std::vector<VectorXd>& loads) {
  // Shift of the stiffness matrix, relative to the highest eigenvalue of the modes.
  constexpr double kShift = 1e-4;
  const MatrixXd& shape = modes.shape;
  Counters counters = modes.counters;
  SparseMatrix K = system.K;
  if (modes.zero_energy_mode_count > 0) {
    const double highest = 2 * std::numbers::pi * modes.frequency.maxCoeff();
    const double mean = system.K.diagonal().sum() / system.M.diagonal().sum();
    K += kShift * (highest > 0 ? highest * highest : mean) * system.M;
  }
  Factorization factorization;
  std::vector<VectorXd> responses;
  for (const VectorXd& load : loads) {
    const VectorXd rest = load - system.M * (shape * (shape.transpose() * load));
    if (!(rest.norm() > kCarried * load.norm())) continue;
    if (!factorization.is_nonsingular()) {
      factorization.compute(K);
      ++counters.factorizations;
    }
    if (!factorization.is_nonsingular())
      throw ModelError("the stiffness matrix of the model to be reduced is singular");
    VectorXd answer = factorization.solve(rest);
    // Correct the effect of the shift by one step of iterative refinement.
    answer += factorization.solve(rest - system.K * answer);
    counters.solves += 2;
    responses.push_back(answer);
  }
  // The responses have unit strain energy instead of unit mass, because responses may include
  // massless coordinates.
  const MatrixXd beyond = residual_responses(system.K, system.M, shape, responses);
  MatrixXd basis(shape.rows(), shape.cols() + beyond.cols());
  basis << shape, beyond;
  System reduced = projected_system(system, basis.sparseView());
  reduced.counters = counters;
  return reduced;
}

}  // namespace trammel::solver
