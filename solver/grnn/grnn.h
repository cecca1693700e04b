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

}  // namespace trammel::solver
