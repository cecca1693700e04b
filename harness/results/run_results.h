#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/number.h"
#include "harness/base/quantity.h"
#include "harness/base/timing.h"

/// What results.json says of one run: one variant of a case.
namespace trammel::results {

using harness::Number;
using harness::Numbers;

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
/// The origin of an error: bad input, or trammel itself.
enum class Fault { none, input, internal };

/// Allowed range of a difference: +-high for a plain tolerance, [low, high] for a range or a bound;
/// a missing end is unbounded.
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

/// One number refined over one parameter, coarse to fine: what it is, then what the refinement
/// shows. All vectors have one entry a level.
struct Convergence {
  std::string sweep, quantity, statistic;
  std::string reference;  ///< of the exact value
  int index = 0;
  Numbers parameter;         ///< the swept number
  Numbers values, roundoff;  ///< the latter relative
  std::vector<double> size;  ///< h, to a common factor; not written
  Number exact;
  bool is_error = false;  ///< the values are errors themselves and `exact` is 0; not written
  Number theory_order;
  /// A second, lower order that takes over on fine meshes: error = a h^theory + b h^lower.
  Number lower_order;

  Numbers error;  ///< relative to the exact value, else to the extrapolated one
  Numbers order;  ///< observed between a level and the one before
  /// Error above 100 times the round-off error, and an order that agrees with a neighbor's within
  /// a tenth; where two orders mix, an error that the two-term law meets.
  std::vector<bool> in_asymptotic_range;
  std::vector<bool> at_roundoff_floor;  ///< error of at most 100 times the round-off error
  Number fitted_order;                  ///< slope over the asymptotic range
  Number richardson;                    ///< extrapolated value; missing if the values diverge
  std::optional<TwoTermLaw> two_term;   ///< of the relative error, where two orders mix
  /// Grid convergence index: relative half width of the interval in which the converged value is
  /// expected, from the values alone, with round-off error. Missing where they diverge.
  Numbers gci;
  /// Roache's factor in the index: 1.25 if the observed order is within a tenth of theory (with
  /// two orders: within a tenth of the range between them), else 3.
  Numbers safety_factor;
  bool broken = false;  ///< a level after the first finite one has no finite value; not written
};

struct SweepLevel {
  double parameter = 0;
  harness::Quantities quantities;  ///< empty where there is no solution
};

/// The same computation level by level.
struct Sweep {
  std::string name;
  std::vector<SweepLevel> levels;  ///< coarse to fine
};

/// An input that is known to so many digits, as the case states it.
struct UncertainInput {
  std::string name, why;
  std::vector<std::string> pointers;  ///< places in the case that hold it and move together
  Number half_width;                  ///< in the unit of the places
  bool nominal = false;  ///< a round design value, which is uncertain in `all_inputs` alone
};

/// Verdict of a comparison after ASME V&V 20.
struct ValidationVerdict {
  Number u_input, u_input_sampled;  ///< by derivatives, and by samples
  Number u_val;                     ///< root of u_num^2 + u_input^2 + u_reference^2
  Numbers interval;                 ///< of the model error, at about 95 %: E -+ 2 u_val
  std::string verdict;              ///< one of judge/validation_verdict.h
  std::string conclusion;
};

/// One entry against the paper after ASME V&V 20: E = S - D and its uncertainty. Standard
/// uncertainties, all in the quantity's unit.
struct Comparison : ValidationVerdict {
  std::string check, quantity, unit, reference;
  std::string dominant_input;  ///< the largest contribution; empty: none
  int index = 0;
  Number simulation, expected, difference;  ///< S, D, E
  Number u_num, u_reference;  ///< of the discretization, and of the printed digits of D
  Number dominant_share;      ///< of u_input squared
  /// Signed standard contribution of each input.
  std::vector<std::pair<std::string, Number>> contributions;
  /// The paper's other rows for this entry, minus `expected`; without influence on the verdict.
  Numbers spread;
  /// With nominal inputs as uncertain as their printed digits.
  ValidationVerdict all_inputs;
};

struct Uncertainty {
  std::vector<UncertainInput> inputs;  ///< those that this variant has as numbers
  int samples = 0, failed = 0, samples_all_inputs = 0, failed_all_inputs = 0;
  std::vector<Comparison> comparisons;
};

using Point = std::pair<double, double>;  ///< (x, y) [m]; NaN: not drawn

struct Joint {
  int node = 0;
  std::string kind;  ///< active, hinged, welded, rigid, sprung or support
  std::string name;
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

/// The contents of a picture of the model: the mesh, its joints, and shapes on it.
struct Drawing {
  std::vector<Point> nodes;
  std::vector<std::vector<int>> members, triangles;
  std::vector<Joint> joints;
  std::vector<Shape> shapes;
  std::vector<Pose> poses;  ///< further poses of the same mechanism
};

using Counters = std::vector<std::pair<std::string, std::size_t>>;

struct Cost {
  double wall_s = 0, cpu_s = 0;
  Counters counters;
  Number uncertainty_wall_s;  ///< of the validation comparison, which is not in wall_s
  std::vector<harness::EvaluationTime> timings;

