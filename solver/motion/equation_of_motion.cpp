#include "solver/motion/equation_of_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/linalg/eigenpairs.h"
#include "solver/model/model.h"

namespace trammel::solver {

namespace {

/// Returns the norm of a matrix: the largest column sum of magnitudes.
double matrix_norm(const SparseMatrix& A) {
  double norm = 0;
  for (Index column = 0; column < A.outerSize(); ++column) {
    double sum = 0;
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) sum += std::abs(it.value());
    norm = std::max(norm, sum);
  }
  return norm;
}

void check(const EquationOfMotion& e) {
  const Index n = e.M.rows();
  const auto fits = [n](const SparseMatrix& A) { return A.rows() == n && A.cols() == n; };
  if (!fits(e.M) || !fits(e.K) || !(e.C.size() == 0 || fits(e.C)))
    throw ModelError("M, C and K of an equation of motion must be square and of equal size");
  if (e.update && !(same_pattern(e.M, e.K) && (e.C.size() == 0 || same_pattern(e.M, e.C))))
    throw ModelError("M, C and K that change with time must have entries at the same positions");
}

}  // namespace

EquationMatrices::EquationMatrices(const EquationOfMotion& equation)
    : equation_(equation), M_(equation.M), C_(equation.C), K_(equation.K) {
  check(equation);
  const Index n = M_.rows();
  if (C_.size() == 0) C_.resize(n, n);
  if (!equation.update) {
    SparseMatrix pattern = M_ + C_ + K_;
    pattern += SparseMatrix(pattern.transpose());
    std::fill(pattern.valuePtr(), pattern.valuePtr() + pattern.nonZeros(), 0.0);
    for (SparseMatrix* A : {&M_, &C_, &K_}) {
      *A = SparseMatrix(*A + pattern);
      A->makeCompressed();
    }
  }
  if (equation.update && equation.C.size() == 0) {
    C_ = M_;
    C_.coeffs().setZero();
  }
}

void EquationMatrices::update(double time) {
  if (equation_.update) {
    equation_.update(time, M_, C_, K_);
  } else if (norm_M_ > 0) {
    return;
  }
  norm_M_ = matrix_norm(M_);
  norm_C_ = matrix_norm(C_);
  norm_K_ = matrix_norm(K_);
}

void EquationMatrices::compute_load(double time, Eigen::VectorXd& f) const {
  if (equation_.load) {
    equation_.load(time, f);
  } else {
    f.setZero();
  }
}

using Eigen::VectorXd;

TimeInterval find_interval(const std::vector<double>& times, double t) {
  const auto next = std::upper_bound(times.begin(), times.end(), t);
  const auto k = static_cast<Index>(next - times.begin());
  if (k == 0) return {};
  if (next == times.end()) return {k - 1, k - 1};
  const double length = *next - *(next - 1);
  return {k - 1, k, (t - *(next - 1)) / length, length};
}

double LoadHistory::at(double t) const {
  const auto [left, right, share, length] = find_interval(time, t);
  return factor[to_size(left)] * (1 - share) + factor[to_size(right)] * share;
}

std::vector<double> LoadHistory::breakpoint_times() const {
  std::vector<double> bends;
  double before = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const bool last = k + 1 == time.size();
    const double after = last ? 0 : (factor[k + 1] - factor[k]) / (time[k + 1] - time[k]);
    const double rounding = 1e-9 * std::max(std::abs(before), std::abs(after));
    if (!(std::abs(after - before) <= rounding)) bends.push_back(time[k]);
    before = after;
  }
  return bends;
}

double LoadHistory::step_end_load_time(double t) const {
  const auto [first, last] = std::equal_range(time.begin(), time.end(), t);
  return last - first > 1 ? std::nextafter(t, -std::numeric_limits<double>::infinity()) : t;
}

void PiecewiseLinearLoad::at(double t, VectorXd& f) const {
  const auto [left, right, share, length] = find_interval(time, t);
  f.noalias() = pattern * ((1 - share) * factor.col(left));
  if (share > 0) f.noalias() += pattern * (share * factor.col(right));
}

void PiecewiseLinearLoad::check() const {
  if (factor.cols() != std::ssize(time) || factor.rows() != pattern.cols() || time.empty())
    throw ModelError("a piecewise linear load requires one factor per load and time");
  if (!std::is_sorted(time.begin(), time.end())) throw ModelError("load times must be ascending");
}

void PiecewiseLinearLoad::apply_to(EquationOfMotion& equation) const {
  check();
  if (pattern.rows() != equation.M.rows())
    throw ModelError("the load must have as many entries as the equation of motion has rows");
  equation.breakpoints.insert(equation.breakpoints.end(), time.begin(), time.end());
  equation.load = [self = *this](double t, VectorXd& f) { self.at(t, f); };
}

PiecewiseLinearLoad step_load(const VectorXd& pattern, double start) {
  return {.pattern = pattern,
          .time = {start, start},
          .factor = (Eigen::MatrixXd(1, 2) << 0, 1).finished()};
}

PiecewiseLinearLoad load_by_history(const LoadHistory& history, const VectorXd& varied,
                                    const VectorXd& constant) {
  PiecewiseLinearLoad load;
  load.pattern.resize(varied.size(), 2);
  load.pattern << varied, constant;
  load.time = history.time;
  load.factor.setOnes(2, std::ssize(history.factor));
  load.factor.row(0) =
      Eigen::Map<const Eigen::RowVectorXd>(history.factor.data(), std::ssize(history.factor));
  return load;
}

}  // namespace trammel::solver
