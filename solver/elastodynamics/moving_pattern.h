#pragma once

#include <vector>

#include "solver/assembly/system.h"
#include "solver/elastodynamics/moving_element.h"

namespace trammel::solver {

/// Where the entries of the elements' matrices go in T^T A T, found once:
/// value(destination) += T(a) * element(local) * T(b).
struct MovingPattern {
  struct Contribution {
    int local, a, b, destination;
  };
  SparseMatrix matrix;  ///< free coordinates, every entry that some pose needs, zero
  std::vector<Contribution> contributions;
  std::vector<std::size_t> first;  ///< contribution of each element, and their number

  /// @param T  with its entries at every pose
  MovingPattern(const std::vector<MovingElement>& elements,
                const Eigen::SparseMatrix<double, Eigen::RowMajor>& T);
};

}  // namespace trammel::solver
