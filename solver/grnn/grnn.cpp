#include "solver/grnn/grnn.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::solver {

Eigen::VectorXd input_scales(const Eigen::MatrixXd& inputs, InputScaling scaling) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(inputs.cols());
  if (scaling == InputScaling::none) return scale;
  for (Index f = 0; f < inputs.cols(); ++f) {
    const Eigen::VectorXd column = inputs.col(f);
    const double range = column.maxCoeff() - column.minCoeff();
    if (range == 0) continue;  // constant input, whose deviation is only round-off
    const double deviation = std::sqrt((column.array() - column.mean()).square().mean());
    scale(f) = scaling == InputScaling::range ? range : deviation;
  }
  return scale;
}

namespace {

bool squarable(const Eigen::MatrixXd& m) {
  return m.allFinite() && (m.size() == 0 || m.cwiseAbs().maxCoeff() < 1e150);
}

}  // namespace

Grnn make_grnn(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs, double sigma,
               const Eigen::VectorXd& scale) {
  require(inputs.rows() >= 1, "a regression network (GRNN) requires at least one sample");
  require(inputs.rows() == outputs.rows(), "a network requires one output row for each input row");
  require(inputs.cols() >= 1 && outputs.cols() >= 1, "a network requires an input and an output");
  require(outputs.allFinite(), "an output of a regression network (GRNN) sample is not finite");
  require(scale.size() == inputs.cols(), "a regression network requires one scale per input");
  require(scale.allFinite() && (scale.array() > 0).all(),
          "the scale of each input of a regression network (GRNN) must be positive");
  require(squarable(inputs * scale.cwiseInverse().asDiagonal()),
          "a scaled input of a network sample is not finite or too large to be squared");
  return {inputs, outputs, scale, sigma};
}

Grnn make_grnn(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs, double sigma,
               InputScaling scaling) {
  require(inputs.rows() >= 1, "a regression network (GRNN) requires at least one sample");
  require(squarable(inputs), "a network input is not finite or too large to be squared");
  return make_grnn(inputs, outputs, sigma, input_scales(inputs, scaling));
}

double sigma_of_newgrnn_spread(double spread) {
  return spread / (std::sqrt(2.0) * 0.8326);
}

Eigen::MatrixXd predict(const Grnn& network, const Eigen::MatrixXd& queries) {
  require(queries.cols() == network.inputs.cols(), "a network query requires one value per input");
  require(network.sigma >= std::numeric_limits<double>::min() && std::isfinite(network.sigma),
          "the sigma of a regression network (GRNN) must be a positive normal number");
  const Eigen::MatrixXd samples = scaled_inputs(network);
  const Eigen::MatrixXd scaled =
      network.scale.cwiseInverse().asDiagonal() * queries.transpose();  // one column per query
  require(squarable(scaled), "a scaled input of a query is not finite or too large to be squared");

  // Process queries in blocks. For each block, one matrix product multiplies the kernel weights by
  // the outputs of the samples and by a column of ones, which yields the sums of the weights. The
  // product omits samples before the first and after the last sample with a relevant weight.
  constexpr Index kBlock = 32;
  const Index columns = network.outputs.cols();
  Eigen::MatrixXd targets(samples.rows(), columns + 1);
  targets << network.outputs, Eigen::VectorXd::Ones(samples.rows());
  Eigen::MatrixXd result(queries.rows(), columns), found(kBlock, columns + 1);
  Eigen::MatrixXd weights(samples.rows(), kBlock);
  ExcessDistances excess(samples);
  const double reach = kernel_cutoff_excess(network.sigma);
  for (Index begin = 0; begin < queries.rows(); begin += kBlock) {
    const Index count = std::min(kBlock, queries.rows() - begin);
    Index first = samples.rows(), last = 0;
    weights.leftCols(count).setZero();
    for (Index k = 0; k < count; ++k) {
      const Eigen::ArrayXd& e = excess.compute(scaled.col(begin + k), reach);
      first = std::min(first, excess.first_sample_in_reach());
      last = std::max(last, excess.end_sample_in_reach());
      kernel_weights(&e(excess.first_sample_in_reach()),
                     excess.end_sample_in_reach() - excess.first_sample_in_reach(), network.sigma,
                     &weights(excess.first_sample_in_reach(), k));
    }
    found.topRows(count).noalias() = weights.block(first, 0, last - first, count).transpose() *
                                     targets.middleRows(first, last - first);
    result.middleRows(begin, count) = found.topLeftCorner(count, columns).array().colwise() /
                                      found.col(columns).head(count).array();
  }
  return result;
}

namespace {

// Least integer x for which exp(x) is a normal floating-point number.
constexpr double kLeastExponent = -708;

}  // namespace

const Eigen::ArrayXd& ExcessDistances::compute(
    const Eigen::Ref<const Eigen::VectorXd>& query, double excess_limit,
    const Eigen::Array<bool, Eigen::Dynamic, 1>* excluded) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Relative margin larger than the round-off error of a sum of squares of a thousand inputs.
  constexpr double kRounding = 1e-12;
  const Index count = samples_.rows();
  excess_ = (query(0) - samples_.col(0).array()).square();
  for (Index f = 1; f < samples_.cols(); ++f)
    excess_ += (query(f) - samples_.col(f).array()).square();
  if (excluded) excess_ = excluded->select(kInfinity, excess_);
  const double least = excess_.minCoeff();
  const double* const begin = excess_.data();
  const Index nearest = std::min(std::find(begin, begin + count, least) - begin, count - 1);
  const double limit = (least + excess_limit) * (1 + kRounding);
  for (first_ = 0; first_ < nearest && !(excess_(first_) <= limit);) ++first_;
  for (last_ = count; last_ > nearest + 1 && !(excess_(last_ - 1) <= limit);) --last_;

  // For samples i outside the index range [first_, last_), `excess_` remains the squared distance
  // D_i^2. This value is at least the exact excess D_i^2 - D_m^2, where m is the nearest sample.
  auto near = excess_.segment(first_, last_ - first_);
  near.setZero();
  for (Index f = 0; f < samples_.cols(); ++f) {
    const double x = query(f), m = samples_(nearest, f);
    const auto s = samples_.col(f).segment(first_, near.size()).array();
    near += (m - s) * ((x - s) + (x - m));
  }
  if (excluded) near = excluded->segment(first_, near.size()).select(kInfinity, near);
  // Because of round-off, `nearest` may be the second nearest sample. Subtract the minimum, so that
  // no difference of squared distances is negative.
  near -= near.minCoeff();
  return excess_;
}

void kernel_weights(const double* excess, Index count, double sigma, double* weights) {
  // Divide the excess by sigma twice, because sigma^2 may underflow or overflow although excess /
  // sigma / sigma is representable.
  const double inverse = 1 / sigma;
  const Eigen::Map<const Eigen::ArrayXd> e(excess, count);
  Eigen::Map<Eigen::ArrayXd>(weights, count) =
      (-0.5 * (e * inverse) * inverse).max(kLeastExponent).exp();
}

double kernel_cutoff_excess(double sigma) {
  return -2 * kLeastExponent * sigma * sigma;
}

}  // namespace trammel::solver
