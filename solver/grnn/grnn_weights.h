#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

/// The kernel weights of a GRNN, shared by prediction and cross-validation.
namespace trammel::solver {

/// D_i^2 - D_m^2 >= 0 of every sample to a query, m the nearest sample.
class ExcessDistances {
 public:
  /// @param samples  sample x input, scaled; must outlive this object
  explicit ExcessDistances(const Eigen::MatrixXd& samples)
      : samples_(samples), squared_(samples.rows()), excess_(samples.rows()) {}

  /// @param query  scaled
  /// @param skip   samples to leave out (their excess is infinite), or null
  const Eigen::ArrayXd& compute(const Eigen::Ref<const Eigen::VectorXd>& query,
                                const Eigen::Array<bool, Eigen::Dynamic, 1>* skip = nullptr) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    squared_ = (query(0) - samples_.col(0).array()).square();
    for (Eigen::Index f = 1; f < samples_.cols(); ++f)
      squared_ += (query(f) - samples_.col(f).array()).square();
    if (skip) squared_ = skip->select(kInfinity, squared_);
    const double* const first = squared_.data();
    const Eigen::Index nearest =
        std::min(std::find(first, first + squared_.size(), squared_.minCoeff()) - first,
                 squared_.size() - 1);
    excess_.setZero();
    for (Eigen::Index f = 0; f < samples_.cols(); ++f) {
      const double x = query(f);
      const double m = samples_(nearest, f);
      excess_ += (m - samples_.col(f).array()) * ((x - samples_.col(f).array()) + (x - m));
    }
    if (skip) excess_ = skip->select(kInfinity, excess_);
    // Rounding may have named the second nearest: count from the least, so that none is negative.
    excess_ -= excess_.minCoeff();
    return excess_;
  }

 private:
  const Eigen::MatrixXd& samples_;
  Eigen::ArrayXd squared_;
  Eigen::ArrayXd excess_;
};

/// exp(-excess / 2 sigma^2): 1 for the nearest, whatever sigma. Two divisions, since sigma^2 may
/// underflow or overflow where excess / sigma / sigma has its proper limit.
template <class In, class Out>
void kernel_weights(const In& excess, double sigma, Out&& weights) {
  const double inverse = 1 / sigma;
  weights = (-0.5 * (excess * inverse) * inverse).exp().matrix();
}

}  // namespace trammel::solver
