#include "solver/grnn/grnn_weights.h"

#include <algorithm>
#include <limits>

namespace trammel::solver {

namespace {

constexpr double kLeastExponent = -708;  // below, results are no normal numbers

}  // namespace

const Eigen::ArrayXd& ExcessDistances::compute(const Eigen::Ref<const Eigen::VectorXd>& query,
                                               double reach,
                                               const Eigen::Array<bool, Eigen::Dynamic, 1>* skip) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kRounding = 1e-12;  // more than that of squares of a thousand inputs
  const Index count = samples_.rows();
  excess_ = (query(0) - samples_.col(0).array()).square();
  for (Index f = 1; f < samples_.cols(); ++f)
    excess_ += (query(f) - samples_.col(f).array()).square();
  if (skip) excess_ = skip->select(kInfinity, excess_);
  const double least = excess_.minCoeff();
  const double* const begin = excess_.data();
  const Index nearest = std::min(std::find(begin, begin + count, least) - begin, count - 1);
  const double limit = (least + reach) * (1 + kRounding);
  for (first_ = 0; first_ < nearest && !(excess_(first_) <= limit);) ++first_;
  for (last_ = count; last_ > nearest + 1 && !(excess_(last_ - 1) <= limit);) --last_;

  // Further away D_i^2 stays, which is no less than its excess.
  auto near = excess_.segment(first_, last_ - first_);
  near.setZero();
  for (Index f = 0; f < samples_.cols(); ++f) {
    const double x = query(f), m = samples_(nearest, f);
    const auto s = samples_.col(f).segment(first_, near.size()).array();
    near += (m - s) * ((x - s) + (x - m));
  }
  if (skip) near = skip->segment(first_, near.size()).select(kInfinity, near);
  // Rounding may have named the second nearest: count from the least, so that none is negative.
  near -= near.minCoeff();
  return excess_;
}

void kernel_weights(const double* excess, Index count, double sigma, double* weights) {
  // Two divisions, since sigma^2 may underflow or overflow where excess / sigma / sigma has its
  // proper limit.
  const double inverse = 1 / sigma;
  const Eigen::Map<const Eigen::ArrayXd> e(excess, count);
  Eigen::Map<Eigen::ArrayXd>(weights, count) =
      (-0.5 * (e * inverse) * inverse).max(kLeastExponent).exp();
}

double reach_of_kernel(double sigma) {
  return -2 * kLeastExponent * sigma * sigma;
}

}  // namespace trammel::solver
