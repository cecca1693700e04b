#include "solver/grnn/grnn_weights.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

// Compiled for wide vectors, too; which, is chosen as the program starts. The bits are the same:
// nothing is fused, no sum reordered.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    !defined(__SANITIZE_ADDRESS__)
#define TRAMMEL_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define TRAMMEL_WIDE
#endif

namespace trammel::solver {

namespace {

constexpr double kLeastExponent = -708;  // below, results are no normal numbers

/// Adds (x - s)^2 for each sample s.
TRAMMEL_WIDE void add_squares(const double* samples, Index count, double x, double* sum) {
  for (Index i = 0; i < count; ++i) {
    const double d = x - samples[i];
    sum[i] += d * d;
  }
}

/// Adds (m - s) ((x - s) + x - m) for each sample s.
TRAMMEL_WIDE void add_excess(const double* samples, Index count, double x, double m, double* sum) {
  for (Index i = 0; i < count; ++i) sum[i] += (m - samples[i]) * ((x - samples[i]) + (x - m));
}

TRAMMEL_WIDE double least_of(const double* values, Index count) {
  double least = std::numeric_limits<double>::infinity();
#pragma omp simd reduction(min : least)
  for (Index i = 0; i < count; ++i) least = values[i] < least ? values[i] : least;
  return least;
}

/// exp(y) = 2^k exp(r), |r| <= ln(2)/2, by the rational approximation of Cephes (Moshier 1989),
/// for y <= 0, without a branch, so that loops of it become vectors. 0 below kLeastExponent.
inline double exponential(double y) {
  constexpr double kRound = 0x1.8p52, kLog2E = 1.4426950408889634;
  constexpr double kLn2High = 6.93145751953125e-1, kLn2Low = 1.42860682030941723212e-6;
  const double bounded = y < kLeastExponent ? kLeastExponent : y;
  const double shifted = bounded * kLog2E + kRound;  // k stands in its last bits
  const double k = shifted - kRound;
  const double r = (bounded - k * kLn2High) - k * kLn2Low;
  const double rr = r * r;
  const double p = r * ((1.26177193074810590878e-4 * rr + 3.02994407707441961300e-2) * rr + 1);
  const double q = ((3.00198505138664455042e-6 * rr + 2.52448340349684104192e-3) * rr +
                    2.27265548208155028766e-1) *
                       rr +
                   2;
  const double of_r = 1 + 2 * (p / (q - p));
  const double value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(of_r) +
                                             (std::bit_cast<std::uint64_t>(shifted) << 52U));
  return y < kLeastExponent ? 0 : value;
}

}  // namespace

const Eigen::ArrayXd& ExcessDistances::compute(const Eigen::Ref<const Eigen::VectorXd>& query,
                                               double reach,
                                               const Eigen::Array<bool, Eigen::Dynamic, 1>* skip) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kRounding = 1e-12;  // more than that of squares of a thousand inputs
  const Index count = samples_.rows();
  excess_.setZero();
  for (Index f = 0; f < samples_.cols(); ++f)
    add_squares(samples_.col(f).data(), count, query(f), excess_.data());
  if (skip) excess_ = skip->select(kInfinity, excess_);
  const double least = least_of(excess_.data(), count);
  const double* const begin = excess_.data();
  const Index nearest = std::min(std::find(begin, begin + count, least) - begin, count - 1);
  const double limit = (least + reach) * (1 + kRounding);
  for (first_ = 0; first_ < nearest && !(excess_(first_) <= limit);) ++first_;
  for (last_ = count; last_ > nearest + 1 && !(excess_(last_ - 1) <= limit);) --last_;

  // Further away D_i^2 stays, which is no less than its excess.
  auto near = excess_.segment(first_, last_ - first_);
  near.setZero();
  for (Index f = 0; f < samples_.cols(); ++f)
    add_excess(samples_.col(f).data() + first_, near.size(), query(f), samples_(nearest, f),
               near.data());
  if (skip) near = skip->segment(first_, near.size()).select(kInfinity, near);
  // Rounding may have named the second nearest: count from the least, so that none is negative.
  near -= least_of(near.data(), near.size());
  return excess_;
}

TRAMMEL_WIDE void kernel_weights(const double* excess, Index count, double sigma, double* weights) {
  // Two divisions, since sigma^2 may underflow or overflow where excess / sigma / sigma has its
  // proper limit.
  const double inverse = 1 / sigma;
  for (Index i = 0; i < count; ++i)
    weights[i] = exponential(-0.5 * (excess[i] * inverse) * inverse);
}

double reach_of_kernel(double sigma) {
  return (1 - 2 * kLeastExponent) * sigma * sigma;
}

}  // namespace trammel::solver
