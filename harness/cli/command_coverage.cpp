#include <algorithm>
#include <iostream>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/cli/commands.h"
#include "harness/coverage/evidence_coverage.h"
#include "harness/input/catalogue.h"
#include "harness/results/result_fields.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

using results::CoverageRow;

/// Prints the features of a group that have no independent evidence, and counts all features of the
/// group.
void print_feature_group(const std::vector<CoverageRow>& rows, const std::string& group) {
  Rows table({group.c_str(), "reason"});
  int verified = 0, stated = 0, open = 0, all = 0;
  for (const CoverageRow& row : rows) {
    if (row.group != group) continue;
    ++all;
    verified += row.is_verified() ? 1 : 0;
    stated += row.reason.empty() ? 0 : 1;
    open += row.reason.starts_with("open") ? 1 : 0;
    if (!row.is_verified()) table.add({row.feature, row.reason});
  }
  if (!table.empty()) table.print(std::cout);
  std::cout << group << ": " << verified << " of " << all << " with independent evidence, "
            << stated << " without it but with a recorded reason (" << open << " open), "
            << all - verified - stated << " with neither\n\n";
}

}  // namespace

int coverage_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  std::vector<CoverageRow> rows = evidence_coverage(Catalogue().load(), References());
  explain_missing_evidence(rows);
  if (!options.word.empty()) {
    const auto file = results_file_path(options.word);
    if (read_json_if_results(file).is_null())
      throw InputError(file.string() + ": expected results (trammel run or trammel report)");
    const results::Results results = load_results(file);
    if (!results.missing.empty()) std::cerr << options.word << ": " << results.missing << '\n';
    count_quantity_runs(results, rows);
  }
  if (options.json) {
    std::cout << format_json(results::to_json(rows));
  } else {
    for (const char* group : {"key", "pair", "quantity"}) print_feature_group(rows, group);
  }
  const bool complete = std::ranges::all_of(
      rows, [](const CoverageRow& row) { return row.is_verified() || !row.reason.empty(); });
  return complete ? 0 : 1;
}

}  // namespace trammel::harness
