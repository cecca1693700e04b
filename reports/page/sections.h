#pragma once

#include <string>
#include <vector>

#include "reports/data/check_status.h"
#include "reports/data/results.h"
#include "reports/page/check_status_data.h"
#include "reports/page/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// The parts of the page as data for their templates, each in a source file of its own name.

/// What a section of the page comes to, in a sentence.
struct SectionSummary {
  std::string title, anchor, text;
};

/// What holds, what fails, the summaries in short, what is known not to agree and why.
[[nodiscard]] Data summary_section(const Results& results, const std::vector<Family>& families,
                                   const std::vector<SectionSummary>& summaries);

/// The claims of the publication under examination, each with what was measured and a verdict;
/// empty where the results have no ledger.
[[nodiscard]] Data claims_section(const Results& results);

/// The tables that a case asks for: variants down, quantities and timings across.
[[nodiscard]] Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs);

/// One family with its cases, tables and (drawn) figures.
[[nodiscard]] Data family_section(const Family& family, const Results& results);

/// The tables of a case: the checks themselves if they are few, else the worst of each with all of
/// them folded.
[[nodiscard]] Data case_tables(const CaseInfo& info, const std::vector<const Run*>& runs,
                               const Results& results);

/// The effects of the first run that chose its own: a row each, and a title that names those on.
/// Nothing where no run did.
void set_effects(Data& data, const std::vector<const Run*>& runs);

/// For every validation check that many variants make against a reference: variants down, entries
/// across, nearest first. @returns a list, empty where there is none.
[[nodiscard]] Data comparison_matrices(const Family& family, const Results& results);

/// What the matrix of such a check says in a sentence or two; empty if there is none.
[[nodiscard]] std::string comparison_conclusion(const Family& family, const Results& results,
                                                const Check& check);

/// The battery of hard cases: items in order, each indicator with its worst value, bound, reason
/// and verdict, and links to the pictures; empty where no case belongs to it.
[[nodiscard]] Data stress_suite_section(const std::vector<Family>& families);

/// Published targets beside better values and what comes out; empty rows where no case is labelled
/// as a benchmark.
[[nodiscard]] Data targets_section(const Results& results, const std::vector<Family>& families);

/// Observed orders beside those of theory, and how good the bands of numerical uncertainty are.
[[nodiscard]] Data orders_section(const Results& results, const std::vector<Family>& families);

/// Differences from the paper beside the noise that they stand against, after ASME V&V 20.
[[nodiscard]] Data validation_uncertainty_section(const Results& results,
                                                  const std::vector<Family>& families);

/// A study of what accuracy costs with its figure.
struct CostPanel {
  const CostStudy* study = nullptr;
  Figure figure;
};

/// A panel for each study, its figure neither numbered nor drawn.
[[nodiscard]] std::vector<CostPanel> plan_cost(const Results& results);

/// What accuracy costs in time, study by study, and where the time of the runs went.
[[nodiscard]] Data cost_section(const Results& results, const std::vector<Family>& families,
                                const std::vector<CostPanel>& panels);

/// A drawn figure for its template.
[[nodiscard]] Data figure_data(const Figure& figure);

/// The passports of all references used.
[[nodiscard]] Data references_section(const Results& results);

/// Machine, compiler, libraries.
[[nodiscard]] Data environment_section(const Results& results);

/// All checks of a case with every digit.
[[nodiscard]] Table checks_table(const CaseInfo& info, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
