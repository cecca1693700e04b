#include "solver/model/evidence.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace trammel::solver {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Limit of the relative residual of each row of a system of equations. A row has at most about
/// 1000 terms, which occur for a rigid body to which many members are joined. If each term has a
/// relative round-off error eps, the relative residual is 1e3 eps = 2e-13. At a critical point,
/// where the tangent stiffness is singular, the residual after Newton's method is a hundred times
/// as large. For comparison, a coefficient with a relative error of 1e-6 causes a residual of 1e-6.
constexpr double kRowLimit = 1e-10;

/// Limit of the relative residual of the equation of motion. In each time step, Newton's method
/// ends when its last correction is small. The remaining residual is 1e-5 of the terms of a row
/// when four-bar linkages pass singular positions. In all other cases of the suite, the residual is
/// at most 3e-11. Missing inertia, an outdated load or a velocity of the wrong sign causes a
/// residual above this limit (motion_residuals_test.cpp).
constexpr double kStepLimit = 1e-4;

constexpr std::array<ResidualRule, kResiduals.size()> kRules = {{
    {"equilibrium", kRowLimit, "round-off error of a sum of 1000 terms"},
    {"recovered_forces", kRowLimit, "round-off error of a sum of 1000 terms"},
    {"eigenvalue_equation", kRowLimit, "round-off error of a sum of 1000 terms"},
    {"mode_count", 0, "the number of modes must be exact"},
    {"equation_of_motion", kStepLimit, "error after the last Newton correction of a time step"},
    {"constraints", 1e-9, "position error of joints relative to the model size"},
    {"energy", 1e-6, "round-off error of the energy balance, accumulated over the steps"},
    {"load", kInfinity, "no limit: ill-conditioned models produce a warning"},
}};

std::string in_words(const char* name) {
  std::string words = name;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

const ResidualRule& residual_rule(Residual kind) {
  return kRules[static_cast<std::size_t>(kind)];
}

void Evidence::add(Residual kind, double value) {
  taken_[index(kind)] = true;
  double& largest = largest_[index(kind)];
  largest = value >= 0 ? std::max(largest, value) : kInfinity;
}

void Evidence::add(const Evidence& other) {
  for (const Residual kind : kResiduals) {
    if (other.has(kind)) add(kind, other.largest(kind));
  }
}

bool Evidence::empty() const {
  return std::none_of(taken_.begin(), taken_.end(), [](bool taken) { return taken; });
}

Outcome outcome_by_evidence(const Outcome& claimed, const Evidence& evidence,
                            const std::vector<Residual>& needed) {
  if (!claimed.solved()) return claimed;
  if (evidence.empty()) return {Status::not_converged, "no residual of the solution was computed"};
  for (const Residual kind : needed) {
    if (!evidence.has(kind))
      return {Status::not_converged, "the required residual '" +
                                         in_words(residual_rule(kind).name) + "' was not computed"};
  }
  for (const Residual kind : kResiduals) {
    const ResidualRule& rule = residual_rule(kind);
    if (!evidence.has(kind) || evidence.largest(kind) <= rule.limit) continue;
    std::ostringstream reason;
    reason << "the residual '" << in_words(rule.name) << "' is " << evidence.largest(kind)
           << ", above its limit of " << rule.limit << " (" << rule.why << ")";
    return {Status::not_converged, reason.str()};
  }
  return claimed;
}

}  // namespace trammel::solver
