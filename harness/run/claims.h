#pragma once

#include <vector>

#include "harness/input/catalogue.h"
#include "harness/results/results.h"
#include "harness/run/run.h"

/// Claims and items (equations, tables, figures) of a publication. Each claim has a verdict by the
/// rules in cases/paper/claims/. Each item lists the cases that reproduce it.
namespace trammel::harness {

/// Returns 0 if every verdict of a claim equals the expected verdict, else 1.
[[nodiscard]] int exit_status(const results::Claims& claims);

/// Loads the claims of the catalogue, cases/paper/claims/varalakshmi-2017.json.
/// @throws InputError  if the file cannot be read or violates its schema.
[[nodiscard]] Document load_claims();

/// Returns the cases that the interpretations of claims use. An interpretation names a case, or a
/// check or reference that occurs in the case.
/// @param catalogue  all cases of the catalogue
[[nodiscard]] std::vector<Case> cases_used_by(const Document& claim_set,
                                              const std::vector<Case>& catalogue);

/// Evaluates claims. Interpretations of cases that were not run are ignored. The verdict is "not
/// measured" if no interpretation remains, or if a number of a computed case is missing.
/// @throws InputError  if a rule is invalid, for example if its ranges overlap.
[[nodiscard]] results::Claims evaluate_claims(const Document& claim_set,
                                              const std::vector<Run>& runs);

/// Loads the items of cases/paper/claims without verdicts, in the order of the publication.
/// @throws InputError  for an unknown case, variant, quantity, figure or claim, and for an item
///   that has neither a counterpart nor a claim nor a reason.
[[nodiscard]] std::vector<results::PaperItem> load_paper_items(const Document& claim_set,
                                                               const Catalogue& catalogue);

/// Sets the verdict of each case that reproduces an item, from the checks of the case.
void judge_paper_items(const results::Results& results, std::vector<results::PaperItem>& items);

}  // namespace trammel::harness
