#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "reports/data/check_text.h"
#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

/// Sections of the pages. Each function converts results into the data of a template. A section
/// without content has a false `has_rows`.
namespace trammel::reports {

/// Returns the entries together with the `status_text`, `status_class` and symbol (`sign`) of a
/// status.
[[nodiscard]] Data with_status(CheckStatus status, std::initializer_list<Entry> entries = {});

/// Returns the counts above zero as a list of {n, percent} with their status.
[[nodiscard]] Data counts_list(const Counts& counts);

/// Links relative to the folder of the report.
[[nodiscard]] std::string case_link(const std::string& id);
[[nodiscard]] std::string family_link(const std::string& id);
[[nodiscard]] std::string reference_link(const std::string& id);

/// Returns a drawn figure for figure.mustache.
[[nodiscard]] Data figure_data(const Figure& figure);

/// Figures that do not belong to single cases. They are neither numbered nor drawn.
struct StudyFigures {
  std::vector<Figure> cost;  ///< one for each cost study of the results, in their order
  std::vector<Figure> effects, history;

  [[nodiscard]] std::vector<Figure*> all();
};
[[nodiscard]] StudyFigures plan_studies(const Results& results);

/// Claims of the publication under examination, each with the measured values and a verdict.
[[nodiscard]] Data claims_section(const Results& results);

/// Studies of accuracy and computing time.
[[nodiscard]] Data cost_section(const Results& results, const StudyFigures& figures);

/// Automatic selection of effects in the scenes (cases with candidate effects) of the catalogue.
[[nodiscard]] Data effects_section(const StudyFigures& figures);

/// Counted work and time over the calls in a history file, and the number of changed values.
[[nodiscard]] Data history_section(const Results& results, const StudyFigures& figures);

/// Features of the program, each with the types of evidence that verify it.
[[nodiscard]] Data coverage_section(const Results& results);

/// Machine, compiler, libraries and computing time.
[[nodiscard]] Data environment_section(const Results& results);

/// A case with its tables and drawn figures.
[[nodiscard]] Data case_section(const CaseInfo& info, const Family& family, const Results& results);

/// A family with its common figures and tables, and a line for each case.
[[nodiscard]] Data family_section(const Family& family, const Results& results);

/// Returns a matrix for each validation check that has many variants or a validation uncertainty:
/// variants down, entries across, nearest first.
[[nodiscard]] Data comparison_matrices(const Family& family, const Results& results);

/// Observed and theoretical orders, and the coverage of the numerical uncertainty.
[[nodiscard]] Data orders_section(const Results& results, const std::vector<Family>& families);

/// Provenance of all references.
[[nodiscard]] Data references_section(const Results& results);

/// Indicators of the stress suite in the order of its items, each with its worst value, bound,
/// reason and verdict.
[[nodiscard]] Data stress_suite_section(const std::vector<Family>& families);

/// Verdict, failures and counts of all checks.
[[nodiscard]] Data summary_section(const Results& results, const std::vector<Family>& families);

/// One sheet for an audit: verdict, counts, the largest known discrepancies with their validation
/// uncertainty, and the number of the others for each reason.
[[nodiscard]] Data audit_section(const Results& results, const std::vector<Family>& families,
                                 const Data& summary);

/// Known discrepancies by family, with their reasons.
[[nodiscard]] Data known_section(const Results& results, const std::vector<Family>& families);

/// Key numbers (tiles) and figures of the front page.
[[nodiscard]] Data front_section(const Results& results, const std::vector<Family>& families,
                                 const StudyFigures& figures);

/// Returns the checks of a case if they are few; else the worst entry of each check, and all checks
/// folded.
[[nodiscard]] Data case_tables(const CaseInfo& info, const std::vector<const Run*>& runs,
                               const Results& results);

/// Returns all checks of a case with all digits.
[[nodiscard]] Table checks_table(const CaseInfo& info, const std::vector<const Run*>& runs);

/// Differences from the paper with their validation uncertainty (ASME V&V 20), by family.
[[nodiscard]] Data validation_uncertainty_section(const std::vector<Family>& families);

/// Returns the tables that a case requests: variants down, quantities and timings across.
[[nodiscard]] Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs);

/// Sets tables of all validation uncertainties, of the first run with estimated discretization
/// errors, of the first run that selected its effects, and of the probabilities of readings. A
/// table without rows is false.
void set_run_tables(Data& data, const CaseInfo& info, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
