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

/// Verdict of a check. recorded: the difference is recorded without judgment, because a validation
/// check states no expected difference, or because another solver need not reproduce earlier
/// results of trammel. not_given: another solver does not compute the quantity. The verdicts
/// recorded and not_given never fail a run.
enum class Verdict { pass, fail, error, not_run, recorded, not_given };
enum class Expectation { agrees, known_discrepancy, none };
/// Status of a run. The last four values apply only to solvers other than trammel.
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
/// If low or high is missing, the range is unbounded on that side.
struct Tolerance {
  Number low, high;
  bool symmetric = false;  ///< true: written as one number t for +-t
};

struct Check {
  std::string name, title, quantity, unit, reference, role, measure, why, message;
  /// Statistic of the quantity that is judged (empty: single entries); variant and quantity with
  /// which the quantity is compared (empty: none).
  std::string statistic, against_variant, against_quantity;
  std::optional<int> index;  ///< index of the judged entry of the quantity, from 0
  Number computed, expected, difference;
  std::optional<Tolerance> tolerance;
  Expectation expectation = Expectation::agrees;
  Verdict verdict = Verdict::error;

  /// Returns true if the case declares the difference between computed and expected value to be a
  /// known discrepancy.
  [[nodiscard]] bool is_known_discrepancy() const {
    return expectation == Expectation::known_discrepancy;
  }
};

/// Law of the discretization error, fitted over the element size h: error = a h^p + b h^q.
struct TwoTermLaw {
  Numbers coefficients;        ///< coefficients a and b
  Number max_relative_misfit;  ///< largest |law / error - 1| over the fitted levels
  std::vector<bool> used;
};

/// Convergence of one computed number during the refinement of one parameter. All vectors have one
/// entry per level of refinement, from coarse to fine.
struct Convergence {
  std::string sweep, quantity, statistic;
  std::string reference;  ///< id of the reference with the exact value
  int index = 0;
  Numbers parameter;         ///< values of the refined parameter, such as elements
  Numbers values, roundoff;  ///< values, and their relative round-off errors
  std::vector<double> size;  ///< element size h, up to a common factor; not written
  Number exact;
  bool is_error = false;  ///< true: the values are errors, and `exact` is 0; not written
  Number theory_order;
  /// Second, lower theoretical order of convergence, which dominates on fine meshes: error = a
  /// h^theory + b h^lower.
  Number lower_order;

  Numbers error;  ///< error relative to the exact value, or else to `richardson`
  Numbers order;  ///< observed order between a level and the previous level
  /// True for refinement levels with an error above 100 times the round-off error, and an observed
  /// order within 10 % of that of a neighboring level. If two orders mix, the two-term law must fit
  /// the error instead.
  std::vector<bool> in_asymptotic_range;
  std::vector<bool> at_roundoff_floor;  ///< true: error at most 100 times the round-off
  Number fitted_order;                  ///< slope log error / log h in the asymptotic range
  Number richardson;                    ///< extrapolated value; missing if the values diverge
  std::optional<TwoTermLaw> two_term;   ///< law of the relative error, if two orders mix
  /// Grid convergence index: relative half-width of the interval expected to contain the converged
  /// value. The index does not use the exact value, and includes round-off errors. Missing if the
  /// values diverge.
  Numbers gci;
  /// Roache's safety factor of the grid convergence index: 1.25 if the observed order is within 10
  /// % of the theoretical order, else 3. If two orders mix, the observed order may be anywhere
  /// between the two theoretical orders.
  Numbers safety_factor;
  bool broken = false;  ///< a level after the first finite one has no finite value; not written
};

struct SweepLevel {
  double parameter = 0;
  /// Quantities computed on the refinement level; empty without a solution.
  harness::Quantities quantities;
};

/// Results of one computation at all levels of a mesh or time step refinement.
struct Sweep {
  std::string name;
  std::vector<SweepLevel> levels;  ///< coarse to fine
};

