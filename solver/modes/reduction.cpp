#include "solver/modes/reduction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/linalg/eigenpairs.h"
#include "solver/linalg/factorization.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Free coordinates of the nodes that cut the members.
std::vector<bool> interior_coordinates(const System& system) {
  std::vector<bool> interior(static_cast<std::size_t>(system.K.rows()), false);
  for (std::size_t n = system.model.nodes.size(); n < system.coordinates.node.size(); ++n) {
    for (const Index u : system.coordinates.node[n]) {
      const Index q = u < 0 ? -1 : system.constraints.free[static_cast<std::size_t>(u)];
      if (q >= 0) interior[static_cast<std::size_t>(q)] = true;
    }
  }
  return interior;
}

/// The inside coordinates in sets that nothing couples: a member's each.
std::vector<std::vector<Index>> components(const System& system,
                                           const std::vector<bool>& interior) {
  std::vector<Index> root(interior.size());
  std::iota(root.begin(), root.end(), Index{0});
  const auto find = [&](Index i) {
    while (root[static_cast<std::size_t>(i)] != i) {
      Index& up = root[static_cast<std::size_t>(i)];
      i = up = root[static_cast<std::size_t>(up)];
    }
    return i;
  };
  for (const SparseMatrix* matrix : {&system.K, &system.M}) {
    for (Index j = 0; j < matrix->outerSize(); ++j) {
      if (!interior[static_cast<std::size_t>(j)]) continue;
      for (SparseMatrix::InnerIterator entry(*matrix, j); entry; ++entry) {
        const Index i = entry.row();
        if (interior[static_cast<std::size_t>(i)])
          root[static_cast<std::size_t>(find(i))] = find(j);
      }
    }
  }
  // Bending and stretching of a member that lies along an axis are not coupled, and yet its own.
  std::vector<Index> first(system.model.members.size(), -1);
  for (const FrameElement& element : system.mesh.frame) {
    for (const Index u : element.coordinates) {
      const Index q = u < 0 ? -1 : system.constraints.free[static_cast<std::size_t>(u)];
      if (q < 0 || !interior[static_cast<std::size_t>(q)]) continue;
      Index& own = first[static_cast<std::size_t>(element.member)];
      if (own < 0) own = q;
      root[static_cast<std::size_t>(find(q))] = find(own);
    }
  }
  std::vector<std::vector<Index>> sets;
  std::vector<Index> set_of(interior.size(), -1);
  for (std::size_t q = 0; q < interior.size(); ++q) {
    if (!interior[q]) continue;
    const auto r = static_cast<std::size_t>(find(static_cast<Index>(q)));
    if (set_of[r] < 0) {
      set_of[r] = static_cast<Index>(sets.size());
      sets.emplace_back();
    }
    sets[static_cast<std::size_t>(set_of[r])].push_back(static_cast<Index>(q));
  }
  return sets;
}

/// Rows and columns of a matrix.
class IndexSubset {
 public:
  IndexSubset(Index size, const std::vector<Index>& chosen)
      : local_index_(static_cast<std::size_t>(size), -1) {
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      local_index_[static_cast<std::size_t>(chosen[i])] = static_cast<Index>(i);
    }
    count_ = static_cast<Index>(chosen.size());
  }
  [[nodiscard]] Index local_index(Index q) const {
    return local_index_[static_cast<std::size_t>(q)];
  }

  [[nodiscard]] SparseMatrix submatrix(const SparseMatrix& matrix,
                                       const std::vector<Index>& chosen) const {
    Triplets entries;
    for (const Index j : chosen) {
      for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry) {
        if (local_index(entry.row()) >= 0) {
          entries.emplace_back(local_index(entry.row()), local_index(j), entry.value());
        }
      }
    }
    SparseMatrix part(count_, count_);
    part.setFromTriplets(entries.begin(), entries.end());
    return part;
  }

 private:
  std::vector<Index> local_index_;
  Index count_ = 0;
};

