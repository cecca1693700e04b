#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/run/run.h"

/// The ledger of a publication's claims: from results, by the rules of cases/paper/claims/, to a verdict
/// for each claim.
namespace trammel {

/// What the entries of a reading come to.
enum class ReadingVerdict { confirms, contradicts, in_part, undecided, not_measured };
enum class ClaimVerdict {
  confirmed,
  confirmed_in_part,
  contradicted,
  cannot_be_decided,
  not_measured
};

/// One number that a reading rests on.
struct LedgerEntry {
  std::string case_id, variant;
  std::string name;  ///< of the check, or of the quantity
  double value = 0;
};

struct LedgerReading {
  std::string name, what, take;
  std::string unit;  ///< of the values: 1 for ratios
  std::vector<LedgerEntry> entries;
  bool incomplete = false;  ///< a run or a number that it asks for is not there
  ReadingVerdict verdict = ReadingVerdict::not_measured;
};

struct LedgerClaim {
  std::string id, claim, place, conclusion, undecidable;
  std::vector<LedgerReading> readings;
  ClaimVerdict verdict = ClaimVerdict::not_measured;
  ClaimVerdict expected = ClaimVerdict::not_measured;
  [[nodiscard]] bool follows() const { return verdict == expected; }
};

struct Ledger {
  std::string title, source;
  std::vector<LedgerClaim> claims;
  /// Every verdict is the one that is recorded.
  [[nodiscard]] bool follows() const;
};

/// The one ledger of the catalogue, cases/paper/claims/varalakshmi-2017.json.
/// @throws InputError  where it cannot be read or breaks its schema.
[[nodiscard]] Document load_ledger();

/// The cases that the ledger's readings look at, by name or by the references of their checks.
/// @param catalogue  all cases
[[nodiscard]] std::vector<Case> cases_of(const Document& ledger,
                                         const std::vector<Case>& catalogue);

/// Readings of cases that were not run have no say; a claim without any reading that has is not
/// measured, and neither is one that misses a single number of a case that was.
/// @throws InputError  where a rule contradicts itself.
[[nodiscard]] Ledger judge_ledger(const Document& ledger, const std::vector<Run>& runs);

/// "confirmed in part"
[[nodiscard]] std::string in_words(ClaimVerdict verdict);
[[nodiscard]] std::string in_words(ReadingVerdict verdict);

/// What results.json says of it.
[[nodiscard]] Json to_json(const Ledger& ledger);

}  // namespace trammel
