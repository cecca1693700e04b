#include "solver/linalg/lanczos.h"

#include <Spectra/SymEigsSolver.h>

#include <random>
#include <stdexcept>

namespace trammel::solver {
namespace {

/// What Spectra asks of an operator.
struct SpectraOperator {
  using Scalar = double;
  const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply;
  Index size;

  [[nodiscard]] Index rows() const { return size; }
  [[nodiscard]] Index cols() const { return size; }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, size) = apply(Eigen::Map<const Eigen::VectorXd>(in, size));
  }
};

}  // namespace

LanczosPairs largest_eigenpairs(
    const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply,
    const Eigen::VectorXd& start, const LanczosOptions& options) {
  constexpr Index kMaxRestarts = 300;
  SpectraOperator op{apply, start.size()};
  const LanczosPairs none{Eigen::VectorXd(0), Eigen::MatrixXd(start.size(), 0)};
  try {
    Spectra::SymEigsSolver<SpectraOperator> solver(op, options.wanted, options.subspace);
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestAlge, kMaxRestarts, options.tolerance);
    return {solver.eigenvalues(), solver.eigenvectors()};
  } catch (const std::runtime_error&) {  // no eigenvalues of what it projected to: not finite
    return none;
  } catch (const std::invalid_argument&) {  // a start, or an image of it, that is zero
    return none;
  }
}

Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant) {
  std::mt19937_64 engine(20170204 + static_cast<std::uint64_t>(variant));
  Eigen::MatrixXd X(rows, columns);
  for (double& x : X.reshaped()) x = static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0;
  return X;
}

}  // namespace trammel::solver
