#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/cli/commands.h"
#include "harness/results/result_fields.h"
#include "harness/run/claims.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

/// Returns, as text, the values computed for an interpretation of a claim: ": 0.99998
/// (circle-load)" or ": 0.0051 ... 0.0079 m (statics)".
std::string computed_values_text(const results::ClaimInterpretation& interpretation) {
  if (interpretation.entries.empty()) return "";
  const auto [low, high] =
      std::ranges::minmax(interpretation.entries, {}, &results::ClaimEntry::value);
  const std::string upper = high.value == low.value ? "" : fmt::format(" ... {:.5g}", high.value);
  const std::string unit = interpretation.unit == "1" ? "" : " " + interpretation.unit;
  return fmt::format(": {:.5g}{}{} ({})", low.value, upper, unit,
                     interpretation.entries.front().case_id);
}

void print_claim(const results::Claim& claim) {
  std::cout << claim.id << ". " << claim.verdict;
  if (claim.verdict != claim.expected) std::cout << "  ** expected: " << claim.expected << " **";
  std::cout << '\n' << wrapped(claim.claim, "   ");
  for (const results::ClaimInterpretation& interpretation : claim.interpretations)
    std::cout << wrapped(interpretation.verdict + ": " + interpretation.description +
                             computed_values_text(interpretation),
                         "     ");
  std::cout << wrapped(claim.undecidable, "     ");
}

void print_paper_item(const results::PaperItem& item, const Json& claims) {
  std::cout << item.id << " (" << item.section << "): " << item.what << '\n';
  for (const auto& shown : item.shown_by) {
    std::cout << "    " << shown.case_id << (shown.variant.empty() ? "" : ":" + shown.variant);
    for (const std::string& part : {shown.quantity, shown.figure})
      if (!part.empty()) std::cout << "  " << part;
    std::cout << (shown.verdict.empty() ? "" : ": " + shown.verdict) << '\n';
  }
  for (const std::string& claim : item.claims)
    std::cout << "    claim " << claim << ": " << claims.at(claim).at("expected").get<std::string>()
              << '\n';
  std::cout << wrapped(item.reason, "    ") << wrapped(item.note, "    ");
}

/// Reads the stored runs of all cases, with all recorded values.
std::vector<Run> read_stored_runs(const std::string& name, const std::vector<Case>& cases) {
  results::Results stored = load_results(results_file_path(name));
  for (const Case& one : cases)
    if (std::ranges::find(stored.runs, one.id(), &Run::case_id) == stored.runs.end())
      throw InputError(
          name + ": expected results of all cases that the claims use (missing: " + one.id() + ")");
  return std::move(stored.runs);
}

}  // namespace

int claims_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const Document document = load_claims();
  RunOptions run_options;
  run_options.jobs = options.jobs;
  const std::vector<Case> cases = cases_used_by(document, Catalogue().load());
  const results::Claims claims = evaluate_claims(
      document, options.word.empty() ? run_with_progress(cases, References(), run_options)
                                     : read_stored_runs(options.word, cases));
  if (options.json) {
    std::cout << format_json(results::to_json(claims));
  } else {
    std::cout << claims.title << "\n\n";
    std::ranges::for_each(claims.claims, print_claim);
  }
  return exit_status(claims);
}

int paper_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const Document claim_set = load_claims();
  results::Claims shown;
  shown.items = load_paper_items(claim_set, Catalogue());
  if (!options.word.empty())
    judge_paper_items(read_results_json(results_file_path(options.word)), shown.items);
  if (options.json) {
    std::cout << format_json(results::to_json(shown).at("items"));
  } else {
    for (const results::PaperItem& item : shown.items)
      print_paper_item(item, claim_set.value().at("claims"));
  }
  return 0;
}

}  // namespace trammel::harness
