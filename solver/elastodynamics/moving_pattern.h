#pragma once

#include <array>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/elastodynamics/moving_element.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// The products T(a) A(local) T(b) of an element's 6 x 6 matrix A that make up T^T A T:
/// visit(local, a, b, row, column), local = i + 6 j.
/// @param coordinates  of the element, unconstrained; -1: none
template <class Visit>
void for_each_contribution(const std::array<Index, 6>& coordinates, const RowMajorMatrix& T,
                           Visit&& visit) {
  for (int i = 0; i < 6; ++i) {
    const Index u = coordinates[to_size(i)];
    for (int j = 0; j < 6 && u >= 0; ++j) {
      const Index w = coordinates[to_size(j)];
      if (w < 0) continue;
      for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a) {
        for (int b = T.outerIndexPtr()[w]; b < T.outerIndexPtr()[w + 1]; ++b) {
          visit(i + 6 * j, a, b, T.innerIndexPtr()[a], T.innerIndexPtr()[b]);
        }
      }
    }
  }
}

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
  MovingPattern(const std::vector<MovingElement>& elements, const RowMajorMatrix& T);
};

}  // namespace trammel::solver
