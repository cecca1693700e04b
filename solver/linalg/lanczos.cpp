#include "solver/linalg/lanczos.h"

#include <Spectra/SymEigsSolver.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace trammel::solver {
namespace {

/// What Spectra asks of an operator.
struct SpectraOperator {
  using Scalar = double;
  const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply;
  Index size;
  double scale = 1;

  [[nodiscard]] Index rows() const { return size; }
  [[nodiscard]] Index cols() const { return size; }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, size) =
        scale * apply(Eigen::Map<const Eigen::VectorXd>(in, size));
  }
};

/// A power of two that makes the operator of the size that suits Spectra, which takes any pair for
/// converged within tolerance * eps^(2/3), in whatever units it is: that is to be some eps of the
/// largest eigenvalue, its rounding. 1 where the operator makes nothing of the start, or what is
/// not finite.
double fitting_scale(const SpectraOperator& op, const Eigen::VectorXd& start, double tolerance) {
  const Eigen::VectorXd image = op.apply(start);
  const double largest = op.apply(image).norm() / image.norm();  // about
  const double fitting = tolerance / std::cbrt(kEps) / 4;
  return std::isnormal(largest) ? std::exp2(std::round(std::log2(fitting / largest))) : 1;
}

}  // namespace

LanczosPairs largest_eigenpairs(
    const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply,
    const Eigen::VectorXd& start, const LanczosOptions& options) {
  constexpr Index kMaxRestarts = 300;
  SpectraOperator op{apply, start.size()};
  op.scale = fitting_scale(op, start, options.tolerance);
  const LanczosPairs none{Eigen::VectorXd(0), Eigen::MatrixXd(start.size(), 0)};
  try {
    Spectra::SymEigsSolver<SpectraOperator> solver(op, options.wanted, options.subspace);
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestAlge, kMaxRestarts, options.tolerance);
    return {solver.eigenvalues() / op.scale, solver.eigenvectors()};
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
