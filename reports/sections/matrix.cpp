#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "harness/base/find_or_add.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMinRows = 4, kMinColumns = 3, kMaxColumns = 16;
constexpr double kFullColorDifference = 0.4;  ///< relative difference of the darkest color
constexpr double kTargetReached = 0.01;       ///< a target is reached within this relative error

/// A check, and the comparison of its difference with the validation uncertainty if it is known.
struct MatrixCell {
  const Check* check = nullptr;
  const Comparison* comparison = nullptr;
};

/// Row of a matrix (table of differences): checks of one variant, by the index of the checked
/// value.
struct MatrixRow {
  const Run* run;
  std::map<int, MatrixCell> checks;
  double distance = 0;  ///< root mean square of the relative differences
};

/// Content of one matrix (table of differences): all variants of a family with the same check.
/// Checks are distinguished by name, because two checks can compare a quantity with different
/// values of one reference.
struct MatrixSubject {
  std::string reference, quantity, check;
  std::vector<MatrixRow> rows;
  std::map<int, double> targets;
};

bool is_matrix_check(const Check& check) {
  return check.role == "validation" && check.measure == "relative" && check.expected &&
         check.difference && !check.reference.empty() && check.verdict != Verdict::error &&
         check.verdict != Verdict::not_run;
}

std::vector<MatrixSubject> matrix_subjects(const Family& family) {
  std::vector<MatrixSubject> out;
  for (const Run* run : family.runs)
    for (const Check& check : run->checks) {
      if (!is_matrix_check(check)) continue;
      const auto same = [&](const MatrixSubject& known) {
        return known.reference == check.reference && known.quantity == check.quantity &&
               known.check == check.name;
      };
      auto& subject =
          harness::find_or_add(out, same, {check.reference, check.quantity, check.name, {}, {}});
      if (subject.rows.empty() || subject.rows.back().run != run)
        subject.rows.push_back({run, {}, 0});
      const int entry = check.index.value_or(0);
      subject.rows.back().checks[entry] = {&check, find_comparison(*run, check)};
      subject.targets.emplace(entry, *check.expected);
    }
  return out;
}

/// Sorts the rows (variants) by decreasing number of checked values. Rows with equal numbers are
/// sorted by the root mean square of the relative differences.
void sort_rows(MatrixSubject& subject) {
  for (MatrixRow& row : subject.rows) {
    double sum = 0;
    for (const auto& [_, cell] : row.checks)
      sum += *cell.check->difference * *cell.check->difference;
    row.distance = std::sqrt(sum / static_cast<double>(row.checks.size()));
  }
  std::ranges::stable_sort(subject.rows, {}, [](const MatrixRow& row) {
    return std::pair(-std::ssize(row.checks), row.distance);
  });
}

std::string row_title(const Family& family, const Results& results, const MatrixRow& row) {
  const CaseInfo& info = results.case_info(row.run->case_id);
  const std::string variant = info.variant_title(row.run->variant);
  return family.cases.size() > 1 ? variant + " – " + family.short_title(info) : variant;
}

Data cell_of(const MatrixCell& cell) {
  if (!cell.check) return object({{"filled", false}});
  const double d = *cell.check->difference;
  Data data =
      status_data(find_status(*cell.check),
                  {{"filled", true},
                   {"value", rounded_text(*cell.check->computed, 4)},
                   {"difference", percent_text(d, std::abs(d) >= 0.1 ? 2 : 1, true)},
                   {"side", d < 0 ? "below" : "above"},
                   {"depth", trimmed(std::min(1.0, std::abs(d) / kFullColorDifference), 2)}});
  if (!cell.comparison) return data;
  const Comparison& c = *cell.comparison;
  std::string words = c.conclusion;
  if (!c.all_inputs.conclusion.empty())
    words += " If the nominal lengths are as uncertain as their printed digits imply: " +
             c.all_inputs.conclusion;
  set(data, {{"status_text", words},
             {"expanded_uncertainty",
              percent_text(2 * *c.u_val / std::abs(*cell.check->expected), 2, false)},
             {"verdict", c.verdict}});
  return data;
}

