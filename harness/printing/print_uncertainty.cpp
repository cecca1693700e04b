#include "harness/printing/print_uncertainty.h"

#include <map>
#include <ostream>

#include "harness/base/table.h"
#include "harness/base/text.h"

namespace trammel::harness {
void print_validation(const Run& run, std::ostream& out) {
  if (!run.uncertainty) return;
  const results::Uncertainty& found = *run.uncertainty;
  out << "  validation (ASME V&V 20), standard uncertainties in the quantity's unit; inputs by "
         "derivatives and by "
      << found.samples << " samples\n";
  Table table({"reference", ">entry", ">S", ">D", ">E", ">u_num", ">u_input", ">sampled", ">u_D",
               "most from", ">share"});
  for (const results::Comparison& c : found.comparisons) {
    table.add({c.reference, std::to_string(c.index), rounded(*c.simulation), rounded(*c.expected),
               rounded(*c.difference, 4), rounded(*c.u_num, 2), rounded(*c.u_input, 3),
               rounded(*c.u_input_sampled, 3), rounded(*c.u_reference, 2), c.dominant_input,
               c.dominant_input.empty() ? "" : percent(*c.dominant_share)});
  }
  table.print(out, "    ");
  for (const results::Comparison& entry : found.comparisons) {
    out << wrapped(entry.reference + "[" + std::to_string(entry.index) + "]: " + entry.conclusion +
                       "; with nominal lengths taken literally: " + entry.all_inputs.conclusion,
                   "    ");
  }
}

void print_validation_summary(const std::vector<Run>& runs, std::ostream& out) {
  std::map<std::string, std::size_t> verdicts;
  std::size_t all = 0;
  for (const Run& run : runs) {
    if (!run.uncertainty) continue;
    for (const results::Comparison& entry : run.uncertainty->comparisons) {
      ++verdicts[entry.verdict];
      ++all;
    }
  }
  if (all == 0) return;
  out << all << " comparisons with the paper (ASME V&V 20)";
  for (const auto& [word, count] : verdicts) out << ", " << count << " " << word;
  out << '\n';
}

void print_numerical_uncertainty(const results::UncertaintyCoverage& summary, std::ostream& out) {
  if (summary.levels == 0) return;
  out << "the numerical uncertainty (GCI) covers the exact value on " << summary.covered << " of "
      << summary.levels << " levels (" << percent(*summary.coverage) << "), median GCI over error "
      << rounded(*summary.median_ratio, 3);
  if (!summary.passes) {
    out << ": FAIL, expected at least " << percent(kMinHitRate) << " and at most "
        << rounded(kMaxMedianRatio);
  }
  out << '\n';
}

}  // namespace trammel::harness