  /// The sum of all counters.
  [[nodiscard]] std::size_t work() const;
};

/// One effect in a run, and the reason for its state.
struct EffectRow {
  std::string name, number_definition, why;
  bool applicable = false, active = false;
  std::int64_t evaluations = 0;
  Number dimensionless_number;
  Number own_change;         ///< relative change of the results without this effect alone
  Number cumulative_change;  ///< ... and without those removed before it
};

/// The estimated discretization error of a quantity: half widths of bands about its numbers.
struct ErrorEstimate {
  std::string quantity;
  Numbers relative;  ///< to each value or to `scale`, whichever is larger; of a curve one for all
  Number scale;      ///< largest value of its kind over the structure [unit]; none: each value
  Number order;      ///< lowest of the active parts; none: theory says that the values are exact
  bool asymptotic = true;  ///< false: too coarse for that order, a lower one is used
  std::string setting;     ///< JSON pointer of the setting that reduces the error most

  /// Half width about one of the quantity's values [unit].
  [[nodiscard]] Number half_width(std::size_t index, double value) const;
};

/// A setting of a search for an accuracy.
struct AccuracyStep {
  std::string setting;  ///< "8 elements, step 0.001 s"
  Number error;         ///< largest estimate of the requested quantities, relative
  double cpu_s = 0;
};

/// Discretization errors of a run, from coarser or finer companions of its computation. Errors of
/// the input and of the model are not included.
struct ErrorEstimates {
  std::vector<ErrorEstimate> quantities;
  std::string companions;            ///< "half the elements; twice the step"
  std::string reason;                ///< why there is no estimate; empty: there is
  Counters counters;                 ///< of the companions
  std::vector<AccuracyStep> search;  ///< by --accuracy, coarse to fine; the last is the run's
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

/// A solver other than trammel's, as it identifies itself.
struct SolverIdentity {
  std::string name, version;
  Number element_order;       ///< of convergence in the element size
  std::optional<int> digits;  ///< significant ones that it prints
};

/// Results of one computation and their judgement. The store and the process of the computation
/// hold the same fields.
struct Run {
  std::string case_id, variant, reason;
  Status status = Status::not_run;
  /// Residuals that decide whether it is solved, each over the magnitude of its terms.
  std::vector<std::pair<std::string, Number>> residuals;
  std::vector<std::string> warnings;
  harness::Quantities quantities;
  std::vector<Check> checks;
  std::vector<Convergence> convergence;
  std::optional<Uncertainty> uncertainty;
  std::vector<EffectRow> effects;
  std::optional<ErrorEstimates> errors;
  std::optional<ModelProbabilities> model_probabilities;
  std::optional<Drawing> drawing;
  Cost cost;
  /// File of the run store that holds its series, drawing and studies; empty: the results do.
  std::string stored;

  // In the store alone; sweeps no longer than until they are judged.
  std::vector<Sweep> sweeps;
  std::map<std::string, std::string> references;  ///< hashes by the place that was looked for
  std::string machine;                            ///< on which times were measured
  SolverIdentity solver;                          ///< other than trammel's

  Fault fault = Fault::none;  ///< of a run with the status error

  // Not written.
  int interrupted_by = 0;   ///< the signal that prevented the computation
  bool was_stored = false;  ///< by an earlier call

  [[nodiscard]] bool is_solved() const { return status == Status::solved; }
  /// @returns nullptr if the run has no such quantity.
  [[nodiscard]] const std::vector<double>* quantity(const std::string& name) const;
};

/// The difference of a check that measures `computed` against `expected`; missing for others.
[[nodiscard]] Number difference_of(const Check& check);
[[nodiscard]] std::string to_string(Verdict verdict);
[[nodiscard]] std::string to_string(Status status);

}  // namespace trammel::results
