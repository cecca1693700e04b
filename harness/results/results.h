#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/results/cost_results.h"
#include "harness/results/run_results.h"

/// Contents of results.json as structs, in the order of the file. The harness writes the file and
/// the reports read it. result_fields.h defines the keys; cases/schema/results.schema.json
/// documents the file.
namespace trammel::results {

struct Environment {
  std::string trammel, commit, date, compiler, flags, build_type, processor, system;
  int cores = 0;
  /// Number of runs that were read from the store, because an earlier call with the same program
  /// and input computed them.
  int stored_runs = 0;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version of each library
};

/// A plot requested by a case: quantities `y` over the quantity `x`, for some variants of the case.
struct PlotRequest {
  struct Line {
    std::string title, x, y;
  };
  std::string id, title, x, caption;
  std::vector<std::string> y, variants;
  std::vector<std::string> log = {};  ///< axes ("x", "y") with a logarithmic scale of magnitudes
  /// Quantity of a map, shown as colors over `x` and the single `y`; empty: the plot shows curves.
  std::string value = {};
  std::vector<Line> lines = {};  ///< curves that are drawn on the map
  [[nodiscard]] bool is_log(const std::string& axis) const;
};

/// A column of a table requested by a case: a statistic of a quantity, or a timing, optionally
/// divided by another timing.
struct ColumnRequest {
  std::string id, title, quantity, timing, over_timing;
  std::string statistic;  ///< statistic of the quantity; empty: the first value is shown
};

/// A table requested by a case, with a row for each of `variants` (empty: all variants).
struct TableRequest {
  std::string id, title, caption;
  std::vector<ColumnRequest> columns;
  std::vector<std::string> variants;
};

/// Item number of a case in the stress suite of numerically difficult problems, and the names of
/// the checks that indicate the accuracy of the solution.
struct StressSuiteEntry {
  int item = 0;
  std::vector<std::string> indicators;
};

struct Variant {
  std::string id, title;
};

/// Input of a model: path of its key ("links/thickness_m"), value, and the file that states the
/// value if this file is not the case file.
struct CaseInput {
  std::string path, value, source;
};

struct CaseInfo {
  std::string id, title, description, family, analysis;
  std::string file;  ///< absolute path of the case file; empty for cases of the catalogue
  std::vector<std::string> labels;
  std::optional<StressSuiteEntry> stress_suite;
  std::vector<PlotRequest> figures;
  std::vector<TableRequest> tables;
  std::vector<Variant> variants;
  std::string hash;               ///< hash of the case with all cases that it extends
  std::vector<CaseInput> inputs;  ///< inputs of the model of the base variant

  [[nodiscard]] std::string variant_title(const std::string& variant) const;
};

struct Reference {
  std::string id, title, kind, unit, citation, doi, place, derivation, notes;
  Numbers values, uncertainty;  ///< values, and the absolute half-widths of their uncertainty
  std::vector<std::string> printed, errata, ambiguities;
};

/// Fraction of refinement levels whose grid convergence index (GCI) contains the exact value.
struct UncertaintyCoverage {
  std::size_t levels = 0, covered = 0, min_levels = 0;
  Number coverage, min_coverage;
  Number median_ratio, max_median_ratio;  ///< median ratio of GCI to true error, and its limit
  bool passes = false;
};

/// Computed number that determines the verdict on an interpretation of a claim.
struct ClaimEntry {
  std::string case_id, variant, name;
  double value = 0;
};

struct ClaimInterpretation {
  std::string description, metric, unit, verdict;
  std::vector<ClaimEntry> entries;
};

/// A claim of the publication under examination. Its verdict is a text such as "confirmed".
struct Claim {
  std::string id, title, claim, place, verdict, expected, conclusion, undecidable;
  std::vector<ClaimInterpretation> interpretations;
};

/// An equation, table, figure or statement of the publication, with the cases that reproduce it.
struct PaperItem {
  struct Counterpart {
    /// Case that reproduces the item, its variant (empty: all), its quantity (empty: all) and its
    /// figure (empty: none).
    std::string case_id, variant, quantity, figure;
    std::string verdict;  ///< verdict of the case's checks in words
  };
  std::string id, section, what;  ///< example of an id: "equation-14"
  std::vector<Counterpart> shown_by = {};
  std::vector<std::string> claims = {};
  std::string reason = {};  ///< reason why no case reproduces or judges the item
  std::string note = {};
};

struct Claims {
  std::string title;
  bool as_recorded = false;  ///< true if each verdict equals the expected verdict
  std::vector<Claim> claims;
  std::vector<PaperItem> items = {};
};

/// Feature of the program, such as a key of the case file, with the kinds of verification evidence
/// for it.
struct CoverageRow {
  std::string group, feature;  ///< the group is "key", "pair" or "quantity"
  std::vector<std::string> evidence = {};
  std::string reason = {};  ///< reason why independent evidence is missing
  /// For a quantity: number of its series in all runs, and number of series that a check judges.
  int series = 0, judged = 0;

