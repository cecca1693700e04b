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

/// Results of one run, which is one variant of a case, in results.json.
namespace trammel::results {

using harness::Number;
using harness::Numbers;

/// recorded: a validation without an expectation. not_given: another solver does not compute the
/// quantity. These two never fail a run.
enum class Verdict { pass, fail, error, not_run, recorded, not_given };
enum class Expectation { agrees, known_discrepancy, none };
/// Status of a run. The last four apply only to other solvers.
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
/// Origin of an error: bad input, or an internal error.
enum class Fault { none, input, internal };

/// Allowed range of a difference: +-high for a plain tolerance, [low, high] for a range or a bound.
/// A missing end is unbounded.
struct Tolerance {
  Number low, high;
  bool symmetric = false;  ///< written as one number
};

struct Check {
  std::string name, title, quantity, unit, reference, role, measure, why, message;
  /// Empty if the check compares single entries with a reference.
  std::string statistic, against_variant, against_quantity;
  std::optional<int> index;  ///< index of the entry, from 0
  Number computed, expected, difference;
  std::optional<Tolerance> tolerance;
  Expectation expectation = Expectation::agrees;
  Verdict verdict = Verdict::error;

  /// Returns true if the disagreement is recorded with a reason.
  [[nodiscard]] bool known_discrepancy() const {
    return expectation == Expectation::known_discrepancy;
  }
};

/// Fitted law of the error: error = a h^p + b h^q.
struct TwoTermLaw {
  Numbers coefficients;        ///< a, b
  Number max_relative_misfit;  ///< largest |law / error - 1| over the levels used
  std::vector<bool> used;
};

/// One number refined over one parameter, coarse to fine: its identity and the results of the
/// refinement. All vectors have one entry per level.
struct Convergence {
  std::string sweep, quantity, statistic;
  std::string reference;  ///< reference of the exact value
  int index = 0;
  Numbers parameter;         ///< the swept number
  Numbers values, roundoff;  ///< the round-off is relative
  std::vector<double> size;  ///< h, up to a common factor; not written
  Number exact;
  bool is_error = false;  ///< the values are themselves errors and `exact` is 0; not written
  Number theory_order;
  /// A second, lower order that dominates on fine meshes: error = a h^theory + b h^lower.
  Number lower_order;

  Numbers error;  ///< errors relative to the exact value, or else to the extrapolated one
  Numbers order;  ///< observed between a level and the previous one
  /// Levels with an error above 100 times the round-off error and an order within a tenth of a
  /// neighbor's. If two orders mix, the two-term law must fit the error instead.
  std::vector<bool> in_asymptotic_range;
  std::vector<bool> at_roundoff_floor;  ///< error at most 100 times the round-off error
  Number fitted_order;                  ///< slope over the asymptotic range
  Number richardson;                    ///< extrapolated value; missing if the values diverge
  std::optional<TwoTermLaw> two_term;   ///< law of the relative error, if two orders mix
  /// Grid convergence index: relative half-width of the interval expected to contain the converged
  /// value. It uses the values alone and includes round-off error. Missing if the values diverge.
  Numbers gci;
  /// Roache's safety factor of the index: 1.25 if the observed order is within a tenth of theory,
  /// else 3. With two orders, within a tenth of the range between them.
  Numbers safety_factor;
  bool broken = false;  ///< a level after the first finite one has no finite value; not written
};

struct SweepLevel {
  double parameter = 0;
  harness::Quantities quantities;  ///< quantities of the level; empty without a solution
};

/// Results of one computation at all levels of a refinement.
struct Sweep {
  std::string name;
  std::vector<SweepLevel> levels;  ///< coarse to fine
};

/// An input known to a limited number of digits, as stated by the case.
struct UncertainInput {
  std::string name, why;
  std::vector<std::string> pointers;  ///< JSON pointers to its values, which change together
  /// Half-width of the uniform distribution, in the unit of these values.
  Number half_width;
  bool nominal = false;  ///< a round design value, uncertain only in `all_inputs`
};

/// Verdict of a comparison after ASME V&V 20.
struct ValidationVerdict {
  /// Uncertainty due to the inputs: by derivatives, and by sampling.
  Number u_input, u_input_sampled;
  Number u_val;         ///< sqrt(u_num^2 + u_input^2 + u_reference^2)
  Numbers interval;     ///< interval of the model error at about 95 %: E -+ 2 u_val
  std::string verdict;  ///< one of the words of judge/input_uncertainty.h
  std::string conclusion;
};

/// Comparison of one entry with the paper after ASME V&V 20: E = S - D and its uncertainty. All
/// uncertainties are standard uncertainties in the quantity's unit.
struct Comparison : ValidationVerdict {
  std::string check, quantity, unit, reference;
  std::string dominant_input;  ///< input with the largest contribution; empty: none
  int index = 0;
  Number simulation, expected, difference;  ///< S, D, E
  Number u_num, u_reference;  ///< uncertainty due to discretization, and to the printed digits of D
  Number dominant_share;      ///< fraction of u_input squared
  /// Signed standard contribution of each input.
  std::vector<std::pair<std::string, Number>> contributions;
  /// The paper's other rows for this entry, minus `expected`. They do not influence the verdict.
  Numbers spread;
  /// Verdict with nominal inputs as uncertain as their printed digits.
  ValidationVerdict all_inputs;
};

struct Uncertainty {
  std::vector<UncertainInput> inputs;  ///< inputs that this variant has as numbers
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
  std::vector<Point> displacement;  ///< displacement of each node [m]
};

struct Pose {
  std::string label;
  std::vector<Point> nodes;  ///< positions of the nodes of the drawing [m]
  Number time_s = {};        ///< time of a snapshot of a motion
  /// Displacement of each node from the pose [m]; empty: none.
  std::vector<Point> displacement = {};
};

/// Contents of a picture of the model: mesh, joints and shapes.
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
  Number uncertainty_wall_s;  ///< time of the validation comparison, not included in wall_s
  std::vector<harness::EvaluationTime> timings;

