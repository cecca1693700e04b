#include "solver/elastodynamics/moving_pattern.h"

#include <algorithm>

namespace trammel::solver {

MovingPattern::MovingPattern(const std::vector<MovingElement>& elements, const RowMajorMatrix& T) {
  const auto n = static_cast<int>(T.cols());
  std::vector<Eigen::Triplet<double>> places;
  for (int i = 0; i < n; ++i) places.emplace_back(i, i, 0.0);
  for (const MovingElement& element : elements) {
    for_each_contribution(element.coordinates, T, [&](int, int, int, int row, int column) {
      places.emplace_back(row, column, 0.0);
    });
  }
  matrix.resize(n, n);
  matrix.setFromTriplets(places.begin(), places.end());
  matrix.makeCompressed();
  contributions.reserve(places.size());
  for (const MovingElement& element : elements) {
    first.push_back(contributions.size());
    for_each_contribution(
        element.coordinates, T, [&](int local, int a, int b, int row, int column) {
          const int* const begin = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
          const int* const end = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
          const auto place = std::lower_bound(begin, end, row) - matrix.innerIndexPtr();
          contributions.push_back({local, a, b, static_cast<int>(place)});
        });
  }
  first.push_back(contributions.size());
}

}  // namespace trammel::solver