/// An input known to a limited number of digits, as stated by the case.
struct UncertainInput {
  std::string name, why;
  /// JSON pointers of the numbers in the case that state this input.
  std::vector<std::string> pointers;
  /// Half-width of the uniform distribution of the input, in the unit of the input.
  Number half_width;
  /// True: a rounded design value, which counts as uncertain only in Comparison::all_inputs.
  bool nominal = false;
};

/// Verdict of a validation comparison after ASME V&V 20.
struct ValidationVerdict {
  /// Standard uncertainty due to the inputs, computed by derivatives and by sampling.
  Number u_input, u_input_sampled;
  Number u_val;         ///< validation uncertainty sqrt(u_num^2 + u_input^2 + u_reference^2)
  Numbers interval;     ///< interval of the model error with 95 % confidence: E -+ 2 u_val
  std::string verdict;  ///< one of the verdicts in judge/input_uncertainty.h
  std::string conclusion;
};

/// Comparison of a computed value S with a printed value D after ASME V&V 20: error E = S - D and
/// its uncertainty. All uncertainties are standard uncertainties in the quantity's unit.
struct Comparison : ValidationVerdict {
  std::string check, quantity, unit, reference;
  std::string dominant_input;  ///< input with the largest contribution; empty: none
  int index = 0;
  Number simulation, expected, difference;  ///< S, D and E = S - D
  Number u_num, u_reference;  ///< uncertainty due to discretization, and to the printed digits of D
  Number dominant_share;      ///< fraction of u_input^2 due to `dominant_input`
  /// Signed contribution of each input to u_input.
  std::vector<std::pair<std::string, Number>> contributions;
  /// Values that other references print for the same computed value, each minus `expected`. The
  /// verdict ignores these values.
  Numbers spread;
  /// Verdict if nominal design values also count as uncertain inputs, with the uncertainty of their
  /// printed digits.
  ValidationVerdict all_inputs;
};

struct Uncertainty {
  std::vector<UncertainInput> inputs;  ///< uncertain inputs that are numbers in this variant
  int samples = 0, failed = 0, samples_all_inputs = 0, failed_all_inputs = 0;
  std::vector<Comparison> comparisons;
};

using Point = std::pair<double, double>;  ///< coordinates (x, y) [m]; NaN: the point is not drawn

struct Joint {
  int node = 0;
  std::string kind;  ///< type: active, hinged, welded, rigid, sprung or support
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
  /// Displacement of each node from `nodes` [m]; empty: no displacement.
  std::vector<Point> displacement = {};
};

/// Arrow in the drawing of a model: a force at a node, or a uniform load at the end of an element.
struct DrawnForce {
  int node = 0;
  double x = 0, y = 0;
  std::string unit;  ///< unit of the force: N or N/m
};

/// Drawing of the model: mesh (nodes, members, triangles), joints, and deformed or mode shapes.
struct Drawing {
  std::vector<Point> nodes;
  std::vector<std::vector<int>> members, triangles;
  std::vector<Joint> joints;
  std::vector<Shape> shapes;
  std::vector<Pose> poses;  ///< further poses of the mechanism, or instants of its motion
  std::vector<DrawnForce> forces;
};

using Counters = std::vector<std::pair<std::string, std::size_t>>;

struct Cost {
  double wall_s = 0, cpu_s = 0;
  Counters counters;
  Number uncertainty_wall_s;  ///< time of the validation comparison, not included in wall_s
  std::vector<harness::EvaluationTime> timings;

  /// Returns the counted work, which is the sum of all counters.
  [[nodiscard]] std::size_t counted_work() const;
};

/// One physical effect in a run, such as rotary inertia, and the reason why it is active or not.
struct EffectRow {
  std::string name, number_definition, why;
  bool applicable = false, active = false;
  std::int64_t evaluations = 0;
  Number dimensionless_number;
  Number own_change;         ///< relative change of the results without this effect
  Number cumulative_change;  ///< relative change without this and previously removed effects
};

