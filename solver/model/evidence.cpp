#include "solver/model/evidence.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace trammel::solver {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A row has at most about 1000 terms (a rigid body with all parts that are joined to it). Each is
/// rounded to eps, which leaves 1e3 eps = 2e-13. Newton's method at a critical point, where the
/// tangent is singular, leaves a hundred times that. A factor that is wrong by one part in a
/// million leaves 1e-6.
constexpr double kRowLimit = 1e-10;

/// Newton's method ends when the last correction of a step is small. This leaves 1e-5 of the terms
/// where four-bar linkages pass singular positions. It leaves at most 3e-11 elsewhere in the
/// catalogue. Missing inertia, an outdated load or a velocity of the wrong sign leaves more
/// (motion_residuals_test.cpp).
constexpr double kStepLimit = 1e-4;

constexpr std::array<ResidualRule, kResiduals.size()> kRules = {{
    {"equilibrium", kRowLimit, "round-off of the terms of a row"},
    {"recovered_forces", kRowLimit, "round-off of the terms of a row"},
    {"eigenvalue_equation", kRowLimit, "round-off of the terms of a row"},
    {"mode_count", 0, "a count is exact"},
    {"equation_of_motion", kStepLimit, "size of the last correction of a step"},
    {"constraints", 1e-9, "1e-9 of the model size"},
    {"energy", 1e-6, "accumulated round-off over the steps"},
    {"load", kInfinity, "no limit: ill-conditioned models produce a warning"},
}};

std::string in_words(const char* name) {
  std::string words = name;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

const ResidualRule& rule_of(Residual kind) {
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
  if (evidence.empty()) return {Status::not_converged, "no residual supports the solution"};
  for (const Residual kind : needed) {
    if (!evidence.has(kind))
      return {Status::not_converged,
              "the required residual '" + in_words(rule_of(kind).name) + "' was not computed"};
  }
  for (const Residual kind : kResiduals) {
    const ResidualRule& rule = rule_of(kind);
    if (!evidence.has(kind) || evidence.largest(kind) <= rule.limit) continue;
    std::ostringstream reason;
    reason << "the residual '" << in_words(rule.name) << "' is " << evidence.largest(kind)
           << ", above its limit of " << rule.limit << " (" << rule.why << ")";
    return {Status::not_converged, reason.str()};
  }
  return claimed;
}

}  // namespace trammel::solver