/// Boundary coordinates that K couples with the set, each once.
std::vector<Index> neighbours(const SparseMatrix& K, const std::vector<Index>& set,
                              const IndexSubset& part) {
  std::vector<Index> found;
  for (const Index j : set) {
    for (SparseMatrix::InnerIterator entry(K, j); entry; ++entry) {
      if (part.local_index(entry.row()) < 0) found.push_back(entry.row());
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// Column of K at a boundary coordinate, its rows in the set.
VectorXd coupling(const SparseMatrix& K, Index boundary, const std::vector<Index>& set,
                  const IndexSubset& part) {
  VectorXd column = VectorXd::Zero(static_cast<Index>(set.size()));
  for (SparseMatrix::InnerIterator entry(K, boundary); entry; ++entry) {
    if (part.local_index(entry.row()) >= 0) column[part.local_index(entry.row())] = entry.value();
  }
  return column;
}

/// The lowest modes with the boundary held.
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

/// Share of a load's static response that is round-off.
constexpr double kCarried = 1e-10;

/// Parts of static responses beyond the modes, of unit strain energy, each orthogonal to those
/// before it in K.
MatrixXd beyond_modes(const SparseMatrix& K, const SparseMatrix& M, const MatrixXd& modes,
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

/// R in q = R p.
SparseMatrix reduction(const System& system, Index modes, const std::vector<VectorXd>& loads,
                       Counters& counters) {
  const std::vector<bool> interior = interior_coordinates(system);
  const std::vector<std::vector<Index>> sets = components(system, interior);
  const Index size = system.K.rows();
  std::vector<Index> kept(interior.size(), -1);
  Index columns = 0;
  for (std::size_t q = 0; q < interior.size(); ++q) {
    if (!interior[q]) kept[q] = columns++;
  }
  Triplets entries;
  for (std::size_t q = 0; q < interior.size(); ++q) {
    if (!interior[q]) entries.emplace_back(static_cast<Index>(q), kept[q], 1.0);
  }
  for (const std::vector<Index>& set : sets) {
    if (modes >= static_cast<Index>(set.size())) {
      for (const Index q : set) entries.emplace_back(q, columns++, 1.0);
      continue;
    }
    const IndexSubset part(size, set);
    const SparseMatrix K = part.submatrix(system.K, set), M = part.submatrix(system.M, set);
    Factorization factorization;
    factorization.compute(shifted(K, M, 0));
    ++counters.factorizations;
    for (const Index boundary : neighbours(system.K, set, part)) {
      const VectorXd follows = -factorization.solve(coupling(system.K, boundary, set, part));
      ++counters.solves;
      add_column(follows, set, kept[static_cast<std::size_t>(boundary)], entries);
    }
    std::vector<VectorXd> responses;
    for (const VectorXd& load : loads) {
      responses.emplace_back(factorization.solve(load(set)));
      ++counters.solves;
    }
    MatrixXd shapes(K.rows(), 0);
    if (modes > 0) shapes = fixed_interface_modes(K, M, modes, factorization, counters);
    for (const MatrixXd& block : {shapes, beyond_modes(K, M, shapes, responses)}) {
      for (Index j = 0; j < block.cols(); ++j) add_column(block.col(j), set, columns++, entries);
    }
  }
  SparseMatrix R(size, columns);
  R.setFromTriplets(entries.begin(), entries.end());
  return R;
}

SparseMatrix projected(const SparseMatrix& matrix, const SparseMatrix& R) {
  const SparseMatrix product = R.transpose() * (matrix * R);
  // Symmetric to the last digit, as what is factored must be.
  return 0.5 * (product + SparseMatrix(product.transpose()));
}

/// The system in p, q = R p.
System in_coordinates(const System& system, const SparseMatrix& R) {
  System reduced = system;
  reduced.T = system.T * R;
  reduced.K = projected(system.K, R);
  reduced.M = projected(system.M, R);
  reduced.f = R.transpose() * system.f;
  return reduced;
}

}  // namespace

System reduce_members(const System& system, Index modes, const std::vector<VectorXd>& loads) {
  if (modes < 0) throw ModelError("a reduction needs a number of modes that is not negative");
  Counters counters = system.counters;
  System reduced = in_coordinates(system, reduction(system, modes, loads, counters));
  reduced.counters = counters;
  return reduced;
}

System reduce_to_modes(const System& system, const ModalSolution& modes,
                       const std::vector<VectorXd>& loads) {
  constexpr double kShift = 1e-4;  // below the modes that are left out
  const MatrixXd& shape = modes.shape;
  MatrixXd basis = shape;
  Counters counters = modes.counters;
  SparseMatrix K = system.K;
  if (modes.zero_energy_mode_count > 0) {
    const double highest = 2 * std::numbers::pi * modes.frequency.maxCoeff();
    const double mean = system.K.diagonal().sum() / system.M.diagonal().sum();
    K += kShift * (highest > 0 ? highest * highest : mean) * system.M;
  }
  Factorization factorization;
  for (const VectorXd& load : loads) {
    const VectorXd rest = load - system.M * (shape * (shape.transpose() * load));
    if (!(rest.norm() > kCarried * load.norm())) continue;
    if (!factorization.exists()) {
      factorization.compute(K);
      ++counters.factorizations;
    }
    if (!factorization.exists()) throw ModelError("a reduction to modes needs a stiff model");
    VectorXd answer = factorization.solve(rest);
    answer += factorization.solve(rest - system.K * answer);  // without the shift
    counters.solves += 2;
    answer -= shape * (shape.transpose() * (system.M * answer));
    const MatrixXd others = basis.rightCols(basis.cols() - shape.cols());
    const double energy = answer.dot(system.K * answer);
    answer -= others * (others.transpose() * (system.K * answer));
    const double own = answer.dot(system.K * answer);
    if (!(own > kCarried * energy)) continue;  // one before it does the same
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    // Of one strain energy, not of one mass: coordinates without mass may answer too.
    basis.rightCols<1>() = answer / std::sqrt(own);
  }
  System reduced = in_coordinates(system, basis.sparseView());
  reduced.counters = counters;
  return reduced;
}

}  // namespace trammel::solver
