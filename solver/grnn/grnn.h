#pragma once

#include <Eigen/Core>

#include "solver/model/model.h"

/// General regression neural network (Specht 1991), the estimator of Nadaraya and Watson (1964).
namespace trammel::solver {

/// Rule for the scale by which each input is divided before distances are computed. A constant
/// input is divided by 1.
enum class InputScaling {
  none,
  deviation,  ///< standard deviation of the input over the samples
  range       ///< largest minus smallest value of the input
};

/// General regression neural network. The output Y at an input x is a weighted mean of the outputs
/// Y_i of all samples with inputs X_i. The smoothing parameter sigma is the only parameter to
/// train.
///
///   \f[ Y(x) = \sum_i Y_i w_i \Big/ \sum_i w_i, \quad w_i = e^{-D_i^2 / 2 \sigma^2}, \quad
///       D_i^2 = \sum_f ((x_f - X_{if}) / s_f)^2 \f]
///
/// with the scale s_f of input f. Source: Varalakshmi & Srinivas (2017), Eq. 36, 37.
struct Grnn {
  Eigen::MatrixXd inputs;   ///< inputs: one row per sample, one column per input
  Eigen::MatrixXd outputs;  ///< outputs: one row per sample, one column per output
  Eigen::VectorXd scale;    ///< divisor of each input, > 0, in the unit of the input
  double sigma = 1;         ///< smoothing parameter, a distance between scaled inputs [-]
};

/// Builds a network from samples. The scale of the inputs is computed by the rule `scaling`.
/// @throws ModelError  if there is no sample, inputs and outputs have different numbers of samples,
///   a value is not finite, or an input is too large to be squared.
[[nodiscard]] Grnn make_grnn(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs,
                             double sigma, InputScaling scaling = InputScaling::none);

/// Builds a network with a given scale of each input. If each scale is the kernel bandwidth of its
/// input, use sigma = 1.
[[nodiscard]] Grnn make_grnn(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs,
                             double sigma, const Eigen::VectorXd& scale);

/// Returns the sigma [-] that corresponds to the spread of MATLAB's newgrnn(P, T, spread). MATLAB
/// uses the weights exp(-(0.8326 D / spread)^2) at distance D. 0.8326 is sqrt(ln 2) to four digits,
/// so that the weight is one half at D = spread.
[[nodiscard]] double sigma_of_newgrnn_spread(double spread);

/// Returns the outputs of a network for queries (new inputs). The result is never 0/0, because
/// weights are relative to the weight of the nearest sample m. The weights follow from the
/// differences
///
///   D_i^2 - D_m^2 = sum_f (X_mf - X_if) ((x_f - X_if) + (x_f - X_mf)) / scale_f^2,
///
/// which remain accurate far from the samples. The limit for sigma -> 0 is the output of the
/// nearest sample, or the mean output of several nearest samples. The limit for sigma -> infinity
/// is the mean output of all samples.
/// @param network  samples, scale of each input, and smoothing parameter sigma.
/// @param queries  inputs of the queries: one row per query, one column per input.
/// @return         predicted outputs: one row per query, one column per output.
/// @throws ModelError  if a query is not finite or has the wrong number of inputs, or sigma is not
///   a positive normal number.
[[nodiscard]] Eigen::MatrixXd predict(const Grnn& network, const Eigen::MatrixXd& queries);

// Functions for the kernel weights of a general regression neural network, used by prediction and
// cross-validation.

/// Returns the scale of each input (column of the samples) by the rule `scaling`. The scale of a
/// constant input is 1.
[[nodiscard]] Eigen::VectorXd input_scales(const Eigen::MatrixXd& columns, InputScaling scaling);
/// Returns the inputs of all samples divided by the scales of the inputs [-]: one row per sample.
[[nodiscard]] inline Eigen::MatrixXd scaled_inputs(const Grnn& network) {
  return network.inputs * network.scale.cwiseInverse().asDiagonal();
}

/// Computes the excess D_i^2 - D_m^2 >= 0 of the squared distance between every sample i and a
/// query, where m is the sample nearest to the query.
class ExcessDistances {
 public:
  /// @param samples  scaled inputs, one row per sample; the matrix must outlive this object.
  explicit ExcessDistances(const Eigen::MatrixXd& samples)
      : samples_(samples), excess_(samples.rows()), last_(samples.rows()) {}

  /// Computes the excess D_i^2 - D_m^2 of every sample i for a query. D is the distance from the
  /// query, and m the nearest sample.
  /// @param query  scaled inputs of the query.
  /// @param excess_limit  limit above which the excess need not be exact: samples with a larger
  ///   excess may have any value of at least `excess_limit`.
  /// @param excluded  true for each sample to leave out, whose excess becomes infinite; null: none.
  const Eigen::ArrayXd& compute(const Eigen::Ref<const Eigen::VectorXd>& query, double excess_limit,
                                const Eigen::Array<bool, Eigen::Dynamic, 1>* excluded = nullptr);

  /// First index and end index of the range [first, end) of samples near the query of the last call
  /// of `compute`. The range contains all samples whose excess is below `excess_limit` of this
  /// call.
  [[nodiscard]] Index first_sample_in_reach() const { return first_; }
  [[nodiscard]] Index end_sample_in_reach() const { return last_; }

 private:
  const Eigen::MatrixXd& samples_;
  Eigen::ArrayXd excess_;
  Index first_ = 0, last_;
};

/// Computes the weights exp(-excess / 2 sigma^2) of `count` samples. The excess of a sample is its
/// squared distance from the query, minus that of the nearest sample. The weight of the nearest
/// sample is 1 for any sigma. All weights are at least e^-708, which is a normal number and
/// negligible compared with 1.
void kernel_weights(const double* excess, Index count, double sigma, double* weights);

/// Returns the excess (see `ExcessDistances`) above which the kernel weight of a sample is
/// negligible. The result is infinite if sigma^2 overflows.
[[nodiscard]] double kernel_cutoff_excess(double sigma);

}  // namespace trammel::solver
