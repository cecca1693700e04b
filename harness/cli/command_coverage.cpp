#include "harness/cli/command_coverage.h"

#include <algorithm>
#include <iostream>

#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/coverage/evidence_coverage.h"
#include "harness/input/catalogue.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

using results::CoverageRow;

void print_group(const std::vector<CoverageRow>& rows, const std::string& group, bool gaps) {
  Table table({group, "evidence", ">judged", ">series", "reason"});
  int verified = 0, stated = 0, open = 0, all = 0;
  for (const CoverageRow& row : rows) {
    if (row.group != group) continue;
    ++all;
    verified += row.is_verified() ? 1 : 0;
    stated += row.reason.empty() ? 0 : 1;
    open += row.reason.rfind("open", 0) == 0 ? 1 : 0;
    if (gaps && row.is_verified()) continue;
    const auto number = [&](int n) { return row.series > 0 ? std::to_string(n) : ""; };
    table.add({row.feature, row.evidence.empty() ? "none" : join(row.evidence, "and"),
               number(row.judged), number(row.series), row.reason});
  }
  if (!table.empty()) table.print(std::cout);
  std::cout << group << ": " << verified << " of " << all << " with independent evidence, "
            << stated << " without, for a recorded reason (" << open << " of them open), "
            << all - verified - stated << " without\n\n";
}

}  // namespace

int coverage_command(const CoverageCommand& command) {
  std::vector<CoverageRow> rows = evidence_coverage(Catalogue().load(), References());
  add_reasons(rows);
  if (!command.results.empty()) {
    const results::Results found = load_results(command.results);
    if (!found.missing.empty()) std::cerr << command.results << ": " << found.missing << '\n';
    count_series(found, rows);
  }
  if (command.json) {
    std::cout << pretty(results::coverage_to_json(rows));
  } else {
    for (const char* group : {"key", "pair", "quantity"}) print_group(rows, group, command.gaps);
  }
  const bool complete = std::ranges::all_of(
      rows, [](const CoverageRow& row) { return row.is_verified() || !row.reason.empty(); });
  return complete ? 0 : 1;
}

}  // namespace trammel::harness
