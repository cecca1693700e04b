#include "harness/cli/print_uncertainty.h"

#include <map>
#include <ostream>

#include "harness/base/table.h"
#include "harness/base/text.h"

namespace trammel {
namespace {

std::string percent(double share) {
  return rounded(100 * share, 3) + " %";
}

}  // namespace

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
                       "]: " + entry.validation.words +
                       "; with nominal lengths taken literally: " + entry.literal.words,
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

void print_bands(const BandSummary& bands, std::ostream& out) {
  if (bands.levels == 0) return;
  out << "bands of numerical uncertainty hold the exact value on " << bands.hits << " of "
      << bands.levels << " levels (" << percent(bands.hit_rate()) << "), median band over error "
      << rounded(bands.median_ratio, 3);
  if (bands.fails()) {
    out << ": FAIL, expected at least " << percent(least_hit_rate) << " and at most "
        << rounded(largest_median_ratio);
  }
  out << '\n';
}

}  // namespace trammel
