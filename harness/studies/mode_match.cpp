#include "harness/studies/mode_match.h"

#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <tuple>

#include "harness/analysis/case_effects.h"
#include "harness/scene/case_model.h"
#include "harness/scene/drawing.h"
#include "harness/scene/rethrow_as_input.h"
#include "solver/linear/modes.h"

namespace trammel::harness {
namespace {

/// Displacement of a point in each mode, by the name of the point.
using Places = std::map<std::string, std::vector<Eigen::Vector2d>>;

/// Number of modes computed in addition to the requested modes. They complete the last set of equal
/// frequencies.
constexpr solver::Index kExtraModes = 4;
constexpr int kStations = 8;
/// Relative distance below which adjacent frequencies form one set.
constexpr double kRepeatedTolerance = 1e-6;
/// Overlap (squared cosine between shapes) below which two sets of modes do not match.
constexpr double kMinOverlap = 0.5;

void sample_nodes(const solver::System& system, const Eigen::VectorXd& u, Places& places) {
  for (std::size_t i = 0; i < system.model.nodes.size(); ++i) {
    const std::string& name = system.model.nodes[i].name;
    if (name.empty()) continue;
    const auto& coordinates = system.coordinates.node[i];
    places["node " + name].emplace_back(u[coordinates[0]], u[coordinates[1]]);
  }
}

void sample_members(const solver::System& system, const Eigen::VectorXd& u, Places& places) {
  std::size_t first = 0;
  for (const solver::Member& member : system.model.members) {
    const auto count = static_cast<std::size_t>(member.elements);
    for (int k = 1; k < kStations; ++k) {
      const double along = static_cast<double>(k) / kStations * static_cast<double>(count);
      const std::size_t element = std::min(count - 1, static_cast<std::size_t>(along));
      places["member " + member.name + " " + std::to_string(k)].push_back(displacement_at_fraction(
          system.mesh.frame[first + element], u, along - static_cast<double>(element)));
    }
    first += count;
  }
}

std::pair<std::vector<double>, Places> solve_and_sample(const Document& document) {
  const JsonView analysis = JsonView(document)["analysis"];
  if (!analysis.has("modes")) throw analysis.error("mode shapes require the analysis 'modes'");
  CaseModel case_model = read_case_model(document);
  case_model.effects = choose_effects(document, case_model).chosen;
  const solver::System system = solver::assemble(build_model(case_model, 0), case_model.effects);
  solver::ModesOptions options;
  options.count =
      std::min(system.K.rows(), analysis["modes"]["count"].get<solver::Index>() + kExtraModes);
  const solver::ModalSolution modes = solver::solve_modes(system, options);
  if (!modes.outcome.solved())
    throw analysis.error("the modes could not be computed: " + modes.outcome.reason);
  std::pair<std::vector<double>, Places> seen;
  for (solver::Index i = 0; i < modes.frequency.size(); ++i) {
    seen.first.push_back(modes.frequency[i]);
    const Eigen::VectorXd u = system.T * modes.shape.col(i);
    sample_nodes(system, u, seen.second);
    sample_members(system, u, seen.second);
  }
  return seen;
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

std::pair<SampledModes, SampledModes> sample_modes(const Document& a, const Document& b) {
  const auto located = [](const Document& document) {
    return rethrow_as_input_error(document, [&] { return solve_and_sample(document); });
  };
  const auto [frequency_a, places_a] = located(a);
  const auto [frequency_b, places_b] = located(b);
  std::vector<std::string> common;
  for (const auto& item : places_a)
    if (places_b.count(item.first) > 0) common.push_back(item.first);
  const auto collect = [&](const std::vector<double>& frequency, const Places& places) {
    SampledModes modes{frequency, Eigen::MatrixXd(2 * static_cast<solver::Index>(common.size()),
                                                  static_cast<solver::Index>(frequency.size()))};
    for (std::size_t p = 0; p < common.size(); ++p) {
      const std::vector<Eigen::Vector2d>& at = places.at(common[p]);
      for (std::size_t m = 0; m < at.size(); ++m)
        modes.shape.block<2, 1>(2 * static_cast<solver::Index>(p), static_cast<solver::Index>(m)) =
            at[m];
    }
    return modes;
  };
  return {collect(frequency_a, places_a), collect(frequency_b, places_b)};
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
