#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/input/json_view.h"
#include "harness/results/run_results.h"

/// What a case asks to be judged, as read from "checks".
namespace trammel::harness {

enum class Role { verification, validation, regression };
template <>
inline constexpr std::array kWords<Role> = {"verification", "validation", "regression"};

/// What is measured of a computed value: its difference from the expected one relative to that, the
/// difference itself, their ratio, or the value.
enum class Measure { relative, absolute, ratio, value };

using results::Expectation;

/// Where the measure must lie; infinite where a side is open.
struct Window {
  double low = 0, high = 0;
  [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
};

/// Reads [low, high], null where a side is open.
/// @throws InputError  if both sides are open, or the lower limit is above the upper.
[[nodiscard]] Window read_window(const JsonView& place);

/// Demands on the observed order of convergence.
struct OrderCriterion {
  struct WaveNumber {
    std::string reference;
    std::vector<std::size_t> index;
    double at_most = 0;
    std::string pointer;
  };
  struct LeadingTerm {
    double coefficient = 0, within = 0;
    std::string share;  ///< a reference; empty: 1
    std::string pointer;
  };
  std::string sweep;
  double within = 0;                      ///< of the order; not used with `two_term_within`
  std::optional<double> two_term_within;  ///< of the two-term law instead
  std::size_t meshes = 3;
  bool of_errors = false;  ///< the quantity is an error itself, and needs no reference
  std::optional<WaveNumber> wave_number;
  std::optional<LeadingTerm> leading_term;
  std::optional<double> richardson_within;
};

/// What a check that is wrong on purpose must come to.
struct NegativeControl {
  std::string verdict;               ///< of its worst entry: "fail" or "error"
  std::string message;               ///< a part of what is said of it
  std::optional<std::size_t> index;  ///< of the worst entry, where that is tried
};

struct Check {
  std::string name, title, quantity, statistic, reference, against_variant, against_quantity;
  std::vector<std::size_t> index, reference_index;  ///< empty: all
  Role role = Role::verification;
  Measure measure = Measure::relative;
  std::vector<Window> windows;  ///< one for all entries, or one for each
  bool symmetric = false;       ///< a tolerance: the window is -t, t
  Expectation expectation = Expectation::agrees;
  std::string why;
  std::optional<OrderCriterion> order;
  std::optional<NegativeControl> negative_control;
  std::vector<std::string> validation_verdicts;  ///< of V&V 20, by entry; empty: not recorded
  std::string pointer;                           ///< where it stands in the case

  [[nodiscard]] bool has_target() const {
    return !reference.empty() || !against_variant.empty() || !against_quantity.empty();
  }
};

/// The checks that apply to a variant of the case.
/// @param document  the case with the variant's patch
/// @param variants  names of all variants of the case
/// @throws InputError  where a check contradicts itself.
[[nodiscard]] std::vector<Check> read_checks(const Document& document, const std::string& variant,
                                             const std::vector<std::string>& variants);

[[nodiscard]] const char* to_string(Role role);
[[nodiscard]] const char* to_string(Measure measure);

}  // namespace trammel::harness
