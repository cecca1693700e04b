#include "solver/grnn/grnn_validation.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>

#include "solver/grnn/grnn.h"

namespace trammel::solver {

namespace {

void validate_sigmas(const Eigen::VectorXd& sigmas) {
  require(sigmas.size() >= 1, "cross-validation requires at least one sigma");
  require(sigmas.allFinite() && (sigmas.array() >= std::numeric_limits<double>::min()).all(),
          "every sigma of a regression network (GRNN) must be a positive normal number");
}

/// Returns the sample indices 0, 1, ..., optionally in the random order of the Fisher-Yates
/// algorithm. std::shuffle is not used, because its result differs between standard libraries.
std::vector<Index> sample_order(Index samples, bool shuffled, std::uint64_t seed) {
  std::vector<Index> order(to_size(samples));
  std::iota(order.begin(), order.end(), Index{0});
  std::mt19937_64 random(seed);
  for (std::size_t i = order.size(); shuffled && i > 1; --i)
    std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

std::vector<Index> fold_of_samples(Index samples, const CrossValidation& validation) {
  const Index folds = validation.folds == 0 ? samples : validation.folds;
  require(folds >= 2, "cross-validation requires at least two folds");
  require(samples >= folds, "cross-validation requires at least one sample in each fold");
  auto fold = sample_order(samples, validation.order == FoldOrder::shuffled, validation.seed);
  const bool blocks = validation.order == FoldOrder::blocks;
  for (Index& p : fold) p = blocks ? p * folds / samples : p % folds;
  return fold;
}

std::vector<bool> training_mask(Index samples, Index count, Split split, std::uint64_t seed) {
  require(count >= 1 && count <= samples,
          "the number of training samples must be between 1 and the number of samples");
  const std::vector<Index> order = sample_order(samples, split == Split::shuffled, seed);
  std::vector<bool> trains(order.size(), false);
  for (Index k = 0; k < count; ++k) {
    // The k-th interleaved training sample is in the middle of the k-th of `count` equal intervals
    // of the sample indices.
    const Index rank = split == Split::interleaved ? (2 * k + 1) * samples / (2 * count) : k;
    trains[to_size(order[to_size(rank)])] = true;
  }
  return trains;
}

Eigen::VectorXd cross_validation_error(const Grnn& network, const Eigen::VectorXd& sigmas,
                                       const CrossValidation& validation) {
  validate_sigmas(sigmas);
  const Index n = network.inputs.rows();
  const std::vector<Index> fold = fold_of_samples(n, validation);
  const Eigen::Map<const Eigen::Array<Index, Eigen::Dynamic, 1>> folds(fold.data(), n);
  const Eigen::MatrixXd samples = scaled_inputs(network);
  const Eigen::RowVectorXd importance =
      input_scales(network.outputs, InputScaling::deviation).cwiseInverse();

  // Process samples in blocks. For each block, one matrix product multiplies the kernel weights by
  // the outputs and by a column of ones, which yields the sums of the weights.
  constexpr Index kBlock = 32;
  const Index columns = network.outputs.cols();
  Eigen::MatrixXd targets(n, columns + 1);
  targets << network.outputs, Eigen::VectorXd::Ones(n);
  ExcessDistances excess(samples);
  const double reach = kernel_cutoff_excess(sigmas.maxCoeff());
  Eigen::Array<bool, Eigen::Dynamic, 1> own(n);
  Eigen::ArrayXXd excesses(n, kBlock);
  Eigen::MatrixXd weights(n, kBlock), found(kBlock, columns + 1);
  Eigen::RowVectorXd miss(columns);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(sigmas.size());
  for (Index first = 0; first < n; first += kBlock) {
    const Index count = std::min(kBlock, n - first);
    for (Index k = 0; k < count; ++k) {
      own = folds == folds(first + k);
      excesses.col(k) = excess.compute(samples.row(first + k).transpose(), reach, &own);
    }
    for (Index s = 0; s < sigmas.size(); ++s) {
      kernel_weights(excesses.data(), n * count, sigmas(s), weights.data());
      found.topRows(count).noalias() = weights.leftCols(count).transpose() * targets;
      for (Index k = 0; k < count; ++k) {
        miss = found.row(k).head(columns) / found(k, columns) - network.outputs.row(first + k);
        sum(s) += miss.cwiseProduct(importance).squaredNorm();
      }
    }
  }
  return (sum / static_cast<double>(n * network.outputs.cols())).cwiseSqrt();
}

Eigen::VectorXd logarithmic_grid(double from, double to, Index count) {
  require(from > 0 && to > from && std::isfinite(to), "a grid of sigmas requires 0 < from < to");
  require(count >= 3, "a grid of sigmas requires at least three sigmas");
  return Eigen::VectorXd::LinSpaced(count, std::log(from), std::log(to)).array().exp().matrix();
}

Eigen::VectorXd default_sigma_grid(const Grnn& network, Index count) {
  const Eigen::MatrixXd samples = scaled_inputs(network);
  const double extent = (samples.colwise().maxCoeff() - samples.colwise().minCoeff()).norm();
  if (extent == 0) return logarithmic_grid(0.1, 10, count);  // all samples coincide
  std::vector<double> nearest;
  for (Index i = 0; i < samples.rows(); ++i) {
    double min_distance = extent;
    for (Index j = 0; j < samples.rows(); ++j) {
      const double distance = (samples.row(i) - samples.row(j)).norm();
      if (distance > 0) min_distance = std::min(min_distance, distance);
    }
    nearest.push_back(min_distance);
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return logarithmic_grid(*middle / 10, extent, count);
}

SigmaSearch search_sigma(const Grnn& network, const Eigen::VectorXd& grid,
                         const CrossValidation& validation) {
  validate_sigmas(grid);
  require(std::ranges::is_sorted(grid, std::less_equal()), "a grid of sigmas must be ascending");
  SigmaSearch search;
  search.grid = grid;
  search.grid_error = cross_validation_error(network, grid, validation);
  search.evaluations = grid.size();
  Index best = 0;
  search.error = search.grid_error.minCoeff(&best);
  search.sigma = grid(best);
  search.bracketed = best > 0 && best + 1 < grid.size();
  if (!search.bracketed) return search;

  const double middle = grid(best);
  const auto error_at = [&](double log_ratio) {
    ++search.evaluations;
    const double sigma = middle * std::exp(log_ratio);
    const double error =
        cross_validation_error(network, Eigen::VectorXd::Constant(1, sigma), validation)(0);
    if (error < search.error) {
      search.error = error;
      search.sigma = sigma;
    }
    return error;
  };
  // Search the logarithm of sigma relative to the middle of the bracket, so that the unit of the
  // inputs does not matter. 12 bits determine sigma with a relative error below 1e-3.
  constexpr int kBits = 12;
  std::uintmax_t evaluations = 100;
  boost::math::tools::brent_find_minima(error_at, std::log(grid(best - 1) / middle),
                                        std::log(grid(best + 1) / middle), kBits, evaluations);
  return search;
}

}  // namespace trammel::solver