/// Estimated discretization error of a quantity: half-widths of error bands about its values.
struct ErrorEstimate {
  std::string quantity;
  /// Relative error of each value: relative to the value or to `scale`, whichever is larger. A
  /// curve has a single entry.
  Numbers relative;
  /// Scale of the error: largest value of all quantities of the same kind, such as all
  /// displacements [unit]. If the scale is missing, the error is relative to each value.
  Number scale;
  Number order;  ///< lowest order of all discretizations; missing: the values are exact in theory
  /// False if the mesh or time step is too coarse for convergence with the order `order`. The
  /// estimate then assumes a lower order.
  bool asymptotic = true;
  std::string setting;  ///< JSON pointer of the mesh or step key that affects the error most

  /// Returns the half-width of the error band about one of the quantity's values [unit].
  [[nodiscard]] Number error_half_width(std::size_t index, double value) const;
};

/// Mesh and time step tried in the search for a requested accuracy.
struct AccuracyStep {
  std::string setting;  ///< for example "elements 8, step 0.001"
  Number error;         ///< largest estimated relative error of the requested quantities
  double cpu_s = 0;
};

/// Discretization errors of a run, estimated from further computations with a coarser or finer mesh
/// or time step (companions). Errors of the input and of the model are not included.
struct ErrorEstimates {
  std::vector<ErrorEstimate> quantities;
  /// Changes of the discretization for the coarser or finer computations, for example "half the
  /// elements; twice the step".
  std::string companions;
  std::string reason;  ///< reason for a missing estimate; empty: there is an estimate
  Counters counters;   ///< counted work of the coarser or finer computations
  /// Discretizations tried for the option --accuracy, coarse to fine; the last one is this run.
  std::vector<AccuracyStep> search;

  /// @returns nullptr if the quantity has no estimate.
  [[nodiscard]] const ErrorEstimate* find(const std::string& quantity) const;
};

/// Readings (interpretations of the model in the examined publication) that predict the same values
/// for a row of printed numbers.
struct ReadingClass {
  std::string title;  ///< title of the most probable reading of the class
  int readings = 0;
  Number probability;
  Numbers values;  ///< values that the class predicts for the row [unit of the row]
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
  std::vector<ReadingClass> leading;  ///< classes of readings, most probable first
  std::vector<FurtherNumber> further_numbers;
};

/// Readings of the model that are excluded because their combination of modeling choices is
/// meaningless.
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
  std::optional<int> digits;  ///< significant digits that the solver prints
};

/// Results of one computation and their judgment. The run store contains the same fields.
struct Run {
  std::string case_id, variant, reason;
  Status status = Status::not_run;
  /// Relative residuals that decide whether the run is solved, by name.
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
  /// File of the run store with series, drawing and studies; empty: this struct contains them.
  std::string stored;

  // The following members are written only in the store.
  std::vector<Sweep> sweeps;
  std::map<std::string, std::string> references;  ///< hash of each reference file, by path
  std::string machine;                            ///< machine of the time measurements
  SolverIdentity solver;                          ///< solver that computed the run; empty: trammel

  Fault fault = Fault::none;  ///< origin of the error, if the status is `error`

  // The following members are written neither to results.json nor to the store.
  int interrupted_by = 0;   ///< signal that prevented the computation
  bool was_stored = false;  ///< true if an earlier call computed the run

  [[nodiscard]] bool is_solved() const { return status == Status::solved; }
  /// @returns nullptr if the run has no such quantity.
  [[nodiscard]] const std::vector<double>* quantity(const std::string& name) const;
  /// Returns the half-width of the band of the discretization error about an entry [unit]; missing
  /// without an estimate.
  [[nodiscard]] Number error_half_width(const std::string& name, std::size_t index) const;
};

/// Returns the difference between `computed` and `expected`; missing if the check is a bound.
[[nodiscard]] Number difference_of_check(const Check& check);
/// Returns the verdict in words. A known discrepancy that has left its recorded range is a changed
/// discrepancy.
[[nodiscard]] std::string verdict_text(const Check& check);
[[nodiscard]] std::string to_string(Verdict verdict);
[[nodiscard]] std::string to_string(Status status);

}  // namespace trammel::results
