#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "reports/data/check_text.h"
#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/figures/gallery.h"
#include "reports/text/files.h"
#include "reports/text/html.h"

/// The sections of the pages: each turns results into what its template finds.
namespace trammel::reports {

/// With text, class name and sign of a status: keys status_text, status_class, sign.
[[nodiscard]] Data with_status(CheckStatus status, std::initializer_list<Entry> entries = {});

/// Counts as a list of {n, status_text, status_class, sign, percent} without the zeros.
[[nodiscard]] Data counts_list(const Counts& counts);

/// Where a page and a place on it stand, seen from the folder of the report.
[[nodiscard]] std::string case_link(const std::string& id);
[[nodiscard]] std::string case_anchor(const std::string& id);  ///< where one file holds all
[[nodiscard]] std::string family_link(const std::string& id);
[[nodiscard]] std::string reference_link(const std::string& id);

/// The claims of the publication under examination, each with what was measured and a verdict;
/// empty where the results have no claims.
[[nodiscard]] Data claims_section(const Results& results);

/// A study of accuracy and computing time with its figure.
struct CostPanel {
  const CostStudy* study = nullptr;
  Figure figure;
};

struct CostPanels {
  std::vector<CostPanel> studies;
  std::vector<Figure> effects;  ///< of the automatic choice of effects

  [[nodiscard]] std::vector<Figure*> figures();
  [[nodiscard]] bool empty() const { return studies.empty() && effects.empty(); }
};

/// A panel for each study, its figures neither numbered nor drawn.
[[nodiscard]] CostPanels plan_cost(const Results& results);

/// Accuracy and computing time, study by study, and the computing time of the runs.
[[nodiscard]] Data cost_section(const Results& results, const std::vector<Family>& families,
                                const CostPanels& panels);

/// The selection of effects over the scenes of the catalogue.
[[nodiscard]] Data effects_section(const CostPanels& panels);

/// What is verified by what kind of evidence, and what by none.
/// @param with_verified  features with independent evidence, too
[[nodiscard]] Data coverage_section(const Results& results, bool with_verified);

/// The effects of the first run that chose its own: a row each, and a title that names those on.
/// Nothing where no run did.
void set_effects(Data& data, const std::vector<const Run*>& runs);

/// Machine, compiler, libraries.
[[nodiscard]] Data environment_section(const Results& results);

/// A case with its tables and (drawn) figures.
[[nodiscard]] Data case_section(const CaseInfo& info, const Family& family, const Results& results);

/// A family with what its cases have in common, and a line for each of them.
[[nodiscard]] Data family_section(const Family& family, const Results& results);

/// A drawn figure for its template.
[[nodiscard]] Data figure_data(const Figure& figure);

/// For every validation check that many variants make against a reference, or that has a validation
/// uncertainty: variants down, entries across, nearest first. @returns a list, empty where there is
/// none.
[[nodiscard]] Data comparison_matrices(const Family& family, const Results& results);

/// Observed orders beside those of theory, and the coverage of the numerical uncertainty.
[[nodiscard]] Data orders_section(const Results& results, const std::vector<Family>& families);

/// The provenance of all references used.
[[nodiscard]] Data references_section(const Results& results);

/// The stress suite: items in order, each indicator with its worst value, bound, reason and
/// verdict, and links to the pictures; empty where no case belongs to it.
[[nodiscard]] Data stress_suite_section(const std::vector<Family>& families);

/// Verdict, failures and counts of the entries of all checks.
[[nodiscard]] Data summary_section(const Results& results, const std::vector<Family>& families);
/// Known discrepancies by family, with their reasons.
[[nodiscard]] Data known_section(const Results& results, const std::vector<Family>& families);
/// Number of printed values that differ, each counted once.
[[nodiscard]] std::size_t count_printed(const Results& results);
/// Tiles and figures of the first page. @param printed  values that differ
[[nodiscard]] Data front_section(const Results& results, const std::vector<Family>& families,
                                 const CostPanels& panels, std::size_t printed);

/// The tables of a case: the checks themselves if they are few, else the worst of each with all of
/// them folded.
[[nodiscard]] Data case_tables(const CaseInfo& info, const std::vector<const Run*>& runs,
                               const Results& results);

/// All checks of a case with every digit.
[[nodiscard]] Table checks_table(const CaseInfo& info, const std::vector<const Run*>& runs);

/// Differences from the paper with their validation uncertainty, after ASME V&V 20, by family.
[[nodiscard]] Data validation_uncertainty_section(const std::vector<Family>& families);

/// The tables that a case asks for: variants down, quantities and timings across.
[[nodiscard]] Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs);

/// The quantities of the first run with estimated discretization errors, and these.
void set_errors(Data& data, const std::vector<const Run*>& runs);

/// For each row of printed numbers and each discrepancy: the most probable classes of readings with
/// what they predict, and what one further number would tell. Nothing where no run has them.
void set_model_probabilities(Data& data, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
