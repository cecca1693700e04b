#pragma once

#include <vector>

#include "harness/input/catalogue.h"
#include "harness/results/results.h"
#include "harness/run/run.h"

/// A publication: its claims, with a verdict for each by the rules of cases/paper/claims/, and its
/// items (equations, tables, figures), with the cases that show them.
namespace trammel::harness {

/// 0 if every verdict is the recorded one, else 1.
[[nodiscard]] int exit_status(const results::Claims& claims);

/// The claims of the catalogue, cases/paper/claims/varalakshmi-2017.json.
/// @throws InputError  if the file cannot be read or breaks its schema.
[[nodiscard]] Document load_claims();

/// The cases that the interpretations of claims refer to, by name or by the references of their
/// checks.
/// @param catalogue  all cases
[[nodiscard]] std::vector<Case> cases_of(const Document& claim_set,
                                         const std::vector<Case>& catalogue);

/// Interpretations of cases that were not run do not count. A claim without any that does is not
/// measured, and neither is one that misses a single number of a case that was.
/// @throws InputError  if a rule contradicts itself.
[[nodiscard]] results::Claims evaluate_claims(const Document& claim_set,
                                              const std::vector<Run>& runs);

/// The items of cases/paper/claims, in the order of the publication, without verdicts.
/// @throws InputError  for an unknown case, variant, quantity, figure or claim, and for an item
/// with
///                     neither a counterpart, a claim nor a reason.
[[nodiscard]] std::vector<results::PaperItem> load_paper_items(const Document& claim_set,
                                                               const Catalogue& catalogue);

/// Fills in how the checks of each counterpart were judged.
void judge_paper_items(const results::Results& results, std::vector<results::PaperItem>& items);

}  // namespace trammel::harness
