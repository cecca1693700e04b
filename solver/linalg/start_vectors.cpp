#include "solver/linalg/start_vectors.h"

#include <random>

namespace trammel::solver {

Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant) {
  std::mt19937_64 engine(20170204 + static_cast<std::uint64_t>(variant));
  Eigen::MatrixXd X(rows, columns);
  for (double& x : X.reshaped()) x = static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0;
  return X;
}

}  // namespace trammel::solver