/// Number of comparisons by verdict.
struct Tally {
  std::map<std::string, std::size_t> verdict;
  std::size_t entries = 0;

  void add(const MatrixRow& row) {
    for (const auto& [_, cell] : row.checks) {
      if (!cell.comparison) continue;
      ++entries;
      ++verdict[cell.comparison->verdict];
    }
  }
  [[nodiscard]] std::string text() const {
    constexpr std::array<std::pair<const char*, const char*>, 4> kWords = {{
        {"within-uncertainty", "within the validation uncertainty"},
        {"model-error", "with a model error"},
        {"reference-inconsistent", "against an inconsistent reference"},
        {"undecided", "undecided"},
    }};
    std::string text;
    for (const auto& [key, words] : kWords)
      if (verdict.contains(key)) add_item(text, std::to_string(verdict.at(key)) + " " + words);
    return text + ".";
  }
};

std::string entry_word(const MatrixSubject& subject) {
  return subject.quantity.starts_with("frequency") ? "mode" : "entry";
}

/// Returns for each target (published value) the check with the nearest value that any variant
/// computes.
std::map<int, MatrixCell> nearest_of(const MatrixSubject& subject) {
  std::map<int, MatrixCell> nearest;
  for (const MatrixRow& row : subject.rows)
    for (const auto& [entry, cell] : row.checks) {
      const Check*& best = nearest[entry].check;
      if (!best || std::abs(*cell.check->difference) < std::abs(*best->difference))
        best = cell.check;
    }
  return nearest;
}

/// Returns the most probable reading (interpretation of the published model) for each assumed model
/// discrepancy: "Of 666 readings (case), the most probable is X (40 %) for a model discrepancy of
/// 1 %, Y (30 %) for ...". Empty if no run has probabilities for this reference.
std::string most_probable_readings(const std::string& reference, const Results& results) {
  std::string text;
  for (const Run& run : results.runs) {
    if (!run.model_probabilities) continue;
    for (const auto& row : run.model_probabilities->rows) {
      if (row.reference != reference || row.leading.empty()) continue;
      text += (text.empty() ? "Of " + std::to_string(row.readings) + " readings (" + run.case_id +
                                  "), the most probable is "
                            : ", ") +
              row.leading.front().title + " (" +
              percent_text(row.leading.front().probability.value_or(0), 2, false) +
              ") for a model discrepancy of " + percent_text(row.discrepancy.value_or(0), 2, false);
    }
  }
  return text.empty() ? text : text + ".";
}

/// Returns a text with the most probable reading (interpretation) of the published model, or else
/// with the variant of the smallest differences. The text then lists the targets that no variant
/// reaches within 1 %.
std::string conclusion(const MatrixSubject& subject, const Family& family, const Results& results) {
  const MatrixRow& best = subject.rows.front();
  std::string text = most_probable_readings(subject.reference, results);
  if (text.empty())
    text = "Nearest overall: " + row_title(family, results, best) +
           ", with a root mean square difference of " + percent_text(best.distance, 2, false) +
           " over " + count(best.checks.size(), entry_word(subject)) + ".";
  std::string missed;
  std::size_t n = 0;
  for (const auto& [entry, nearest] : nearest_of(subject)) {
    if (std::abs(*nearest.check->difference) <= kTargetReached) continue;
    missed += (n++ ? ", " : "") + std::to_string(entry + 1) + " (nearest " +
              percent_text(*nearest.check->difference, 2, true) + ")";
  }
  if (n == 0) return text + " Each target is reached within 1\u202f% by at least one variant.";
  return text + " No variant comes within 1\u202f% of " + entry_word(subject) +
         (n == 1 ? " " : "s ") + missed + ".";
}

