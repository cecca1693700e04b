#include "solver/statics/describe_mechanism.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "solver/assembly/length_scales.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMaxEntries = 3;  // of one mode
constexpr Index kMaxMotions = 6;
/// Entries below this share of the largest are round-off, and so are differences of equal ones.
constexpr double kRoundoff = 1e-6;

using NamedRows = std::vector<std::pair<std::string, Index>>;

/// The coordinates that have a name, and their rows of u.
NamedRows named_rows(const System& system) {
  const Model& model = system.model;
  NamedRows rows;
  const auto add = [&rows](const std::string& name, Index row) {
    if (row >= 0) rows.emplace_back(name, row);
  };
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const std::string node = "node " + model.nodes[i].name;
    const std::array<Index, 3>& of_node = system.coordinates.node[i];
    add(node + " along x", of_node[0]);
    add(node + " along y", of_node[1]);
    add("rotation of " + node, of_node[2]);
  }
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const std::array<Index, 2>& ends = system.coordinates.member_end[i];
    add("rotation of the start of member " + model.members[i].name, ends[0]);
    add("rotation of the end of member " + model.members[i].name, ends[1]);
  }
  return rows;
}

/// The first of the largest entries, but for round-off.
Index first_largest(const VectorXd& x) {
  const double enough = (1 - kRoundoff) * x.cwiseAbs().maxCoeff();
  Index i = 0;
  while (std::abs(x[i]) < enough) ++i;
  return i;
}

/// Reduced echelon form of the columns: each has 1 where the others have 0.
void reduce(MatrixXd& U) {
  for (Index j = 0; j < U.cols(); ++j) {
    const Index pivot = first_largest(U.col(j));
    if (U(pivot, j) == 0) continue;
    U.col(j) /= U(pivot, j);
    for (Index k = 0; k < U.cols(); ++k)
      if (k != j) U.col(k) -= U(pivot, k) * U.col(j);
  }
}

std::string describe(const VectorXd& mode, const NamedRows& rows) {
  VectorXd left = mode / mode[first_largest(mode)];
  std::string text;
  for (std::size_t entry = 0; entry < std::min(kMaxEntries, rows.size()); ++entry) {
    const Index i = first_largest(left);
    if (std::abs(left[i]) < kRoundoff) break;
    char value[32];
    std::snprintf(value, sizeof value, " %.3g", left[i]);
    text += (entry > 0 ? ", " : "free motion: ") + rows[to_size(i)].first + value;
    left[i] = 0;
  }
  return text;
}

}  // namespace

std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes) {
  const NamedRows rows = named_rows(system);
  const MatrixXd u = free_length_scales(system) * modes.basis;
  MatrixXd U(std::ssize(rows), u.cols());
  for (std::size_t i = 0; i < rows.size(); ++i)
    U.row(static_cast<Index>(i)) = u.row(rows[i].second);
  if (U.size() > 0) reduce(U);
  std::string text;
  for (Index j = 0; j < std::min(U.cols(), kMaxMotions); ++j)
    text += (j > 0 ? "; " : "") + describe(U.col(j), rows);
  if (U.cols() > kMaxMotions) text += "; and " + std::to_string(U.cols() - kMaxMotions) + " more";
  if (!modes.all_found) text += "; and others";
  return text;
}

Outcome require_held(const System& system, const Factorization& K, Counters& counters) {
  const ZeroEnergyModes free = find_zero_energy_modes(system, K, counters);
  if (free.count() == 0) return {};
  return {Status::singular, describe_mechanism(system, free)};
}

}  // namespace trammel::solver
