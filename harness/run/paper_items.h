#pragma once

#include <vector>

#include "harness/input/catalogue.h"
#include "harness/results/results.h"

/// The publication item by item: which case shows an equation, a table, a figure or a statement,
/// and what came of it.
namespace trammel::harness {

/// The items of cases/paper/claims, in the order of the publication, without verdicts.
/// @throws InputError  for a case, variant, quantity, figure or claim that there is not, and for an
///                     item with neither a counterpart, a claim nor a reason.
[[nodiscard]] std::vector<results::PaperItem> load_paper_items(const Document& claim_set,
                                                               const Catalogue& catalogue);

/// Fills in how the checks of each counterpart were judged.
void judge_paper_items(const results::Results& results, std::vector<results::PaperItem>& items);

}  // namespace trammel::harness
