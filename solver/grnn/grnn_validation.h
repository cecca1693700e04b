#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solver/grnn/grnn.h"

/// Choosing the smoothing of a GRNN by cross-validation.
namespace trammel::solver {

/// How samples go into folds. In a time series neighbours are nearly copies: folds that interleave
/// or shuffle measure interpolation, folds of consecutive blocks come nearer to extrapolation.
enum class FoldOrder { interleaved, shuffled, blocks };

struct CrossValidation {
  Index folds = 0;  ///< 0: leave one out
  FoldOrder order = FoldOrder::interleaved;
  std::uint64_t seed = 1;  ///< of `shuffled`
};

/// Fold of each sample, each fold as large as the others but for one; the same on every machine.
/// @throws ModelError  where there are fewer than two folds, or fewer samples than folds.
[[nodiscard]] std::vector<Index> fold_of_samples(Index samples, const CrossValidation& validation);

/// Which samples train a network when the others are held out.
enum class Split {
  first,        ///< the first ones in time, as in the paper: what is held out is extrapolated
  interleaved,  ///< spread evenly over all
  shuffled      ///< drawn with `seed`, the same on every machine
};

/// @return  for each sample whether it trains, `train` of them
/// @throws ModelError  unless 1 <= train <= samples.
[[nodiscard]] std::vector<bool> training_mask(Index samples, Index train, Split split,
                                              std::uint64_t seed = 1);

/// Root mean square of what the network without a sample's fold predicts wrongly for it, one row a
/// sigma: each output divided by its standard deviation over all samples (by 1 where constant), so
/// that the mean of all samples has an error near 1.
/// @return  one error for each sigma [-]
[[nodiscard]] Eigen::VectorXd cross_validation_error(const Grnn& network,
                                                     const Eigen::VectorXd& sigmas,
                                                     const CrossValidation& validation);

struct SigmaSearch {
  double sigma = 0;            ///< the refined one
  double error = 0;            ///< its cross-validation error [-]
  bool bracketed = false;      ///< false: the least error lies at an end of the grid
  Eigen::VectorXd grid;        ///< sigmas tried first, ascending
  Eigen::VectorXd grid_error;  ///< their errors
  Index evaluations = 0;       ///< sigmas tried in all
};

/// `count` sigmas spaced evenly in their logarithm.
[[nodiscard]] Eigen::VectorXd logarithmic_grid(double from, double to, Index count);
/// From a tenth of the median distance to the nearest other sample to the extent of all.
[[nodiscard]] Eigen::VectorXd default_grid(const Grnn& network, Index count = 41);

/// Grid search as in the paper, then golden-section search in log sigma between the neighbours of
/// the best grid point, to a relative width of 1e-4. Of equal errors the smaller sigma's
/// counts; the result is the least error seen, which is a local minimum where there are several.
/// @throws ModelError  where the grid does not ascend from a positive number, or as
///                     `fold_of_samples`.
[[nodiscard]] SigmaSearch search_sigma(const Grnn& network, const Eigen::VectorXd& grid,
                                       const CrossValidation& validation);

}  // namespace trammel::solver
