#include "harness/analysis/model_probabilities.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "harness/base/find_or_add.h"

namespace trammel::harness {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNegligible = 1e-9;   ///< share of the probability that a cell may be forgotten at
constexpr double kBeyondDoubles = 60;  ///< logarithms below the best that change no sum
constexpr Index kMaxNumbers = 12;      ///< of a row and of a cell: no allocation for each cell
constexpr double kLogTwoPi = 1.8378770664093454;

/// Choices of `size` of the first `candidates` numbers, ascending.
std::vector<std::vector<Index>> choices_of(Index candidates, Index size) {
  std::vector<std::vector<Index>> found;
  std::vector<Index> chosen(static_cast<std::size_t>(size));
  std::iota(chosen.begin(), chosen.end(), 0);
  while (true) {
    found.push_back(chosen);
    Index place = size - 1;
    while (place >= 0 && chosen[place] == candidates - size + place) --place;
    if (place < 0) return found;
    for (Index next = chosen[place] + 1; place < size; ++place, ++next) chosen[place] = next;
  }
}

/// The numbers before the first that is not predicted, at most as many.
Index candidates_in(const PredictedCell& cell, Index candidates) {
  Index count = 0;
  while (count < std::min(candidates, cell.log_numbers.size()) &&
         std::isfinite(cell.log_numbers(count)))
    ++count;
  return count;
}

/// Mean and covariance of the row's logarithms in a cell.
struct Gaussian {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxNumbers, 1> mean;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxNumbers, kMaxNumbers> spread;
  Eigen::LLT<decltype(spread)> covariance;

  [[nodiscard]] double log_density(const VectorXd& x) const {
    decltype(mean) scaled = x - mean;
    covariance.matrixL().solveInPlace(scaled);
    return -0.5 * (scaled.squaredNorm() + static_cast<double>(x.size()) * kLogTwoPi) -
           covariance.matrixLLT().diagonal().array().log().sum();
  }
};

Gaussian gaussian_of(const PredictedCell& cell, const std::vector<Index>& chosen,
                     const VectorXd& variance) {
  Gaussian gaussian{cell.log_numbers(chosen), cell.spread(chosen, Eigen::all), {}};
  decltype(Gaussian::spread) covariance = gaussian.spread * gaussian.spread.transpose();
  covariance.diagonal() += variance;
  gaussian.covariance.compute(covariance);
  return gaussian;
}

VectorXd variance_of(const ModelReading& reading, const PrintedRow& row, double discrepancy) {
  return row.digits.array().square() + reading.noise * reading.noise + discrepancy * discrepancy;
}

Gaussian gaussian_of(const std::vector<ModelReading>& readings, const PrintedRow& row,
                     const CellPosterior& cell, double discrepancy) {
  const ModelReading& reading = readings[cell.reading];
  return gaussian_of(reading.cells[cell.cell], cell.chosen, variance_of(reading, row, discrepancy));
}

std::vector<CellPosterior> cell_posteriors(const std::vector<ModelReading>& readings,
                                           const PrintedRow& row, Index candidates,
                                           double discrepancy) {
  std::vector<CellPosterior> found;
  double best = -std::numeric_limits<double>::infinity();
  const Index size = row.log_numbers.size();
  for (std::size_t r = 0; r < readings.size(); ++r) {
    const VectorXd variance = variance_of(readings[r], row, discrepancy);
    for (std::size_t c = 0; c < readings[r].cells.size(); ++c) {
      const PredictedCell& cell = readings[r].cells[c];
      const Index available = candidates_in(cell, candidates);
      if (available < size) continue;  // it cannot be that row
      const auto choices = choices_of(available, size);
      const double prior = readings[r].prior * cell.weight / static_cast<double>(choices.size());
      for (const std::vector<Index>& chosen : choices) {
        const double evidence =
            std::log(prior) + gaussian_of(cell, chosen, variance).log_density(row.log_numbers);
        best = std::max(best, evidence);
        if (evidence > best - kBeyondDoubles) found.push_back({r, c, chosen, evidence, 0});
      }
    }
  }
  return found;
}

/// Turns evidence into probabilities. @returns the logarithm of the sum of evidence.
double normalize(std::vector<CellPosterior>& cells) {
  double largest = -std::numeric_limits<double>::infinity(), sum = 0;
  for (const CellPosterior& cell : cells) largest = std::max(largest, cell.log_evidence);
  for (const CellPosterior& cell : cells) sum += std::exp(cell.log_evidence - largest);
  for (CellPosterior& cell : cells) cell.probability = std::exp(cell.log_evidence - largest) / sum;
  return largest + std::log(sum);
}

/// Whether the rows of two readings with the same cells differ by less than the noise.
bool same_within_noise(const ModelReading& a, const ModelReading& b, Index size,
                       const VectorXd& variance) {
  if (a.cells.size() != b.cells.size() || a.noise != b.noise) return false;
  std::vector<Index> first(static_cast<std::size_t>(size));
  std::iota(first.begin(), first.end(), 0);
  double distance = 0;
  for (std::size_t c = 0; c < a.cells.size() && distance < 1; ++c) {
    if (candidates_in(a.cells[c], size) < size || candidates_in(b.cells[c], size) < size)
      return false;
    const Gaussian gaussian = gaussian_of(a.cells[c], first, variance);
    decltype(gaussian.mean) difference = b.cells[c].log_numbers(first) - gaussian.mean;
    gaussian.covariance.matrixL().solveInPlace(difference);
    distance += a.cells[c].weight * difference.squaredNorm();
  }
  return distance < 1;
}

std::vector<ReadingClass> classes_of(const std::vector<ModelReading>& readings,
                                     const std::vector<double>& probability, const PrintedRow& row,
                                     double discrepancy) {
  std::vector<std::size_t> order(readings.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return probability[a] > probability[b]; });
  std::vector<ReadingClass> classes;
  for (const std::size_t r : order) {
    const auto is_alike = [&](const ReadingClass& some) {
      const ModelReading& leader = readings[some.readings.front()];
      return same_within_noise(leader, readings[r], row.log_numbers.size(),
                               variance_of(leader, row, discrepancy));
    };
    ReadingClass& joined = find_or_add(classes, is_alike, {});
    joined.readings.push_back(r);
    joined.probability += probability[r];
  }
  std::ranges::stable_sort(classes, [](const ReadingClass& a, const ReadingClass& b) {
    return a.probability > b.probability;
  });
  return classes;
}