  /// Returns the sum of all counters.
  [[nodiscard]] std::size_t work() const;
};

/// One effect in a run, with the reason for its state.
struct EffectRow {
  std::string name, number_definition, why;
  bool applicable = false, active = false;
  std::int64_t evaluations = 0;
  Number dimensionless_number;
  Number own_change;         ///< relative change of the results without this effect alone
  Number cumulative_change;  ///< relative change without this effect and those already removed
};

/// Estimated discretization error of a quantity: half-widths of bands about its values.
struct ErrorEstimate {
  std::string quantity;
  Numbers relative;  ///< relative to each value or to `scale`, whichever is larger; a curve has a
                     ///< single entry
  /// Largest value of its kind over the structure [unit]; missing: each value itself.
  Number scale;
  Number order;  ///< lowest order of the active parts; missing: the values are exact in theory
  /// If false, the mesh is too coarse for `order`, so that a lower order is used.
  bool asymptotic = true;
  std::string setting;  ///< JSON pointer of the setting with the largest effect on the error

  /// Returns the half-width about one of the quantity's values [unit].
  [[nodiscard]] Number half_width(std::size_t index, double value) const;
};

/// A discretization tried in the search for a requested accuracy.
struct AccuracyStep {
  std::string setting;  ///< "8 elements, step 0.001 s"
  Number error;         ///< largest estimated relative error of the requested quantities
  double cpu_s = 0;
};

/// Discretization errors of a run, estimated from coarser or finer companion computations. Errors
/// of the input and of the model are not included.
struct ErrorEstimates {
  std::vector<ErrorEstimate> quantities;
  std::string companions;  ///< "half the elements; twice the step"
  std::string reason;      ///< reason for a missing estimate; empty: there is an estimate
  Counters counters;       ///< counted work of the companions
  /// Search for --accuracy, coarse to fine; the last entry is the run.
  std::vector<AccuracyStep> search;

  /// @returns nullptr if the quantity has no estimate.
  [[nodiscard]] const ErrorEstimate* find(const std::string& quantity) const;
};

/// Readings (interpretations of the paper's model) that predict the same printed row.
struct ReadingClass {
  std::string title;  ///< title of the most probable reading of the class
  int readings = 0;
  Number probability;
  Numbers values;  ///< its best prediction, in the row's unit
};

struct FurtherNumber {
  std::string name;
  Number expected_information_bits;
};

/// Probabilities of the classes of readings, given one row of printed numbers.
struct RowProbabilities {
  std::string row, reference, unit;
  Number discrepancy, log_evidence, entropy_bits;
  Numbers printed;
  int readings = 0, classes = 0, credible_classes = 0;
  std::vector<ReadingClass> leading;  ///< most probable first
  std::vector<FurtherNumber> further_numbers;
};

/// Meaningless combinations of choices, grouped by the reason.
struct ExcludedReadings {
  std::string reason, first;
  int readings = 0;
};

struct ModelProbabilities {
  std::vector<RowProbabilities> rows;
  std::vector<ExcludedReadings> excluded;
};

/// A solver other than trammel, as it identifies itself.
struct SolverIdentity {
  std::string name, version;
  Number element_order;       ///< order of convergence in the element size
  std::optional<int> digits;  ///< significant digits in its output
};

/// Results of one computation and their judgment. The store and the process of the computation use
/// the same fields.
struct Run {
  std::string case_id, variant, reason;
  Status status = Status::not_run;
  /// Residuals that decide whether the run is solved, each relative to the magnitude of its terms.
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
  /// File of the run store with its series, drawing and studies; empty: the results contain them.
  std::string stored;

  // Only in the store. Sweeps are removed after they have been judged.
  std::vector<Sweep> sweeps;
  std::map<std::string, std::string> references;  ///< hashes by the place of a reference
  std::string machine;                            ///< machine of the time measurements
  SolverIdentity solver;                          ///< solver that computed the run; empty: trammel

  Fault fault = Fault::none;  ///< origin of the status error

  // Not written.
  int interrupted_by = 0;   ///< signal that prevented the computation
  bool was_stored = false;  ///< true if an earlier call computed the run

  [[nodiscard]] bool is_solved() const { return status == Status::solved; }
  /// @returns nullptr if the run has no such quantity.
  [[nodiscard]] const std::vector<double>* quantity(const std::string& name) const;
  /// Returns the half-width of the band of the discretization error about an entry [unit]; missing
  /// without an estimate.
  [[nodiscard]] Number half_width(const std::string& name, std::size_t index) const;
};

/// Returns the difference of `computed` from `expected`; missing if a check does not compare.
[[nodiscard]] Number difference_of(const Check& check);
/// Returns the verdict in words. A known discrepancy that has left its recorded range is a changed
/// discrepancy.
[[nodiscard]] std::string verdict_text(const Check& check);
[[nodiscard]] std::string to_string(Verdict verdict);
[[nodiscard]] std::string to_string(Status status);

}  // namespace trammel::results
