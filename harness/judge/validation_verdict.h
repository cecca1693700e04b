#pragma once

#include <string>
#include <vector>

/// The validation comparison of ASME V&V 20-2009: E = S - D, and how much of it the numerical
/// error, the inputs and the printed digits of the reference can explain.
namespace trammel::harness {

/// A computed value and what it is compared with; u are standard uncertainties, all in one unit.
struct Comparison {
  double simulation = 0;   ///< S
  double reference = 0;    ///< D
  double u_num = 0;        ///< from the refinement
  double u_input = 0;      ///< from the printed digits of the inputs
  double u_reference = 0;  ///< u_D, from the printed digits of D
};

/// undecided: a number is missing, and nothing is claimed.
enum class ValidationVerdict {
  within_validation_uncertainty,
  beyond_validation_uncertainty,
  reference_inconsistent,
  undecided
};

struct Validation {
  double difference = 0;  ///< E = S - D
  double u_val = 0;       ///< root of u_num^2 + u_input^2 + u_D^2
  double low = 0;         ///< the model error lies between E - 2 u_val ...
  double high = 0;        ///< ... and E + 2 u_val, at about 95 % (V&V 20 section 6)
  ValidationVerdict verdict = ValidationVerdict::within_validation_uncertainty;
  std::string text;
};

inline constexpr double kCoverageFactor = 2;

/// Judges a row of values, such as frequencies in ascending order.
///
/// Where the model gives a repeated value by its symmetry (equal to 1e-6), the reference must too.
/// If it prints different ones, more than its digits allow, and the model's value lies between
/// them, then no model of this symmetry can do better: the reference contradicts itself. If the
/// model's value lies beyond all of them, the model is off all the same.
/// @param unit  for the words
[[nodiscard]] std::vector<Validation> evaluate_validation_row(const std::vector<Comparison>& row,
                                                              const std::string& unit);

/// "within-uncertainty", "model-error", "reference-inconsistent", "undecided"
[[nodiscard]] std::string to_string(ValidationVerdict verdict);

}  // namespace trammel::harness
