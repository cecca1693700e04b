#include "reports/sections/matrix.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/base/find_or_add.h"
#include "reports/data/check_status.h"
#include "reports/data/variant_rows.h"
#include "reports/sections/check_status_data.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMinRows = 4, kMinColumns = 3, kMaxColumns = 16;
constexpr std::size_t kMaxUnfoldedMatrixRows =
    10;  ///< of more than three rows beyond these, the rest is folded
constexpr double kFullColourDifference = 0.4;  ///< relative difference that is drawn in full colour
constexpr double kTargetReached = 0.01;        ///< a target nearer than this counts as reached

/// One variant: its checks by entry.
struct MatrixRow {
  const Run* run;
  std::map<int, const Check*> checks;
  double distance = 0;  ///< root mean square of the relative differences
};

/// All variants that make one check. Another check may compare the same entries with other ones of
/// the same reference.
struct MatrixSubject {
  std::string reference, quantity, check;
  std::vector<MatrixRow> rows;
  std::map<int, double> targets;
};

bool belongs(const Check& check) {
  return check.role == "validation" && check.measure == "relative" && check.index &&
         check.expected && check.difference && !check.reference.empty() &&
         check.verdict != Verdict::error && check.verdict != Verdict::not_run;
}

std::vector<MatrixSubject> subjects(const Family& family) {
  std::vector<MatrixSubject> out;
  for (const Run* run : family.runs) {
    for (const Check& check : run->checks) {
      if (!belongs(check)) continue;
      const auto same = [&](const MatrixSubject& known) {
        return known.reference == check.reference && known.quantity == check.quantity &&
               known.check == check.name;
      };
      auto& subject =
          harness::find_or_add(out, same, {check.reference, check.quantity, check.name, {}, {}});
      if (subject.rows.empty() || subject.rows.back().run != run)
        subject.rows.push_back({run, {}, 0});
      subject.rows.back().checks[*check.index] = &check;
      subject.targets.emplace(*check.index, *check.expected);
    }
  }
  return out;
}

/// Whole rows before partial ones, then nearest first.
void sort_rows(MatrixSubject& subject) {
  for (MatrixRow& row : subject.rows) {
    double sum = 0;
    for (const auto& [_, check] : row.checks) sum += *check->difference * *check->difference;
    row.distance = std::sqrt(sum / static_cast<double>(row.checks.size()));
  }
  std::ranges::stable_sort(subject.rows, [](const MatrixRow& a, const MatrixRow& b) {
    if (a.checks.size() != b.checks.size()) return a.checks.size() > b.checks.size();
    return a.distance < b.distance;
  });
}

std::string row_title(const Family& family, const Results& results, const MatrixRow& row) {
  const CaseInfo& info = results.case_info(row.run->case_id);
  const std::string variant = info.variant_title(row.run->variant);
  return family.cases.size() > 1 ? variant + " – " + family.short_title(info) : variant;
}

Data cell_of(const Check* check) {
  if (!check) return object({{"filled", false}});
  const double d = *check->difference;
  return with_status(check_status(*check),
                     {{"filled", true},
                      {"value", significant(*check->computed, 4)},
                      {"difference", relative(d, std::abs(d) >= 0.1 ? 2 : 1, true)},
                      {"side", d < 0 ? "below" : "above"},
                      {"depth", trimmed(std::min(1.0, std::abs(d) / kFullColourDifference), 2)}});
}

std::string entry_word(const MatrixSubject& subject) {
  return subject.quantity.starts_with("frequency") ? "mode" : "entry";
}

struct Nearest {
  int entry;
  const Check* check;
};

std::vector<Nearest> nearest_of(const MatrixSubject& subject) {
  std::vector<Nearest> out;
  for (const auto& [entry, _] : subject.targets) {
    Nearest best{entry, nullptr};
    for (const MatrixRow& row : subject.rows) {
      const auto found = row.checks.find(entry);
      if (found == row.checks.end()) continue;
      if (!best.check || std::abs(*found->second->difference) < std::abs(*best.check->difference))
        best.check = found->second;
    }
    out.push_back(best);
  }
  return out;
}

