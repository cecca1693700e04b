#pragma once

#include <Eigen/Core>

#include "solver/grnn/grnn.h"

/// The kernel weights of a GRNN, shared by prediction and cross-validation.
namespace trammel::solver {

/// What each column is divided by; 1 where it is constant.
[[nodiscard]] Eigen::VectorXd scale_of(const Eigen::MatrixXd& columns, InputScaling scaling);
/// Sample x input, in scaled distances.
[[nodiscard]] inline Eigen::MatrixXd scaled_inputs(const Grnn& network) {
  return network.inputs * network.scale.cwiseInverse().asDiagonal();
}

/// D_i^2 - D_m^2 >= 0 of every sample to a query, m the nearest sample.
class ExcessDistances {
 public:
  /// @param samples  sample x input, scaled; must outlive this object
  explicit ExcessDistances(const Eigen::MatrixXd& samples)
      : samples_(samples), excess_(samples.rows()), last_(samples.rows()) {}

  /// @param query  scaled
  /// @param reach  of what lies further only an excess that is at least as large need be told
  /// @param skip   samples to leave out (their excess is infinite), or null
  const Eigen::ArrayXd& compute(const Eigen::Ref<const Eigen::VectorXd>& query, double reach,
                                const Eigen::Array<bool, Eigen::Dynamic, 1>* skip = nullptr);

  /// Samples [first, last) hold all within reach of the last query.
  [[nodiscard]] Index first() const { return first_; }
  [[nodiscard]] Index last() const { return last_; }

 private:
  const Eigen::MatrixXd& samples_;
  Eigen::ArrayXd excess_;
  Index first_ = 0, last_;
};

/// exp(-excess / 2 sigma^2): 1 for the nearest, whatever sigma; at least e^-708, which is a normal
/// number and nothing beside 1.
/// @param excess   [count]
/// @param weights  [count]
void kernel_weights(const double* excess, Index count, double sigma, double* weights);

/// The excess from which on a weight is nothing; infinite where sigma^2 overflows.
[[nodiscard]] double reach_of_kernel(double sigma);

}  // namespace trammel::solver
