#include "solver/elastodynamics/moving_pattern.h"

#include <algorithm>

namespace trammel::solver {

namespace {

using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// visit(local, a, b, row, column) of every contribution of the element.
template <class Visit>
void for_each_contribution(const MovingElement& element, const RowMajorMatrix& T, Visit&& visit) {
  for (int i = 0; i < 6; ++i) {
    const Index u = element.coordinates[static_cast<std::size_t>(i)];
    for (int j = 0; j < 6 && u >= 0; ++j) {
      const Index w = element.coordinates[static_cast<std::size_t>(j)];
      if (w < 0) continue;
      for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a) {
        for (int b = T.outerIndexPtr()[w]; b < T.outerIndexPtr()[w + 1]; ++b) {
          visit(i + 6 * j, a, b, T.innerIndexPtr()[a], T.innerIndexPtr()[b]);
        }
      }
    }
  }
}

}  // namespace

MovingPattern::MovingPattern(const std::vector<MovingElement>& elements, const RowMajorMatrix& T) {
  const auto n = static_cast<int>(T.cols());
  std::vector<Eigen::Triplet<double>> places;
  for (int i = 0; i < n; ++i) places.emplace_back(i, i, 0.0);
  for (const MovingElement& element : elements) {
    for_each_contribution(element, T, [&](int, int, int, int row, int column) {
      places.emplace_back(row, column, 0.0);
    });
  }
  matrix.resize(n, n);
  matrix.setFromTriplets(places.begin(), places.end());
  matrix.makeCompressed();
  contributions.reserve(places.size());
  for (const MovingElement& element : elements) {
    first.push_back(contributions.size());
    for_each_contribution(element, T, [&](int local, int a, int b, int row, int column) {
      const int* const begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
      const int* const end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
      const auto place = std::lower_bound(begin, end, row) - matrix.innerIndexPtr();
      contributions.push_back({local, a, b, static_cast<int>(place)});
    });
  }
  first.push_back(contributions.size());
}

}  // namespace trammel::solver