/// "Of 666 readings the most probable one is, under a discrepancy of 1 %: X (40 %); ..." Empty
/// where no run has judged the row so.
std::string most_probable(const std::string& reference, const Results& results) {
  std::string text;
  for (const Run& run : results.runs) {
    if (!run.model_probabilities) continue;
    for (const auto& row : run.model_probabilities->rows) {
      if (row.reference != reference || row.leading.empty()) continue;
      text += (text.empty() ? "Of " + std::to_string(row.readings) + " readings (" + run.case_id +
                                  ") the most probable is"
                            : ";") +
              " under a discrepancy of " + relative(row.discrepancy.value_or(0), 2, false) + " " +
              row.leading.front().title + " (" +
              relative(row.leading.front().probability.value_or(0), 2, false) + ")";
    }
  }
  return text.empty() ? text : text + ".";
}

/// "Nearest as a whole: X (12 % root mean square). No variant comes within 1 % of modes 4 and 6."
std::string conclusion(const MatrixSubject& subject, const Family& family, const Results& results) {
  const MatrixRow& best = subject.rows.front();
  std::string text = most_probable(subject.reference, results);
  if (text.empty())
    text = "Nearest as a whole: " + row_title(family, results, best) +
           ", with a root mean square difference of " + relative(best.distance, 2, false) +
           " over " + count(best.checks.size(), entry_word(subject)) + ".";
  std::string missed;
  std::size_t n = 0;
  for (const Nearest& nearest : nearest_of(subject)) {
    if (std::abs(*nearest.check->difference) <= kTargetReached) continue;
    missed += (n++ ? ", " : "") + std::to_string(nearest.entry + 1) + " (nearest " +
              relative(*nearest.check->difference, 2, true) + ")";
  }
  if (n == 0)
    return text + " Every target is reached within 1\u202f% by some variant, though not by one.";
  return text + " No variant comes within 1\u202f% of " + entry_word(subject) +
         (n == 1 ? " " : "s ") + missed + ".";
}

Data matrix_of(const MatrixSubject& subject, const Family& family, const Results& results) {
  const Reference* reference = results.reference(subject.reference);
  const QuantityLabel quantity = parse_quantity(subject.quantity);
  const auto nearest_cell = [](const Nearest& nearest) { return cell_of(nearest.check); };
  Data matrix = object({{"title", reference ? reference->title : subject.reference},
                        {"reference_link", reference ? reference_link(reference->id) : ""},
                        {"quantity", axis_label(to_text(quantity), quantity.unit)},
                        {"conclusion", conclusion(subject, family, results)},
                        {"entry_word", entry_word(subject)},
                        {"columns", target_columns(subject.targets, "")},
                        {"nearest", list_of(nearest_of(subject), nearest_cell)}});
  const std::size_t whole = subject.rows.front().checks.size();
  set_variant_rows(matrix, subject.rows.size(), kMaxUnfoldedMatrixRows, [&](std::size_t i) {
    const MatrixRow& row = subject.rows[i];
    return object(
        {{"title", row_title(family, results, row)},
         {"distance", relative(row.distance, 2, false)},
         {"best", i == 0},
         {"partial", row.checks.size() == whole ? ""
                                                : count(row.checks.size(), entry_word(subject)) +
                                                      " only: not ranked with the rest"},
         {"cells", target_cells(subject.targets, row.checks, cell_of)}});
  });
  return matrix;
}

std::vector<MatrixSubject> compared(const Family& family) {
  std::vector<MatrixSubject> out;
  for (MatrixSubject& subject : subjects(family)) {
    if (subject.rows.size() < kMinRows || subject.targets.size() < kMinColumns ||
        subject.targets.size() > kMaxColumns)
      continue;
    sort_rows(subject);
    out.push_back(std::move(subject));
  }
  return out;
}

}  // namespace

Data comparison_matrices(const Family& family, const Results& results) {
  return list_of(compared(family),
                 [&](const MatrixSubject& subject) { return matrix_of(subject, family, results); });
}

std::string comparison_conclusion(const Family& family, const Results& results,
                                  const Check& check) {
  for (const MatrixSubject& subject : compared(family))
    if (subject.reference == check.reference && subject.check == check.name)
      return conclusion(subject, family, results);
  return "";
}

}  // namespace trammel::reports