/// A number's mean and standard deviation in a cell, given the row.
struct NumberGivenRow {
  std::size_t owner;  ///< class
  double weight, mean, deviation;
};

double entropy(const std::vector<double>& probabilities) {
  double bits = 0;
  for (const double p : probabilities) bits -= p > 0 ? p * std::log2(p) : 0;
  return bits;
}

/// Integral over the number of its density times what is then not known of the classes.
double remaining_entropy(const std::vector<NumberGivenRow>& terms, std::size_t classes) {
  double low = 1e300, high = -1e300, least = 1e300;
  for (const NumberGivenRow& term : terms) {
    low = std::min(low, term.mean - 6 * term.deviation);
    high = std::max(high, term.mean + 6 * term.deviation);
    least = std::min(least, term.deviation);
  }
  const auto points = static_cast<int>(std::clamp((high - low) / (0.5 * least), 64.0, 4000.0));
  const double step = (high - low) / points;
  double sum = 0, total = 0;
  std::vector<double> density(classes);
  for (int i = 0; i <= points; ++i) {
    std::ranges::fill(density, 0);
    for (const NumberGivenRow& term : terms) {
      const double z = (low + i * step - term.mean) / term.deviation;
      if (std::abs(z) < 8)
        density[term.owner] += term.weight / term.deviation * std::exp(-z * z / 2);
    }
    const double all = std::accumulate(density.begin(), density.end(), 0.0);
    if (all <= 0) continue;
    for (double& share : density) share /= all;
    sum += all * entropy(density);
    total += all;
  }
  return total > 0 ? sum / total : 0;
}

}  // namespace

std::size_t ModelProbabilities::credible_count(double level) const {
  double sum = 0;
  std::size_t count = 0;
  while (count < classes.size() && sum < level) sum += classes[count++].probability;
  return count;
}

