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

/// What results.json says, as plain values in its own order: written by the harness, read by the
/// reports. The keys stand in fields of the source; cases/schema/results.schema.json describes the
/// file to others.
namespace trammel::results {

struct Environment {
  std::string trammel, commit, date, compiler, flags, build_type, processor, system;
  int cores = 0;
  int stored_runs = 0;  ///< that an earlier call had left, of the same program and input
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
};

/// A plot that a case asks for: quantities `y` over the quantity `x`, for some of its variants.
struct PlotRequest {
  struct Line {
    std::string title, x, y;
  };
  std::string id, title, x, caption;
  std::vector<std::string> y, variants;
  std::vector<std::string> log = {};  ///< axes with a logarithmic scale, of magnitudes
  std::string value = {};             ///< in colours over x and the one y: a map; empty: curves
  std::vector<Line> lines = {};       ///< on a map
  [[nodiscard]] bool is_log(const std::string& axis) const;
};

/// A column of a table that a case asks for: a statistic of a quantity, or one timing (over
/// another).
struct ColumnRequest {
  std::string id, title, quantity, timing, over_timing;
  std::string statistic;  ///< empty: the first entry
};

/// A number of each variant (all where none is named) in each column.
struct TableRequest {
  std::string id, title, caption;
  std::vector<ColumnRequest> columns;
  std::vector<std::string> variants;
};

/// The place of a case in the stress suite: an item, and the checks that show how well it is
/// solved.
struct StressSuiteEntry {
  int item = 0;
  std::vector<std::string> indicators;
};

struct Variant {
  std::string id, title;
};

struct CaseInfo {
  std::string id, title, description, family, analysis;
  std::vector<std::string> labels;
  std::optional<StressSuiteEntry> stress_suite;
  std::vector<PlotRequest> figures;
  std::vector<TableRequest> tables;
  std::vector<Variant> variants;
  std::string hash;  ///< of the case with all that it extends

  [[nodiscard]] std::string variant_title(const std::string& variant) const;
};

struct Reference {
  std::string id, title, kind, unit, citation, doi, place, derivation, notes;
  Numbers values, uncertainty;  ///< absolute half widths
  std::vector<std::string> printed, errata;
};

/// Coverage of the numerical uncertainty (GCI) over all refinements with exact values.
struct UncertaintyCoverage {
  std::size_t levels = 0, covered = 0, min_levels = 0;
  Number coverage, min_coverage;
  Number median_ratio, max_median_ratio;  ///< of GCI over true error
  bool passes = false;
};

/// One number that an interpretation of a claim rests on.
struct ClaimEntry {
  std::string case_id, variant, name;
  double value = 0;
};

struct ClaimInterpretation {
  std::string description, metric, unit, verdict;
  std::vector<ClaimEntry> entries;
};

/// A claim of the publication under examination; verdicts in words.
struct Claim {
  std::string id, claim, place, verdict, expected, conclusion, undecidable;
  std::vector<ClaimInterpretation> interpretations;
};

/// An equation, table, figure or statement of the publication, and what shows it.
struct PaperItem {
  struct Counterpart {
    std::string case_id, variant, quantity, figure;  ///< empty: all variants, quantities, no figure
    std::string verdict;                             ///< in words
  };
  std::string id, section, what;  ///< "equation-14"
  std::vector<Counterpart> shown_by = {};
  std::vector<std::string> claims = {};
  std::string reason = {};  ///< why there is no counterpart, or none can be judged
  std::string note = {};
};

struct Claims {
  std::string title;
  bool as_recorded = false;  ///< every verdict is the expected one
  std::vector<Claim> claims;
  std::vector<PaperItem> items = {};
};

/// What kinds of evidence there are for a feature of the program.
struct CoverageRow {
  std::string group, feature;  ///< "key", "pair" or "quantity"
  std::vector<std::string> evidence = {};
  std::string reason = {};     ///< why none of it is independent
  int series = 0, judged = 0;  ///< of a quantity: how many the runs hold, and how many are judged

