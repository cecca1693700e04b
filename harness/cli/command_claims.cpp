#include <algorithm>
#include <iostream>

#include "harness/input/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/base/json_file.h"
#include "harness/run/claims.h"
#include "harness/base/progress.h"
#include "harness/base/table.h"
#include "harness/base/text.h"

namespace trammel {
namespace {

/// "0.99998 (circle-load)" or "0.0051 ... 0.0079 (circle-load)".
std::string measured(const LedgerReading& reading) {
  if (reading.entries.empty()) return "";
  const auto [least, most] = std::minmax_element(
      reading.entries.begin(), reading.entries.end(),
      [](const LedgerEntry& a, const LedgerEntry& b) { return a.value < b.value; });
  std::string text = rounded(least->value, 5);
  if (most->value != least->value) text += " ... " + rounded(most->value, 5);
  if (reading.unit != "1") text += " " + reading.unit;
  return text + " (" + reading.entries.front().case_id + ")";
}

void print_claim(const LedgerClaim& claim) {
  std::cout << claim.id << ". " << in_words(claim.verdict);
  if (!claim.follows()) std::cout << "  ** recorded: " << in_words(claim.expected) << " **";
  std::cout << '\n' << wrapped(claim.claim, "   ");
  for (const LedgerReading& reading : claim.readings) {
    std::cout << wrapped(in_words(reading.verdict) + ": " + reading.what +
                             (reading.entries.empty() ? "" : ": " + measured(reading)),
                         "     ");
  }
  if (!claim.undecidable.empty()) std::cout << wrapped(claim.undecidable, "     ");
}

}  // namespace

int ledger_command(unsigned jobs, bool json) {
  const Document document = load_ledger();
  const References references;
  Progress progress;
  RunOptions options;
  options.jobs = jobs;
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  const std::vector<Run> runs =
      run_cases(cases_of(document, load_catalogue({})), references, options);
  const Ledger ledger = judge_ledger(document, runs);
  if (json) {
    std::cout << pretty(to_json(ledger));
  } else {
    std::cout << ledger.title << "\n\n";
    for (const LedgerClaim& claim : ledger.claims) print_claim(claim);
  }
  return ledger.follows() ? 0 : 1;
}

}  // namespace trammel