  /// Returns true if the feature has evidence other than bounds and self-consistency of the solver.
  [[nodiscard]] bool is_verified() const;
};

/// Automatic selection of physical effects for one case (scene), compared with all effects.
struct EffectScene {
  std::string scene, analysis, chosen;  ///< case, analysis, names of the selected effects
  double tolerance = 0;                 ///< requested relative tolerance [-]
  double change = 0;  ///< largest relative change of the results from all to the selected effects
  bool minimal = false;  ///< true if no selected effect can be omitted within the tolerance
  /// Times of runs with all and with the selected effects, and time of the selection [s].
  double whole_s = 0, chosen_s = 0, deciding_s = 0;
  /// Counted work of the selection and of the run with selected effects, relative to the work of
  /// the run with all effects.
  double work_ratio = 0;
  double deciding_work_ratio = 0;  ///< relative work of the selection alone
  /// Relative change of the results if the number of elements is halved; computed with the selected
  /// effects.
  Number mesh_change;
  /// Relative change due to large displacement, if the analysis cannot represent that effect [-].
  Number beyond_tier;
};

/// A solver other than trammel, as identified by its adapter.
struct Solver {
  std::string name, version, command;
};

/// Totals of one call of `trammel run`, as recorded in the history.
struct HistoryCall {
  std::int64_t id = 0;
  std::string date, commit, machine;
  std::size_t runs = 0, checks = 0, failures = 0, work = 0;
  double cpu_s = 0;  ///< processor time [s]; 0 if an earlier call computed some of the runs
  [[nodiscard]] bool has_passed() const { return failures == 0; }
};

/// Change of a verdict or number from the last call of `trammel run` without failures (green) to
/// the newest call.
struct HistoryChange {
  std::string name;  ///< name of run, check and entry; for counted work, only of the run
  std::string verdict_before, verdict;
  Number before, after;
  std::string commit, date;  ///< commit and date of the first call with the change
  [[nodiscard]] bool verdict_changed() const { return verdict_before != verdict; }
};

/// Computed value that has increased, or decreased, by small steps in at least three calls of
/// `trammel run`.
struct HistoryDrift {
  std::string name;
  std::size_t steps = 0;
  double first = 0, last = 0;
};

struct History {
  std::vector<HistoryCall> calls;  ///< oldest first
  std::int64_t since = 0;  ///< id of the green call that is the baseline of changes; 0: none
  std::vector<HistoryChange> changes;  ///< changes of verdicts first, then of values
  std::vector<HistoryChange> work;     ///< changes of counted work, compared without tolerance
  std::vector<HistoryDrift> drifts;    ///< slow changes of values over several calls, largest first
};

struct Results {
  int format = 2;  ///< version of the format; version 1 has no discretization errors
  Environment environment;
  std::vector<CaseInfo> cases;
  std::vector<Reference> references;
  std::vector<Run> runs;
  std::optional<Solver> solver;  ///< solver that computed the runs; empty: trammel
  std::optional<UncertaintyCoverage> uncertainty_coverage;
  std::optional<CostStudies> cost;  ///< cost studies (accuracy and computing time), if measured
  std::optional<Claims> claims;
  std::vector<CoverageRow> coverage;  ///< evidence for each feature in the complete catalogue
  std::vector<EffectScene> effect_scenes;
  std::optional<History> history;  ///< earlier calls; the newest call produced these results
  std::string store;               ///< folder of stored runs, relative to the file's folder
  /// Message about data missing from the store; not written to results.json.
  std::string missing;

  [[nodiscard]] const CaseInfo& case_info(const std::string& id) const;
  /// @returns the reference with this id; nullptr for an unknown or empty id.
  [[nodiscard]] const Reference* reference(const std::string& id) const;
};

/// Maximum number of values of a quantity in a summary, which omits longer quantities.
inline constexpr std::size_t kSummaryEntries = 1;

/// Converts results to JSON. Names, reasons, citations and notes are written once, in the lists
/// /names, /reasons, /citations and /notes. Other objects contain indices into these lists.
/// @param summary  omits the series, drawings and studies of runs, which a store contains.
[[nodiscard]] nlohmann::ordered_json to_json(const Results& results, bool summary = false);

/// Sets missing titles to the ids, and requires that the results are consistent.
/// @throws std::runtime_error  with the JSON pointer of an inconsistent value.
void complete_and_validate(Results& results);

/// Reads results, except for data of runs that only the store contains.
/// @throws std::runtime_error  with the JSON pointer of an absent or inconsistent value, or of a
/// wrong type.
[[nodiscard]] Results read_results(nlohmann::ordered_json json);

/// @throws std::runtime_error  with file and JSON pointer in one line (byte offset for invalid
/// JSON).
[[nodiscard]] Results read_results(const std::filesystem::path& file);

}  // namespace trammel::results
