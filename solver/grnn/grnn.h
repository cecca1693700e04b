#pragma once

#include <Eigen/Core>

#include "solver/model/model.h"

/// General regression neural network (Specht 1991; the estimator of Nadaraya and Watson 1964).
namespace trammel::solver {

/// What an input is divided by before distances are taken. A constant input is divided by 1.
enum class InputScaling {
  none,
  deviation,  ///< its standard deviation over the samples
  range       ///< its largest less its smallest value
};

/// The samples are the network: there is nothing else to train but sigma.
///   Y(x) = sum_i Y_i w_i / sum_i w_i,  w_i = exp(-D_i^2 / 2 sigma^2)   (paper Eq. 36),
///   D_i^2 = sum_f ((x_f - X_if) / scale_f)^2                            (paper Eq. 37)
struct Grnn {
  Eigen::MatrixXd inputs;   ///< sample x input
  Eigen::MatrixXd outputs;  ///< sample x output
  Eigen::VectorXd scale;    ///< of each input, > 0, in its unit
  double sigma = 1;         ///< smoothing, in scaled distance [-]
};

/// @param inputs   sample x input
/// @param outputs  sample x output
/// @throws ModelError  where there is no sample, the numbers of samples differ, or a number is not
///                     finite or too large to be squared.
[[nodiscard]] Grnn make_grnn(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs,
                             double sigma, InputScaling scaling = InputScaling::none);

/// The same with a bandwidth for each input as its scale: an isotropic network has sigma = 1 then.
[[nodiscard]] Grnn make_grnn(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs,
                             double sigma, const Eigen::VectorXd& scale);

/// sigma of MATLAB's newgrnn(P, T, spread), which has exp(-(0.8326 D / spread)^2): 0.8326 is
/// sqrt(ln 2) to four digits, so that the weight is one half at D = spread.
[[nodiscard]] double sigma_of_spread(double spread);

/// Never 0/0: the weights are relative to the nearest sample's, from the differences
///   D_i^2 - D_m^2 = sum_f (X_mf - X_if) ((x_f - X_if) + (x_f - X_mf)) / scale_f^2,
/// which keep their digits far from the samples, too. As sigma -> 0 it is the nearest sample (the
/// mean of those at the same distance), as sigma -> infinity the mean of all.
/// @param queries  query x input
/// @return         query x output
/// @throws ModelError  where a query is not finite or has the wrong number of inputs, or sigma is
///                     not a positive normal number.
[[nodiscard]] Eigen::MatrixXd predict(const Grnn& network, const Eigen::MatrixXd& queries);

// The kernel weights of a GRNN, shared by prediction and cross-validation.

/// The divisor of each column; 1 for a constant one.
[[nodiscard]] Eigen::VectorXd scale_of(const Eigen::MatrixXd& columns, InputScaling scaling);
/// The inputs in scaled distances, sample x input.
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