double ModelProbabilities::entropy_bits() const {
  std::vector<double> p;
  for (const ReadingClass& some : classes) p.push_back(some.probability);
  return entropy(p);
}

ModelProbabilities model_probabilities(const std::vector<ModelReading>& readings,
                                       const PrintedRow& row, Index candidates,
                                       double discrepancy) {
  ModelProbabilities found;
  found.probability.assign(readings.size(), 0);
  found.cells = cell_posteriors(readings, row, candidates, discrepancy);
  found.log_evidence = normalize(found.cells);
  for (const CellPosterior& cell : found.cells) found.probability[cell.reading] += cell.probability;
  std::erase_if(found.cells,
                [](const CellPosterior& cell) { return cell.probability < kNegligible; });
  std::ranges::stable_sort(found.cells, [](const CellPosterior& a, const CellPosterior& b) {
    return a.probability > b.probability;
  });
  found.classes = classes_of(readings, found.probability, row, discrepancy);
  return found;
}

VectorXd conditional_prediction(const std::vector<ModelReading>& readings, const PrintedRow& row,
                                const CellPosterior& cell, double discrepancy) {
  const Gaussian gaussian = gaussian_of(readings, row, cell, discrepancy);
  const VectorXd gain = gaussian.covariance.solve(row.log_numbers - gaussian.mean);
  return gaussian.mean + gaussian.spread * (gaussian.spread.transpose() * gain);
}

double expected_information(const std::vector<ModelReading>& readings, const PrintedRow& row,
                            const ModelProbabilities& found, Index number, double discrepancy,
                            double resolution) {
  std::vector<std::size_t> owner(readings.size());
  for (std::size_t k = 0; k < found.classes.size(); ++k)
    for (const std::size_t r : found.classes[k].readings) owner[r] = k;
  std::vector<NumberGivenRow> terms;
  std::vector<double> prior(found.classes.size(), 0);
  double known = 0;
  for (const CellPosterior& cell : found.cells) {
    const PredictedCell& predicted = readings[cell.reading].cells[cell.cell];
    if (predicted.log_numbers.size() <= number || !std::isfinite(predicted.log_numbers(number)))
      continue;
    const Gaussian gaussian = gaussian_of(readings, row, cell, discrepancy);
    const VectorXd own = predicted.spread.row(number).transpose();
    const VectorXd with_row = gaussian.spread * own;
    const VectorXd gain = gaussian.covariance.solve(with_row);
    const double variance =
        std::max(0.0, own.squaredNorm() - gain.dot(with_row)) + resolution * resolution;
    terms.push_back({owner[cell.reading], cell.probability,
                     predicted.log_numbers(number) + gain.dot(row.log_numbers - gaussian.mean),
                     std::sqrt(variance)});
    prior[owner[cell.reading]] += cell.probability;
    known += cell.probability;
  }
  if (terms.empty()) return 0;
  for (double& p : prior) p /= known;
  return std::max(0.0, entropy(prior) - remaining_entropy(terms, prior.size()));
}

PrintedRow draw_row(const ModelReading& reading, const PrintedRow& like, Index candidates,
                    double discrepancy, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> normal;
  double left = share(random);
  std::size_t c = 0;
  while (c + 1 < reading.cells.size() && left >= reading.cells[c].weight)
    left -= reading.cells[c++].weight;
  const PredictedCell& cell = reading.cells[c];
  const auto choices = choices_of(candidates_in(cell, candidates), like.log_numbers.size());
  const auto& chosen = choices[std::min(
      choices.size() - 1,
      static_cast<std::size_t>(share(random) * static_cast<double>(choices.size())))];
  VectorXd unknown(cell.spread.cols());
  for (double& u : unknown) u = std::sqrt(12.0) * (share(random) - 0.5);
  PrintedRow row = like;
  row.log_numbers = VectorXd(cell.log_numbers(chosen)) + cell.spread(chosen, Eigen::all) * unknown;
  const VectorXd deviation = variance_of(reading, like, discrepancy).cwiseSqrt();
  for (Index i = 0; i < deviation.size(); ++i) row.log_numbers(i) += deviation(i) * normal(random);
  std::ranges::sort(row.log_numbers);
  return row;
}

}  // namespace trammel::harness
