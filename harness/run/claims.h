#pragma once

#include <string>
#include <vector>

#include "harness/results/results.h"
#include "harness/run/run.h"

/// A publication's claims: from results, by the rules of cases/paper/claims/, to a
/// verdict for each claim.
namespace trammel::harness {

/// What the entries of an interpretation come to.
enum class InterpretationVerdict { confirms, contradicts, in_part, undecided, not_measured };
enum class ClaimVerdict {
  confirmed,
  confirmed_in_part,
  contradicted,
  cannot_be_decided,
  not_measured
};

struct Interpretation {
  std::string name, what, metric;
  std::string unit;  ///< of the values: 1 for ratios
  std::vector<results::ClaimEntry> entries;
  bool incomplete = false;  ///< a run or a number that it asks for is not there
  InterpretationVerdict verdict = InterpretationVerdict::not_measured;
};

struct Claim {
  std::string id, claim, place, conclusion, undecidable;
  std::vector<Interpretation> interpretations;
  ClaimVerdict verdict = ClaimVerdict::not_measured;
  ClaimVerdict expected = ClaimVerdict::not_measured;
  [[nodiscard]] bool as_expected() const { return verdict == expected; }
};

struct ClaimSet {
  std::string title, source;
  std::vector<Claim> claims;
  /// Every verdict is the one that is recorded.
  [[nodiscard]] bool as_expected() const;
};

/// 0 where every verdict is the one that is recorded, else 1.
[[nodiscard]] int exit_status(const ClaimSet& claim_set);

/// The claims of the catalogue, cases/paper/claims/varalakshmi-2017.json.
/// @throws InputError  where it cannot be read or breaks its schema.
[[nodiscard]] Document load_claims();

/// The cases that the interpretations of claims look at, by name or by the references of their
/// checks.
/// @param catalogue  all cases
[[nodiscard]] std::vector<Case> cases_of(const Document& claim_set,
                                         const std::vector<Case>& catalogue);

/// Interpretations of cases that were not run do not count; a claim without any that does is not
/// measured, and neither is one that misses a single number of a case that was.
/// @throws InputError  where a rule contradicts itself.
[[nodiscard]] ClaimSet evaluate_claims(const Document& claim_set, const std::vector<Run>& runs);

/// "confirmed in part"
[[nodiscard]] std::string to_text(ClaimVerdict verdict);
[[nodiscard]] std::string to_text(InterpretationVerdict verdict);

/// What results.json says of it.
[[nodiscard]] results::Claims claim_results(const ClaimSet& claim_set);

}  // namespace trammel::harness
