#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/input/json_view.h"
#include "harness/results/run_results.h"

/// Checks of a case: requirements for computed quantities, read from the key "checks".
namespace trammel::harness {

enum class Role { verification, validation, regression };
TRAMMEL_WORDS(Role, "verification", "validation", "regression");

/// Number that a check limits: relative or absolute difference of the computed from the expected
/// value, ratio of both values, or the computed value itself.
enum class Measure { relative, absolute, ratio, value };

using results::Expectation;

/// Interval that must contain the number limited by a check. A missing limit is infinite.
struct Window {
  double low = 0, high = 0;
  [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
};

/// Reads an interval [low, high] of JSON numbers. The value null denotes an infinite limit.
/// @throws InputError  if both limits are null, or the lower limit is above the upper limit.
[[nodiscard]] Window read_window(const JsonView& place);

/// Requirements for the observed order of convergence of a mesh refinement.
struct OrderCriterion {
  /// Condition for a mesh that is fine enough: wave number times element length is at most
  /// `at_most`.
  struct WaveNumber {
    std::string reference;
    std::vector<std::size_t> index;
    double at_most = 0;
    std::string pointer;
  };
  /// Predicted leading term of the relative discretization error (key "leading_term" of a check).
  struct LeadingTerm {
    double coefficient = 0, within = 0;
    /// Id of the reference with the fraction of the modal mass that belongs to the beam.
    std::string share;
    std::string pointer;
  };
  std::string sweep;
  double within = 0;  ///< tolerance of the observed order, unless `two_term_within` is set
  /// Tolerance of the error law a h^p + b h^q, which replaces the tolerance `within` of a single
  /// order.
  std::optional<double> two_term_within;
  std::size_t meshes = 3;  ///< required number of meshes that are fine enough
  bool of_errors = false;  ///< the quantity is itself an error and needs no reference
  std::optional<WaveNumber> wave_number;
  std::optional<LeadingTerm> leading_term;
  std::optional<double> richardson_within;
};

/// Required outcome of a negative control, which is a check that is wrong on purpose.
struct NegativeControl {
  std::string verdict;               ///< required verdict for the worst value: "fail" or "error"
  std::string message;               ///< required part of the message about the worst value
  std::optional<std::size_t> index;  ///< required index of the worst value; empty: any
};

struct Check {
  std::string name, title, quantity, statistic, reference, against_variant, against_quantity;
  std::vector<std::size_t> index, reference_index;  ///< indices of compared values; empty: all
  Role role = Role::verification;
  Measure measure = Measure::relative;
  std::vector<Window> windows;  ///< allowed intervals: one for all values, or one per value
  bool symmetric = false;       ///< true for a plain tolerance t, whose allowed interval is [-t, t]
  Expectation expectation = Expectation::agrees;
  std::string why;
  std::optional<OrderCriterion> order;
  std::optional<NegativeControl> negative_control;
  /// Expected verdicts of the ASME V&V 20 comparisons, one per value, as recorded in the case;
  /// empty if the case records no verdicts.
  std::vector<std::string> validation_verdicts;
  std::string pointer;  ///< JSON pointer of the check in the case

  /// Returns true if the check compares a quantity with a reference, a variant or another quantity.
  [[nodiscard]] bool has_comparison_target() const {
    return !reference.empty() || !against_variant.empty() || !against_quantity.empty();
  }
};

/// Reads the checks that apply to a variant of the case.
/// @param document  case to which the variant's patch has been applied
/// @param variants  names of all variants of the case
/// @throws InputError  if keys of a check contradict each other.
[[nodiscard]] std::vector<Check> read_checks(const Document& document, const std::string& variant,
                                             const std::vector<std::string>& variants);

[[nodiscard]] const char* to_string(Role role);
[[nodiscard]] const char* to_string(Measure measure);

}  // namespace trammel::harness