  /// By anything but bounds and the solver's agreement with itself.
  [[nodiscard]] bool is_verified() const;
};

/// Automatic selection of effects in one scene.
struct EffectScene {
  std::string scene, analysis, chosen;  ///< the case, its kind of analysis, names of effects
  double tolerance = 0;                 ///< asked for [-]
  double change = 0;     ///< from all effects to the chosen ones, the largest of all kinds [-]
  bool minimal = false;  ///< no chosen effect could be left out
  double whole_s = 0, chosen_s = 0, deciding_s = 0;  ///< processor time [s]
  double work_ratio = 0;  ///< counted work of deciding and of the chosen effects over all effects
  double deciding_work_ratio = 0;  ///< of deciding alone
  Number mesh_change;              ///< from half the elements to all [-]
  Number beyond_tier;  ///< change by large displacement, if the analysis cannot compute it [-]
};

/// A solver other than trammel's, as its adapter names it.
struct Solver {
  std::string name, version, command;
};

/// What calls of the program came to over time.
struct HistoryCall {
  std::int64_t id = 0;
  std::string date, commit, machine;
  std::size_t runs = 0, checks = 0, failures = 0, work = 0;
  double cpu_s = 0;  ///< 0: not all of it was computed by this call
  [[nodiscard]] bool green() const { return failures == 0; }
};

/// Between the last green call before the newest one, and that.
struct HistoryChange {
  std::string name;  ///< run, check and entry; or run alone for its counted work
  std::string verdict_before, verdict;
  Number before, after;
  std::string commit, date;  ///< of the first call that had it
  [[nodiscard]] bool of_verdict() const { return verdict_before != verdict; }
};

/// A value that has gone one way in small steps, in at least three calls.
struct HistoryDrift {
  std::string name;
  std::size_t steps = 0;
  double first = 0, last = 0;
};

struct History {
  std::vector<HistoryCall> calls;      ///< oldest first
  std::int64_t since = 0;              ///< the green call that changes are counted from; 0: none
  std::vector<HistoryChange> changes;  ///< of verdicts first
  std::vector<HistoryChange> work;     ///< counted, exact
  std::vector<HistoryDrift> drifts;    ///< largest first
};

struct Results {
  int format = 2;  ///< 1 has no discretization errors
  Environment environment;
  std::vector<CaseInfo> cases;
  std::vector<Reference> references;
  std::vector<Run> runs;
  std::optional<Solver> solver;  ///< empty: trammel's own
  std::optional<UncertaintyCoverage> uncertainty_coverage;
  std::optional<CostStudies> cost;  ///< accuracy and computing time, where measured
  std::optional<Claims> claims;
  std::vector<CoverageRow> coverage;  ///< of the whole catalogue
  std::vector<EffectScene> effect_scenes;
  std::optional<History> history;  ///< the newest of its calls is these results
  std::string store;               ///< folder of what runs have stored, seen from that of the file
  std::string missing;  ///< what the store should hold and does not, in words; not written

  [[nodiscard]] const CaseInfo& case_info(const std::string& id) const;
  /// @returns nullptr for an unknown or empty id.
  [[nodiscard]] const Reference* reference(const std::string& id) const;
};

/// Largest number of entries of a quantity that a summary holds.
inline constexpr std::size_t kSummaryEntries = 1;

/// Writes shared names, reasons, citations and notes once, under /names, /reasons, /citations and
/// /notes; the places that share them hold an index.
/// @param summary  without the series, drawings and studies of runs that a store holds
[[nodiscard]] nlohmann::ordered_json to_json(const Results& results, bool summary = false);

/// Fills in titles that are left out with the names.
/// @throws std::runtime_error  with the JSON pointer of what does not fit the rest.
void complete(Results& results);

/// Complete, but without what runs have stored elsewhere.
/// @throws std::runtime_error  with the JSON pointer of what is absent, of a wrong type, or does
///                             not fit the rest.
[[nodiscard]] Results read_results(nlohmann::ordered_json json);

/// @throws std::runtime_error, one line with file and JSON pointer (byte offset for broken JSON).
[[nodiscard]] Results read_results(const std::filesystem::path& file);

}  // namespace trammel::results
