#include "harness/cli/command_claims.h"

#include <algorithm>
#include <iostream>

#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/results/results.h"
#include "harness/run/claims.h"
#include "harness/run/paper_items.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

/// "0.99998 (circle-load)" or "0.0051 ... 0.0079 (circle-load)".
std::string measured(const Interpretation& interpretation) {
  if (interpretation.entries.empty()) return "";
  const auto [smallest, greatest] = std::ranges::minmax_element(
      interpretation.entries,
      [](const results::ClaimEntry& a, const results::ClaimEntry& b) { return a.value < b.value; });
  std::string text = rounded(smallest->value, 5);
  if (greatest->value != smallest->value) text += " ... " + rounded(greatest->value, 5);
  if (interpretation.unit != "1") text += " " + interpretation.unit;
  return text + " (" + interpretation.entries.front().case_id + ")";
}

void print_claim(const Claim& claim) {
  std::cout << claim.id << ". " << to_text(claim.verdict);
  if (!claim.as_expected()) std::cout << "  ** expected: " << to_text(claim.expected) << " **";
  std::cout << '\n' << wrapped(claim.claim, "   ");
  for (const Interpretation& interpretation : claim.interpretations) {
    std::cout << wrapped(
        to_text(interpretation.verdict) + ": " + interpretation.what +
            (interpretation.entries.empty() ? "" : ": " + measured(interpretation)),
        "     ");
  }
  if (!claim.undecidable.empty()) std::cout << wrapped(claim.undecidable, "     ");
}

}  // namespace

int claims_command(unsigned jobs, bool json) {
  const Document document = load_claims();
  const References references;
  RunOptions options;
  options.jobs = jobs;
  const std::vector<Run> runs =
      run_shown(cases_of(document, Catalogue().load()), references, options);
  const ClaimSet claim_set = evaluate_claims(document, runs);
  if (json) {
    std::cout << pretty(results::claims_to_json(claim_results(claim_set)));
  } else {
    std::cout << claim_set.title << "\n\n";
    for (const Claim& claim : claim_set.claims) print_claim(claim);
  }
  return exit_status(claim_set);
}

int paper_command(const std::string& results, bool json) {
  const Document claim_set = load_claims();
  std::vector<results::PaperItem> items = load_paper_items(claim_set, Catalogue());
  if (!results.empty()) judge_paper_items(read_summary(results), items);
  if (json) {
    results::Claims shown;
    shown.items = std::move(items);
    std::cout << pretty(results::claims_to_json(shown).at("items"));
    return 0;
  }
  const Json& claims = claim_set.value().at("claims");
  for (const results::PaperItem& item : items) {
    std::cout << item.id << " (" << item.section << "): " << item.what << '\n';
    for (const auto& shown : item.shown_by) {
      std::cout << "    " << shown.case_id << (shown.variant.empty() ? "" : ":" + shown.variant);
      for (const std::string& part : {shown.quantity, shown.figure})
        if (!part.empty()) std::cout << "  " << part;
      std::cout << (shown.verdict.empty() ? "" : ": " + shown.verdict) << '\n';
    }
    for (const std::string& claim : item.claims)
      std::cout << "    claim " << claim << ": "
                << claims.at(claim).at("expected").get<std::string>() << '\n';
    for (const std::string& text : {item.reason, item.note})
      if (!text.empty()) std::cout << wrapped(text, "    ");
  }
  return 0;
}

}  // namespace trammel::harness
