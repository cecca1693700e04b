#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solver/grnn/grnn.h"

/// Choice of the smoothing parameter sigma of a general regression neural network (GRNN) by
/// cross-validation.
namespace trammel::solver {

/// Rule by which samples are assigned to the folds of a cross-validation. Successive samples of a
/// time series are nearly equal. Interleaved or shuffled folds therefore measure the error of
/// interpolation. Folds of consecutive blocks measure an error closer to that of extrapolation.
enum class FoldOrder { interleaved, shuffled, blocks };

/// Options of a cross-validation.
struct CrossValidation {
  Index folds = 0;  ///< number of folds; 0: leave-one-out, one fold per sample
  FoldOrder order = FoldOrder::interleaved;
  std::uint64_t seed = 1;  ///< seed of the random order `shuffled`
};

/// Returns the index of the fold of each sample. The sizes of the folds differ by at most one. The
/// result is the same on every machine.
/// @throws ModelError  if there are fewer than two folds, or fewer samples than folds.
[[nodiscard]] std::vector<Index> fold_of_samples(Index samples, const CrossValidation& validation);

/// Choice of the samples that train a network. The other samples are held out for testing.
enum class Split {
  /// The first samples in time train the network, as in Varalakshmi & Srinivas (2017). The held-out
  /// samples require extrapolation.
  first,
  interleaved,  ///< training samples are spread evenly over all samples
  shuffled      ///< training samples are drawn at random with `seed`, the same on every machine
};

/// Selects the training samples.
/// @return  for each sample: true if it is one of the `count` training samples.
/// @throws ModelError  unless 1 <= count <= samples.
[[nodiscard]] std::vector<bool> training_mask(Index samples, Index count, Split split,
                                              std::uint64_t seed = 1);

/// Returns the root mean square of the prediction errors. The network predicts each sample without
/// the samples of its fold. Each output is divided by its standard deviation over all samples, or
/// by 1 if it is constant. The error of a prediction by the mean of all samples is therefore near
/// 1.
/// @return  one error for each sigma [-].
[[nodiscard]] Eigen::VectorXd cross_validation_error(const Grnn& network,
                                                     const Eigen::VectorXd& sigmas,
                                                     const CrossValidation& validation);

/// Result of a search for the smoothing parameter sigma.
struct SigmaSearch {
  double sigma = 0;  ///< sigma with the least cross-validation error [-]
  double error = 0;  ///< cross-validation error of `sigma` [-]
  /// false: the least error is at an end of the grid of sigmas and is not refined.
  bool bracketed = false;
  Eigen::VectorXd grid;        ///< sigmas of the grid, ascending
  Eigen::VectorXd grid_error;  ///< cross-validation errors on the grid [-]
  Index evaluations = 0;       ///< total number of sigmas evaluated
};

/// Returns `count` numbers between `from` and `to` whose logarithms have equal distances.
[[nodiscard]] Eigen::VectorXd logarithmic_grid(double from, double to, Index count);
/// Returns trial values of the smoothing parameter sigma, from a tenth of the median
/// nearest-neighbor distance to the extent of all samples.
[[nodiscard]] Eigen::VectorXd default_sigma_grid(const Grnn& network, Index count = 41);

/// Searches the smoothing parameter sigma with the least cross-validation error. A grid search as
/// in Varalakshmi & Srinivas (2017) is followed by Brent's method in log sigma between the
/// neighbors of the best grid point. If errors are equal on the grid, the smaller sigma is
/// selected. The result has the least error of all evaluations. It may be a local minimum if there
/// are several minima.
/// @throws ModelError  if the grid is not ascending and positive, or if `fold_of_samples` throws.
[[nodiscard]] SigmaSearch search_sigma(const Grnn& network, const Eigen::VectorXd& grid,
                                       const CrossValidation& validation);

}  // namespace trammel::solver
