#include "harness/studies/mode_match.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "solver/model/model.h"

namespace trammel::harness {
namespace {

/// Relative distance below which adjacent frequencies form one set.
constexpr double kRepeatedTolerance = 1e-6;
/// Overlap (squared cosine between shapes) below which two sets of modes do not match.
constexpr double kMinOverlap = 0.5;

/// Returns pairs of indices of common points of two drawings.
std::vector<std::pair<std::size_t, std::size_t>> common_points(
    const std::vector<results::Point>& a, const std::vector<results::Point>& b) {
  std::vector<std::pair<std::size_t, std::size_t>> common;
  double size = 0;
  for (const auto& [x, y] : a) size = std::max({size, std::abs(x), std::abs(y)});
  std::map<std::pair<long, long>, std::size_t> place_of;
  const auto key = [&](const results::Point& p) {
    return std::pair(std::lround(1e8 * p.first / size), std::lround(1e8 * p.second / size));
  };
  for (std::size_t j = 0; j < b.size(); ++j) place_of.emplace(key(b[j]), j);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto found = place_of.find(key(a[i]));
    if (found != place_of.end()) common.emplace_back(i, found->second);
  }
  if (a.size() != b.size() || 2 * common.size() >= a.size()) return common;
  common.clear();
  for (std::size_t i = 0; i < a.size(); ++i) common.emplace_back(i, i);
  return common;
}

SampledModes sampled(const std::vector<double>& frequency,
                     const std::vector<results::Shape>& shapes,
                     const std::vector<std::size_t>& points) {
  std::size_t count = std::min(shapes.size(), frequency.size());
  while (count > 0 && count < frequency.size() &&
         frequency[count] - frequency[count - 1] <= kRepeatedTolerance * frequency[count])
    --count;
  SampledModes modes;
  modes.frequency.assign(frequency.begin(), frequency.begin() + static_cast<std::ptrdiff_t>(count));
  modes.shape.resize(2 * std::ssize(points), static_cast<solver::Index>(count));
  for (std::size_t m = 0; m < count; ++m)
    for (std::size_t n = 0; n < points.size(); ++n) {
      const auto& [x, y] = shapes[m].displacement.at(points[n]);
      const auto row = 2 * static_cast<solver::Index>(n), column = static_cast<solver::Index>(m);
      modes.shape(row, column) = std::isfinite(x) ? x : 0;
      modes.shape(row + 1, column) = std::isfinite(y) ? y : 0;
    }
  return modes;
}

std::vector<std::vector<std::size_t>> sets_of(const std::vector<double>& frequency) {
  std::vector<std::vector<std::size_t>> sets;
  for (std::size_t i = 0; i < frequency.size(); ++i) {
    const bool same = i > 0 && frequency[i] - frequency[i - 1] <= kRepeatedTolerance * frequency[i];
    if (!same) sets.emplace_back();
    sets.back().push_back(i);
  }
  return sets;
}

/// Returns an orthonormal basis of the mode shapes of a set.
Eigen::MatrixXd basis(const SampledModes& modes, const std::vector<std::size_t>& set) {
  Eigen::MatrixXd shapes(modes.shape.rows(), static_cast<solver::Index>(set.size()));
  for (std::size_t k = 0; k < set.size(); ++k) {
    const auto column = static_cast<solver::Index>(k);
    shapes.col(column) = modes.shape.col(static_cast<solver::Index>(set[k]));
    const double norm = shapes.col(column).norm();
    if (norm > 0) shapes.col(column) /= norm;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(shapes);
  return qr.householderQ() * Eigen::MatrixXd::Identity(shapes.rows(), qr.rank());
}

}  // namespace

std::pair<SampledModes, SampledModes> sample_modes(const std::vector<double>& frequency_a,
                                                   const results::Drawing& a,
                                                   const std::vector<double>& frequency_b,
                                                   const results::Drawing& b) {
  std::vector<std::size_t> in_a, in_b;
  for (const auto& [i, j] : common_points(a.nodes, b.nodes)) {
    in_a.push_back(i);
    in_b.push_back(j);
  }
  return {sampled(frequency_a, a.shapes, in_a), sampled(frequency_b, b.shapes, in_b)};
}

std::vector<ModeMatch> match_modes(const SampledModes& a, const SampledModes& b) {
  const auto sets_a = sets_of(a.frequency), sets_b = sets_of(b.frequency);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < sets_a.size(); ++i) {
    const Eigen::MatrixXd basis_a = basis(a, sets_a[i]);
    for (std::size_t j = 0; j < sets_b.size(); ++j) {
      const Eigen::MatrixXd basis_b = basis(b, sets_b[j]);
      const auto smaller = std::min(basis_a.cols(), basis_b.cols());
      const double overlap = smaller == 0 ? 0
                                          : (basis_a.transpose() * basis_b).squaredNorm() /
                                                static_cast<double>(smaller);
      pairs.emplace_back(overlap, i, j);
    }
  }
  // The most similar pairs of sets come first. Pairs with equal overlap remain in the order of
  // frequencies.
  std::ranges::stable_sort(
      pairs, [](const auto& x, const auto& y) { return std::get<0>(x) > std::get<0>(y); });
  std::vector<ModeMatch> matches;
  // A set of n modes can match n modes of the other model. If asymmetry splits a repeated frequency
  // of the other model, both split modes match the set of the repeated frequency.
  std::vector<std::size_t> room_a, room_b;
  for (const auto& set : sets_a) {
    matches.push_back({set, {}, 0});
    room_a.push_back(set.size());
  }
  for (const auto& set : sets_b) room_b.push_back(set.size());
  for (const auto& [overlap, i, j] : pairs) {
    const std::size_t taken = std::min(room_a[i], room_b[j]);
    if (overlap < kMinOverlap || taken == 0) continue;
    room_a[i] -= taken;
    room_b[j] -= taken;
    ModeMatch& match = matches[i];
    match.overlap = match.b.empty() ? overlap : std::min(match.overlap, overlap);
    match.b.insert(match.b.end(), sets_b[j].begin(), sets_b[j].end());
    std::ranges::sort(match.b);
  }
  return matches;
}

}  // namespace trammel::harness
