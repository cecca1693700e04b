#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/data/cost_study.h"

namespace trammel::reports {

/// What results.json says, as plain values in its own order. The schema stands in
/// cases/schema/results.schema.json; a number that the file gives as null is an empty optional.

using Number = std::optional<double>;
using Numbers = std::vector<Number>;

enum class Verdict { pass, fail, error, not_run, recorded };
enum class Status { solved, singular, not_converged, error, not_run };

/// Allowed range of a difference: +-high for a plain tolerance, [low, high] for a band or a bound;
/// an empty end is unbounded.
struct Tolerance {
  Number low, high;
  bool symmetric = false;  ///< written as one number
};

struct Check {
  std::string name, title, quantity, unit, reference, role, measure, why, message;
  /// Empty where the check compares an entry with a reference, both as they stand.
  std::string statistic, against_variant, against_quantity;
  std::optional<int> index;  ///< from 0
  Number computed, expected, difference;
  std::optional<Tolerance> tolerance;
  bool known_discrepancy = false;  ///< expected to differ, with a recorded reason
  Verdict verdict = Verdict::error;
};

/// One quantity refined over one parameter; all vectors have one entry a level.
struct Convergence {
  std::string sweep, quantity, reference;
  int index = 0;
  std::vector<double> parameter;
  Numbers values, error, roundoff, order, gci;
  std::vector<bool> in_asymptotic_range, at_roundoff_floor;
  Number exact, theory_order, fitted_order, richardson;
  Number lower_order;      ///< where two orders mix
  Number two_term_misfit;  ///< largest |law of two orders / error - 1|
};

/// One entry against the paper after ASME V&V 20: E = S - D and what it stands against. Standard
/// uncertainties, all in the quantity's unit.
struct Comparison {
  std::string check, quantity, reference, dominant_input, verdict, conclusion,
      all_inputs_conclusion;
  int index = 0;
  Number simulation, expected, difference, u_num, u_input, u_reference, u_val, all_inputs_u_val;
  Number dominant_share;  ///< of u_input squared
};

/// How good the bands of numerical uncertainty are, over all refinements with exact values.
struct UncertaintyCoverage {
  int levels = 0, covered = 0;
  Number min_coverage, median_ratio, max_median_ratio;
  bool passes = false;
};

using Point = std::pair<double, double>;  ///< (x, y) [m]

struct Joint {
  int node = 0;
  std::string kind, name;
};

struct Shape {
  std::string label;
  std::vector<Point> displacement;  ///< one a node [m]
};

struct Pose {
  std::string label;
  std::vector<Point> nodes;  ///< one a node of the drawing [m]
};

struct Drawing {
  std::vector<Point> nodes;
  std::vector<std::vector<int>> members, triangles;
  std::vector<Joint> joints;
  std::vector<Shape> shapes;
  std::vector<Pose> poses;  ///< further poses of the same mechanism
};

struct Cost {
  double wall_s = 0, cpu_s = 0;
  std::vector<std::pair<std::string, double>> timings;  ///< of one evaluation [s]
  std::vector<std::pair<std::string, double>> counters;
};

/// One effect in a run, and why it is there or not.
struct EffectRow {
  std::string name, number_definition, why;
  bool applicable = false, active = false;
  Number dimensionless_number, estimated_change;
};

struct Run {
  std::string case_id, variant, reason;
  Status status = Status::error;
  std::vector<std::pair<std::string, Numbers>> quantities;
  std::vector<Check> checks;
  std::vector<Convergence> convergence;
  std::vector<Comparison> comparisons;
  std::optional<Drawing> drawing;
  std::vector<EffectRow> effects;
  Cost cost;

  /// @returns nullptr when the run has no such quantity.
  [[nodiscard]] const Numbers* quantity(const std::string& name) const;
};

/// A plot that a case asks for: quantities `y` over the quantity `x`, for some of its variants.
struct PlotRequest {
  struct Line {
    std::string title, x, y;
  };
  std::string id, title, x, caption;
  std::vector<std::string> y, variants;
  bool log_x = false, log_y = false;  ///< a logarithmic scale, of magnitudes
  std::string value = {};             ///< in colours over x and the one y: a map; empty: curves
  std::vector<Line> lines = {};       ///< on a map
};

/// A column of a table that a case asks for: a statistic of a quantity, or one timing (over
/// another).
struct ColumnRequest {
  std::string title, quantity, statistic, timing, over_timing;
};

/// A number of each variant (all where none is named) in each column.
struct TableRequest {
  std::string title, caption;
  std::vector<ColumnRequest> columns;
  std::vector<std::string> variants;
};

/// The place of a case in the battery of hard cases: an item, and the checks that indicate how well
/// it is stood.
struct StressSuiteEntry {
  int item = 0;
  std::vector<std::string> indicators;
};

struct CaseInfo {
  std::string id, title, description, family;
  std::vector<std::string> labels;
  std::optional<StressSuiteEntry> stress_suite;
  std::vector<PlotRequest> figures;
  std::vector<TableRequest> tables;
  std::vector<std::pair<std::string, std::string>> variants;  ///< id, title

  [[nodiscard]] std::string variant_title(const std::string& variant) const;
};

struct Reference {
  std::string id, title, kind, unit, citation, doi, place, derivation, notes;
  Numbers values, uncertainty;
  std::vector<std::string> printed, errata;
};

/// One number that a reading of a claim rests on.
struct ClaimEntry {
  std::string case_id, variant;
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

struct Claims {
  std::string title;
  std::vector<Claim> claims;
};

struct Results {
  std::map<std::string, std::string> environment;
  std::vector<std::pair<std::string, std::string>> libraries;
  std::vector<CaseInfo> cases;
  std::vector<Reference> references;
  std::vector<Run> runs;
  std::optional<UncertaintyCoverage> uncertainty_coverage;
  std::optional<CostStudies> cost;  ///< what accuracy costs in time, where it was measured
  std::optional<Claims> claims;

  [[nodiscard]] const CaseInfo& case_info(const std::string& id) const;
  /// @returns nullptr for an unknown or empty id.
  [[nodiscard]] const Reference* reference(const std::string& id) const;
};

/// @throws std::runtime_error, one line with file and JSON pointer (byte offset for broken JSON).
[[nodiscard]] Results read_results(const std::filesystem::path& file);

[[nodiscard]] std::string to_string(Verdict verdict);
[[nodiscard]] std::string to_string(Status status);

}  // namespace trammel::reports
