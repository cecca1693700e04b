#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "reports/data/check_text.h"
#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

/// Sections of report pages. Each function converts results into the data of a template. If a
/// section has no content, the variable `has_rows` of its data is false.
namespace trammel::reports {

/// Returns the template data `entries` together with text, CSS class and symbol of a check status
/// (`status_text`, `status_class`, `sign`).
[[nodiscard]] Data status_data(CheckStatus status, std::initializer_list<Entry> entries = {});

/// Returns template data with an entry for each status that occurs: the number n of checks with
/// this status, and their percentage of all checks.
[[nodiscard]] Data data_of_status_counts(const Counts& counts);

/// Return links to the page of a case, a family or a reference, relative to the report folder.
[[nodiscard]] std::string case_link(const std::string& id);
[[nodiscard]] std::string family_link(const std::string& id);
[[nodiscard]] std::string reference_link(const std::string& id);

/// Returns the name of a case of the catalogue, or the path of another case, for a command line.
[[nodiscard]] std::string run_name(const CaseInfo& info);

/// Returns the expanded validation uncertainty of a check relative to its target: "± 3.2 %".
/// Returns "" if the uncertainty is unknown.
[[nodiscard]] std::string uncertainty_text(const Run& run, const Check& check);

/// Returns the data of a drawn figure for the template figure.mustache.
[[nodiscard]] Data figure_data(const Figure& figure);

/// Id of the figure that represents all cost studies on the front page.
inline constexpr const char* kLeadFigure = "cost-modes-elements";

/// Figures that summarize many cases. `plan_studies` prepares the figures, and `draw` draws them
/// later.
struct StudyFigures {
  std::vector<Figure> trust;  ///< fractions of tolerances, and orders of convergence
  std::vector<Figure> cost;   ///< computing time against error, one figure per study
  std::vector<Figure> stress, effects, errors, history;

  [[nodiscard]] std::vector<Figure*> all();
};
[[nodiscard]] StudyFigures plan_studies(const Results& results,
                                        const std::vector<Family>& families);

/// Claims of the publication under examination, each with the measured values and a verdict.
[[nodiscard]] Data claims_section(const Results& results);

/// Studies of accuracy and computing time.
[[nodiscard]] Data cost_section(const Results& results, const StudyFigures& figures);

/// Automatic selection of mechanical effects in the cases with candidate effects (scenes).
[[nodiscard]] Data effects_section(const Results& results, const StudyFigures& figures);

/// Counted work and time of the calls of trammel in a history file, and the number of values that
/// changed since an earlier call.
[[nodiscard]] Data call_history_section(const Results& results, const StudyFigures& figures);

/// Features of the program, each with the types of evidence that verify it.
[[nodiscard]] Data coverage_section(const Results& results);

/// Machine, compiler and computing time of the results.
[[nodiscard]] Data environment_section(const Results& results);

/// A case with its tables and drawn figures.
[[nodiscard]] Data case_section(const CaseInfo& info, const Family& family, const Results& results);

/// A family of cases with its common figures and tables, and a line for each case.
[[nodiscard]] Data family_section(const Family& family, const Results& results);

/// Returns the groups of families, each with a link to its first family, a small drawing, and the
/// largest difference from a target as text.
[[nodiscard]] Data groups_of_families(const std::vector<Family>& families);

/// Returns a table ("matrix") of differences for each validation check with many variants or a
/// validation uncertainty. Variants are rows, with the nearest to the published values first.
/// Checked values are columns.
[[nodiscard]] Data comparison_matrices(const Family& family, const Results& results);

/// Observed and theoretical orders of convergence. The section also shows the fraction of
/// refinement levels on which the numerical uncertainty (GCI) covers the exact value.
[[nodiscard]] Data convergence_section(const Results& results, const std::vector<Family>& families,
                                       const StudyFigures& figures);

/// Provenance of all references.
[[nodiscard]] Data references_section(const Results& results);

/// Results of the stress suite, which examines numerical stability. Each case has its largest
/// fraction of a tolerance. Each indicator has its worst value, bound, reason and verdict.
[[nodiscard]] Data stress_suite_section(const std::vector<Family>& families,
                                        const StudyFigures& figures);

/// Overall verdict, failures, and numbers of checks with each role and status.
[[nodiscard]] Data summary_section(const Results& results, const std::vector<Family>& families);

/// One sheet for an audit: verdict, numbers of checks, the largest known discrepancies with their
/// validation uncertainty, and the number of discrepancies for each reason.
[[nodiscard]] Data audit_section(const Results& results, const std::vector<Family>& families,
                                 const Data& summary);

/// Known discrepancies by family, with their reasons.
[[nodiscard]] Data discrepancy_section(const Results& results, const std::vector<Family>& families);

/// Key numbers (tiles) and figures of the front page.
[[nodiscard]] Data front_page_section(const Results& results, const std::vector<Family>& families,
                                      const StudyFigures& figures);

/// Returns the tables of the checks of a case: one with the worst value of each of the most severe
/// checks, and one with all checks.
[[nodiscard]] Data case_check_tables(const CaseInfo& info, const std::vector<const Run*>& runs,
                                     const Results& results);

/// Returns all checks of a case with all digits, as a table for a CSV file.
[[nodiscard]] Table checks_table(const CaseInfo& info, const std::vector<const Run*>& runs);

/// Differences from published values with their validation uncertainty (ASME V&V 20), by family.
[[nodiscard]] Data validation_uncertainty_section(const std::vector<Family>& families,
                                                  const StudyFigures& figures);

/// Returns the tables that a case requests. Variants are rows; quantities and times are columns.
[[nodiscard]] Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs);

/// Sets tables of all validation uncertainties, and of the probabilities of interpretations of the
/// published model. Also sets tables of discretization errors and of selected effects, each from
/// the first run with these data. The template variable of a table without rows is false.
void set_run_tables(Data& data, const CaseInfo& info, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
