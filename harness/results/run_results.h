#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What results.json says of one run: one variant of a case.
namespace trammel::results {

using Number = std::optional<double>;  ///< null in the file where it is empty
using Numbers = std::vector<Number>;

/// recorded: a validation without an expectation; not given: a quantity that another solver does
/// not answer. Neither gates.
enum class Verdict { pass, fail, error, not_run, recorded, not_given };
enum class Expectation { agrees, known_discrepancy, none };
/// The last three of another solver alone: it has no such thing, it broke, it took too long.
enum class Status {
  solved,
  singular,
  not_converged,
  error,
  not_run,
  cannot,
  not_exported,
  crashed,
  timed_out
};

/// Allowed range of a difference: +-high for a plain tolerance, [low, high] for a range or a bound;
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
  Expectation expectation = Expectation::agrees;
  Verdict verdict = Verdict::error;

  /// Recorded as not agreeing, with a reason.
  [[nodiscard]] bool known_discrepancy() const {
    return expectation == Expectation::known_discrepancy;
  }
};

/// error = a h^p + b h^q, fitted.
struct TwoTermLaw {
  Numbers coefficients;        ///< a, b
  Number max_relative_misfit;  ///< largest |law / error - 1| over the levels used
  std::vector<bool> used;
};

/// One quantity refined over one parameter; all vectors have one entry a level.
struct Convergence {
  std::string sweep, quantity, statistic, reference;
  int index = 0;
  Numbers parameter, values, error, roundoff, order, gci, safety_factor;
  std::vector<bool> in_asymptotic_range, at_roundoff_floor;
  Number exact, theory_order, fitted_order, richardson;
  Number lower_order;  ///< where two orders mix
  std::optional<TwoTermLaw> two_term;
};

struct UncertainInput {
  std::string name, why;
  std::vector<std::string> pointers;
  Number half_width;
  bool nominal = false;
};

struct NumericalEstimate {
  std::string refinement, quantity;
  int index = 0;
  Numbers parameter, values;
  Number order, safety_factor, half_width;
};

/// The comparison with nominal inputs as uncertain as their printed digits.
struct AllInputsComparison {
  Number u_input, u_input_sampled, u_val;
  Numbers interval;
  std::string verdict, conclusion;
};

/// One entry against the paper after ASME V&V 20: E = S - D and its uncertainty. Standard
/// uncertainties, all in the quantity's unit.
struct Comparison {
  std::string check, quantity, unit, reference, dominant_input, verdict, conclusion;
  int index = 0;
  Number simulation, expected, difference, u_num, u_input, u_input_sampled, u_reference, u_val;
  Number dominant_share;  ///< of u_input squared
  std::vector<std::pair<std::string, Number>> contributions;
  Numbers spread, interval;
  AllInputsComparison all_inputs;
};

struct Uncertainty {
  std::vector<UncertainInput> inputs;
  int samples = 0, failed = 0, samples_all_inputs = 0, failed_all_inputs = 0;
  std::vector<NumericalEstimate> numerical;
  std::vector<Comparison> comparisons;
};

using Point = std::pair<double, double>;  ///< (x, y) [m]; NaN: not drawn

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
  std::vector<Point> nodes;              ///< one a node of the drawing [m]
  Number time_s = {};                    ///< of a moment of a motion
  std::vector<Point> displacement = {};  ///< from there, one a node [m]; empty: none
};

struct Drawing {
  std::vector<Point> nodes;
  std::vector<std::vector<int>> members, triangles;
  std::vector<Joint> joints;
  std::vector<Shape> shapes;
  std::vector<Pose> poses;  ///< further poses of the same mechanism
};

using Counters = std::vector<std::pair<std::string, std::size_t>>;

struct EvaluationTiming {
  std::string name;
  double per_evaluation_s = 0;
  std::size_t evaluations = 0;
};

struct Cost {
  double wall_s = 0, cpu_s = 0;
  Counters counters;
  Number uncertainty_wall_s;  ///< of the validation comparison, which is not in wall_s
  std::vector<EvaluationTiming> timings;
};

/// One effect in a run, and why it is there or not.
struct EffectRow {
  std::string name, number_definition, why;
  bool applicable = false, active = false;
  std::int64_t evaluations = 0;
  Number dimensionless_number, estimated_change;
};

/// Readings that a printed row cannot tell apart.
struct ReadingClass {
  std::string title;  ///< of the most probable one
  int readings = 0;
  Number probability;
  Numbers values;  ///< what it predicts at its best, in the row's unit
};

struct FurtherNumber {
  std::string name;
  Number expected_information_bits;
};

/// How probable each class of readings is, given one row of printed numbers.
struct RowProbabilities {
  std::string row, reference, unit;
  Number discrepancy, log_evidence, entropy_bits;
  Numbers printed;
  int readings = 0, classes = 0, credible_classes = 0;
  std::vector<ReadingClass> leading;  ///< most probable first
  std::vector<FurtherNumber> further_numbers;
};

/// Combinations of choices that have no meaning, by the reason.
struct ExcludedReadings {
  std::string reason, first;
  int readings = 0;
};

struct ModelProbabilities {
  std::vector<RowProbabilities> rows;
  std::vector<ExcludedReadings> excluded;
};

struct Run {
  std::string case_id, variant, reason;
  Status status = Status::error;
  /// What decided that it is solved, each over the magnitude of its terms.
  std::vector<std::pair<std::string, Number>> residuals;
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, Numbers>> quantities;
  std::vector<Check> checks;
  std::vector<Convergence> convergence;
  std::optional<Uncertainty> uncertainty;
  std::vector<EffectRow> effects;
  std::optional<ModelProbabilities> model_probabilities;
  std::optional<Drawing> drawing;
  Cost cost;
  /// File of the run store that holds its series, drawing and studies; empty: the results do.
  std::string stored;
  bool was_stored = false;  ///< by an earlier call; not written

  /// @returns nullptr when the run has no such quantity.
  [[nodiscard]] const Numbers* quantity(const std::string& name) const;
};

[[nodiscard]] std::string to_string(Verdict verdict);
[[nodiscard]] std::string to_string(Status status);

}  // namespace trammel::results
