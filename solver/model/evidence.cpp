#include "solver/model/evidence.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace trammel::solver {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A row has at most some thousand terms (a rigid body with all that is joined to it), each rounded
/// to eps: 1e3 eps = 2e-13; where Newton's method ends on a critical point, whose tangent is
/// singular, a hundred times that. A wrong factor of one part in a million leaves 1e-6.
constexpr double kRowLimit = 1e-10;

/// A nonlinear step ends by the size of its last correction; where four-bars pass their singular
/// positions that leaves 1e-5 of the terms, elsewhere in the catalogue 3e-11 at most. Inertia left
/// out, a stale load and a velocity of the wrong sign leave more (motion_residuals_test.cpp).
constexpr double kStepLimit = 1e-4;

constexpr std::array<ResidualRule, kResiduals.size()> kRules = {{
    {"equilibrium", kRowLimit, "rounding of a row's terms"},
    {"recovered_forces", kRowLimit, "rounding of a row's terms"},
    {"eigenvalue_equation", kRowLimit, "rounding of a row's terms"},
    {"mode_count", 0, "a count is exact"},
    {"equation_of_motion", kStepLimit, "what the last correction of a step leaves"},
    {"constraints", 1e-9, "a billionth of the size of the model"},
    {"energy", 1e-6, "the sum of rounding over the steps"},
    {"load", kInfinity, "ill-conditioned models are neither refused nor excused: see the warning"},
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
  if (evidence.empty()) return {Status::not_converged, "no residual speaks for the solution"};
  for (const Residual kind : needed) {
    if (!evidence.has(kind))
      return {Status::not_converged,
              "nothing was taken of the residual '" + in_words(rule_of(kind).name) + "'"};
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
