#pragma once

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

/// How probable each of several models is, given one row of printed numbers: their marginal
/// likelihoods, by Gaussian integrals (Kass and Raftery, J. Am. Stat. Assoc. 90, 1995).
namespace trammel::harness {

/// What a model predicts within one cell of its continuous unknowns, linear in them: logarithms of
/// the numbers, those of the row first and ascending, then further ones that are not printed.
struct PredictedCell {
  double weight = 0;            ///< prior probability within the model; they sum to 1
  Eigen::VectorXd log_numbers;  ///< in the middle; NaN: a further number that is not predicted
  Eigen::MatrixXd spread;       ///< a column an unknown: derivative times standard deviation
};

struct ModelReading {
  std::string title;
  double prior = 0;  ///< they sum to 1
  double noise = 0;  ///< relative standard deviation of each prediction, independent
  std::vector<PredictedCell> cells;
};

/// Positive numbers whose order means nothing but that they ascend. They are `size` of the first
/// `candidates` of a cell, each choice as probable as any other.
struct PrintedRow {
  Eigen::VectorXd log_numbers;
  Eigen::VectorXd digits;  ///< relative standard deviation by the printed digits
};

/// The unknowns and the row of one cell, given the row.
struct CellPosterior {
  std::size_t reading = 0, cell = 0;
  std::vector<Eigen::Index> chosen;  ///< which of the cell's numbers the row is
  double log_evidence = 0;           ///< prior of model, cell and choice included
  double probability = 0;            ///< of this cell and choice among all
};

/// Readings that the row could not tell apart: from the first, the most probable one, the others
/// differ by a Mahalanobis distance below 1 in the mean of their cells.
struct ReadingClass {
  std::vector<std::size_t> readings;
  double probability = 0;
};

struct ModelProbabilities {
  double log_evidence = 0;            ///< of the row, whatever the model [-]
  std::vector<double> probability;    ///< of each reading
  std::vector<ReadingClass> classes;  ///< most probable first
  std::vector<CellPosterior> cells;   ///< all that matter, most probable first

  /// How many leading classes hold that much of the probability.
  [[nodiscard]] std::size_t credible_count(double level) const;
  [[nodiscard]] double entropy_bits() const;
};

/// @param candidates   how many of a cell's numbers may stand in the row, unless it has fewer
/// @param discrepancy  relative standard deviation of what every model lacks, independent [-]
[[nodiscard]] ModelProbabilities model_probabilities(const std::vector<ModelReading>& readings,
                                                     const PrintedRow& row, Eigen::Index candidates,
                                                     double discrepancy);

/// What the model predicts once the row has set its unknowns (logarithms, of the chosen numbers).
[[nodiscard]] Eigen::VectorXd conditional_prediction(const std::vector<ModelReading>& readings,
                                                     const PrintedRow& row,
                                                     const CellPosterior& cell, double discrepancy);

/// By how many bits one further number is expected to lower the entropy of the classes; readings
/// that do not predict it are left out.
/// @param number  its place in `log_numbers`
/// @param resolution  relative standard deviation of the number as it would be printed
[[nodiscard]] double expected_information(const std::vector<ModelReading>& readings,
                                          const PrintedRow& row, const ModelProbabilities& found,
                                          Eigen::Index number, double discrepancy,
                                          double resolution);

/// A row as a reading would have it, with unknowns spread evenly over their cell.
[[nodiscard]] PrintedRow draw_row(const ModelReading& reading, const PrintedRow& like,
                                  Eigen::Index candidates, double discrepancy,
                                  std::mt19937_64& random);

}  // namespace trammel::harness
