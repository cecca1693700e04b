#include "harness/printing/print_uncertainty.h"

#include <map>
#include <ostream>

#include "harness/base/table.h"
#include "harness/base/text.h"

namespace trammel::harness {
void print_validation(const Run& run, std::ostream& out) {
  const ValidationUncertainty& found = run.uncertainty;
  if (found.empty()) return;
  out << "  validation (ASME V&V 20), standard uncertainties in the quantity's unit; inputs by "
         "derivatives and by "
      << found.samples << " samples\n";
  Table table({"reference", ">entry", ">S", ">D", ">E", ">u_num", ">u_input", ">sampled", ">u_D",
               "most from", ">share"});
  for (const ComparedEntry& entry : found.entries) {
    const Comparison& c = entry.comparison;
    table.add({entry.reference, std::to_string(entry.index), rounded(c.simulation),
               rounded(c.reference), rounded(entry.validation.difference, 4), rounded(c.u_num, 2),
               rounded(c.u_input, 3), rounded(entry.u_input_sampled, 3), rounded(c.u_reference, 2),
               entry.dominant, entry.dominant.empty() ? "" : percent(entry.dominant_share)});
  }
  table.print(out, "    ");
  for (const ComparedEntry& entry : found.entries) {
    out << wrapped(entry.reference + "[" + std::to_string(entry.index) +
                       "]: " + entry.validation.text +
                       "; with nominal lengths taken literally: " + entry.literal.text,
                   "    ");
  }
}

void print_validation_summary(const std::vector<Run>& runs, std::ostream& out) {
  std::map<std::string, std::size_t> verdicts;
  std::size_t all = 0;
  for (const Run& run : runs) {
    for (const ComparedEntry& entry : run.uncertainty.entries) {
      ++verdicts[to_string(entry.validation.verdict)];
      ++all;
    }
  }
  if (all == 0) return;
  out << all << " comparisons with the paper (ASME V&V 20)";
  for (const auto& [word, count] : verdicts) out << ", " << count << " " << word;
  out << '\n';
}

void print_numerical_uncertainty(const NumericalUncertaintySummary& summary, std::ostream& out) {
  if (summary.levels == 0) return;
  out << "the numerical uncertainty (GCI) covers the exact value on " << summary.hits << " of "
      << summary.levels << " levels (" << percent(summary.hit_rate()) << "), median GCI over error "
      << rounded(summary.median_ratio, 3);
  if (summary.fails()) {
    out << ": FAIL, expected at least " << percent(kMinHitRate) << " and at most "
        << rounded(kMaxMedianRatio);
  }
  out << '\n';
}

}  // namespace trammel::harness
