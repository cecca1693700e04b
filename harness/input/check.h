#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/input/json_view.h"
#include "harness/results/run_results.h"

/// Checks of a case, as read from "checks".
namespace trammel::harness {

enum class Role { verification, validation, regression };
template <>
inline constexpr std::array kWords<Role> = {"verification", "validation", "regression"};

/// Number that a check limits: relative or absolute difference of the computed from the expected
/// value, ratio of both values, or the computed value itself.
enum class Measure { relative, absolute, ratio, value };

using results::Expectation;

/// Interval in which the measure of a check must be; an open end is infinite.
struct Window {
  double low = 0, high = 0;
  [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
};

/// Reads [low, high]; null denotes an open end.
/// @throws InputError  if both ends are open, or the lower limit is above the upper.
[[nodiscard]] Window read_window(const JsonView& place);

/// Requirements for the observed order of convergence.
struct OrderCriterion {
  /// Condition for a fine mesh: wave number times element length is at most `at_most`.
  struct WaveNumber {
    std::string reference;
    std::vector<std::size_t> index;
    double at_most = 0;
    std::string pointer;
  };
  /// Predicted leading term of the relative error, as in the key "leading_term" of the schema.
  struct LeadingTerm {
    double coefficient = 0, within = 0;
    std::string share;  ///< share of the leading term, a reference; empty: 1
    std::string pointer;
  };
  std::string sweep;
  double within = 0;  ///< tolerance of the order; not used with `two_term_within`
  std::optional<double> two_term_within;  ///< tolerance of the two-term law, instead of `within`
  std::size_t meshes = 3;                 ///< required number of qualifying meshes
  bool of_errors = false;  ///< the quantity is itself an error and needs no reference
  std::optional<WaveNumber> wave_number;
  std::optional<LeadingTerm> leading_term;
  std::optional<double> richardson_within;
};

/// Required outcome of a check that is wrong on purpose.
struct NegativeControl {
  std::string verdict;               ///< required verdict of the worst entry: "fail" or "error"
  std::string message;               ///< required part of the message of the worst entry
  std::optional<std::size_t> index;  ///< required index of the worst entry; empty: any
};

struct Check {
  std::string name, title, quantity, statistic, reference, against_variant, against_quantity;
  std::vector<std::size_t> index, reference_index;  ///< selected entries; empty: all
  Role role = Role::verification;
  Measure measure = Measure::relative;
  std::vector<Window> windows;  ///< allowed intervals: one for all entries, or one per entry
  bool symmetric = false;       ///< a tolerance: the window is [-t, t]
  Expectation expectation = Expectation::agrees;
  std::string why;
  std::optional<OrderCriterion> order;
  std::optional<NegativeControl> negative_control;
  /// Recorded verdicts of the ASME V&V 20 comparisons, one per entry; empty: not recorded.
  std::vector<std::string> validation_verdicts;
  std::string pointer;  ///< JSON pointer of the check in the case

  /// Returns true if the check compares with a reference, a variant or another quantity.
  [[nodiscard]] bool has_target() const {
    return !reference.empty() || !against_variant.empty() || !against_quantity.empty();
  }
};

/// Reads the checks that apply to a variant of the case.
/// @param document  the case with the variant's patch
/// @param variants  names of all variants of the case
/// @throws InputError  if a check contradicts itself.
[[nodiscard]] std::vector<Check> read_checks(const Document& document, const std::string& variant,
                                             const std::vector<std::string>& variants);

[[nodiscard]] const char* to_string(Role role);
[[nodiscard]] const char* to_string(Measure measure);

}  // namespace trammel::harness
