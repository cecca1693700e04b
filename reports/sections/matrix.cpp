#include "reports/sections/matrix.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/data/check_status.h"
#include "reports/data/check_text.h"
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
      auto subject = std::ranges::find_if(out, [&](const MatrixSubject& s) {
        return s.reference == check.reference && s.quantity == check.quantity &&
               s.check == check.name;
      });
      if (subject == out.end())
        subject = out.insert(out.end(),
                             MatrixSubject{check.reference, check.quantity, check.name, {}, {}});
      if (subject->rows.empty() || subject->rows.back().run != run)
        subject->rows.push_back({run, {}, 0});
      subject->rows.back().checks[*check.index] = &check;
      subject->targets.emplace(*check.index, *check.expected);
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
  Data cell = object();
  set_flag(cell, "filled", check != nullptr);
  if (!check) return cell;
  const double d = *check->difference;
  cell.set("value", significant(*check->computed, 4));
  cell.set("difference", relative(d, std::abs(d) >= 0.1 ? 2 : 1, true));
  cell.set("side", d < 0 ? "below" : "above");
  cell.set("depth", trimmed(std::min(1.0, std::abs(d) / kFullColourDifference), 2));
  set_check_status(cell, check_status(*check));
  return cell;
}

std::string entry_word(const MatrixSubject& subject) {
  return subject.quantity.starts_with("frequency") ? "mode" : "entry";
}

struct Nearest {
  int entry;
  const Check* check;
  const MatrixRow* row;
};

std::vector<Nearest> nearest_of(const MatrixSubject& subject) {
  std::vector<Nearest> out;
  for (const auto& [entry, _] : subject.targets) {
    Nearest best{entry, nullptr, nullptr};
    for (const MatrixRow& row : subject.rows) {
      const auto found = row.checks.find(entry);
      if (found == row.checks.end()) continue;
      if (!best.check || std::abs(*found->second->difference) < std::abs(*best.check->difference))
        best.check = found->second, best.row = &row;
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
  Data matrix = object();
  matrix.set("title", reference ? reference->title : subject.reference);
  set_text(matrix, "reference_link", reference ? reference_link(reference->id) : "");
  matrix.set("quantity", axis_label(to_text(quantity), quantity.unit));
  matrix.set("conclusion", conclusion(subject, family, results));
  matrix.set("entry_word", entry_word(subject));

  Data columns = list();
  for (const auto& [entry, target] : subject.targets) {
    Data column = object();
    column.set("entry", std::to_string(entry + 1));
    column.set("target", trimmed(target, 6));
    columns.push_back(column);
  }
  matrix.set("columns", columns);

  Data rows = list();
  Data folded = list();
  const std::size_t shown = subject.rows.size() > kMaxUnfoldedMatrixRows + 3
                                ? kMaxUnfoldedMatrixRows
                                : subject.rows.size();
  const std::size_t whole = subject.rows.front().checks.size();
  for (const MatrixRow& row : subject.rows) {
    Data data = object();
    data.set("title", row_title(family, results, row));
    data.set("distance", relative(row.distance, 2, false));
    set_flag(data, "best", &row == &subject.rows.front());
    set_text(data, "partial",
             row.checks.size() == whole ? ""
                                        : count(row.checks.size(), entry_word(subject)) +
                                              " only: not ranked with the rest");
    Data cells = list();
    for (const auto& [entry, _] : subject.targets) {
      const auto found = row.checks.find(entry);
      cells.push_back(cell_of(found == row.checks.end() ? nullptr : found->second));
    }
    data.set("cells", cells);
    (static_cast<std::size_t>(&row - subject.rows.data()) < shown ? rows : folded).push_back(data);
  }
  matrix.set("rows", rows);
  matrix.set("folded", folded);
  set_text(
      matrix, "folded_title",
      shown == subject.rows.size() ? "" : count(subject.rows.size() - shown, "further variant"));

  Data nearest_cells = list();
  for (const Nearest& nearest : nearest_of(subject))
    nearest_cells.push_back(cell_of(nearest.check));
  matrix.set("nearest", nearest_cells);
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
  Data matrices = list();
  for (const MatrixSubject& subject : compared(family))
    matrices.push_back(matrix_of(subject, family, results));
  return matrices;
}

std::string comparison_conclusion(const Family& family, const Results& results,
                                  const Check& check) {
  for (const MatrixSubject& subject : compared(family))
    if (subject.reference == check.reference && subject.check == check.name)
      return conclusion(subject, family, results);
  return "";
}

}  // namespace trammel::reports