/// Returns the data of a table cell for each target. The cell is empty if `entries` has no check of
/// the target.
Data cells_of_targets(const MatrixSubject& subject, const std::map<int, MatrixCell>& entries) {
  return list_of(subject.targets, [&](const auto& target) {
    const auto found = entries.find(target.first);
    return cell_of(found == entries.end() ? MatrixCell{} : found->second);
  });
}

Data matrix_row(const MatrixSubject& subject, const MatrixRow& row, const Family& family,
                const Results& results) {
  const std::size_t complete = subject.rows.front().checks.size();
  return object(
      {{"title", row_title(family, results, row)},
       {"distance", percent_text(row.distance, 2, false)},
       {"best", &row == &subject.rows.front() && subject.rows.size() > 1},
       {"partial", row.checks.size() == complete ? ""
                                                 : count(row.checks.size(), entry_word(subject)) +
                                                       " only, ranked after complete rows"},
       {"cells", cells_of_targets(subject, row.checks)}});
}

Data matrix_of_subject(const MatrixSubject& subject, const Family& family, const Results& results) {
  const Reference* reference = results.reference(subject.reference);
  const QuantityLabel quantity = parse_quantity(subject.quantity);
  Tally tally;
  for (const MatrixRow& row : subject.rows) tally.add(row);
  const auto column = [](const auto& target) {
    return object(
        {{"entry", std::to_string(target.first + 1)}, {"target", trimmed(target.second, 6)}});
  };
  const auto row = [&](const MatrixRow& variant) {
    return matrix_row(subject, variant, family, results);
  };
  return object(
      {{"title", reference ? reference->title : subject.reference},
       {"reference_link", reference ? reference_link(reference->id) : ""},
       {"quantity", axis_label(to_text(quantity), quantity.unit)},
       {"check", subject.check},
       {"conclusion", conclusion(subject, family, results)},
       {"uncertainty",
        tally.entries == 0 ? "" : "Of " + count(tally.entries, "comparison") + ": " + tally.text()},
       {"entry_word", entry_word(subject)},
       {"columns", list_of(subject.targets, column)},
       {"has_nearest", subject.rows.size() > 1},
       {"nearest", cells_of_targets(subject, nearest_of(subject))},
       {"rows", list_of(subject.rows, row)}});
}

/// Returns true if the page shows a matrix, which requires enough variants and targets, or a
/// validation uncertainty.
bool is_shown_matrix(const MatrixSubject& subject) {
  const bool uncertain = std::ranges::any_of(subject.rows, [](const MatrixRow& row) {
    return row.checks.begin()->second.comparison != nullptr;
  });
  const bool many = subject.rows.size() >= kMinRows && subject.targets.size() >= kMinColumns;
  return (uncertain || many) && subject.targets.size() <= kMaxColumns;
}

}  // namespace

Data comparison_matrices(const Family& family, const Results& results) {
  Data matrices = list();
  for (MatrixSubject& subject : matrix_subjects(family)) {
    if (!is_shown_matrix(subject)) continue;
    sort_rows(subject);
    matrices.push_back(matrix_of_subject(subject, family, results));
  }
  return matrices;
}

Data validation_uncertainty_section(const std::vector<Family>& families,
                                    const StudyFigures& figures) {
  Tally all;
  Data with = list();
  for (const Family& family : families) {
    Tally tally;
    for (const MatrixSubject& subject : matrix_subjects(family))
      for (const MatrixRow& row : subject.rows) tally.add(row), all.add(row);
    if (tally.entries > 0)
      with.push_back(object({{"family_title", family.title},
                             {"family_link", family_link(family.id)},
                             {"words", count(tally.entries, "comparison") + ": " + tally.text()}}));
  }
  return object({{"has_rows", all.entries > 0},
                 {"words", count(all.entries, "comparison") + " with the paper: " + all.text()},
                 {"figures", list_of(figures.errors, figure_data)},
                 {"families", with}});
}

}  // namespace trammel::reports
