#pragma once

#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/input/check.h"
#include "harness/judge/input_uncertainty.h"
#include "harness/judge/validation_verdict.h"

/// The validation comparison of ASME V&V 20-2009 for the checks of a run that have the role
/// validation: what the refinement, the printed digits of the inputs and those of the reference
/// explain of the difference, and what is left to the model. Asked for by "uncertainty" in a case.
namespace trammel::harness {

/// An input known to so many digits, as the case states it.
struct StatedInput {
  std::string name, why;
  std::vector<std::string> pointers;  ///< places in the case that hold it and move together
  double half_width = 0;              ///< in the unit of the places
  bool nominal = false;  ///< a round design value: uncertain in the literal reading only
};

/// What the refinement says of one entry on the run's own mesh.
struct NumericalEstimate {
  std::string refinement, quantity;
  std::size_t index = 0;
  std::vector<double> parameter, values;  ///< the run's own mesh and two finer ones
  double order = 0;   ///< observed; NaN where the values do not approach a limit
  double factor = 0;  ///< Roache's, 1.25 or 3
  /// factor * |value - extrapolated value|, or where the values diverge their range: about 95 %
  /// [unit] (L. Eca, M. Hoekstra, J. Comput. Phys. 262, 2014)
  double half_width = 0;
};

/// One compared entry.
struct ComparedEntry {
  std::string check, quantity, unit, reference;
  std::size_t index = 0;
  Comparison comparison;
  Validation validation;
  double u_input_sampled = 0;
  std::vector<double> contribution;  ///< input: signed standard contribution, 0 for nominal ones
  std::string dominant;              ///< name of the input that matters most; empty: none matters
  double dominant_share = 0;         ///< of u_input^2
  /// What the paper's other rows print for this entry, minus what this one does; it takes no part.
  std::vector<double> spread;
  /// With the nominal inputs taken as literally as the others.
  Comparison literal_comparison;
  Validation literal;
  double u_input_literal_sampled = 0;
};

struct ValidationUncertainty {
  std::vector<StatedInput> inputs;  ///< those that this variant has as numbers
  int samples = 0, failed = 0, literal_samples = 0, literal_failed = 0;
  std::vector<NumericalEstimate> numerical;
  std::vector<ComparedEntry> entries;
  [[nodiscard]] bool empty() const { return entries.empty(); }
};

/// The inputs of a case or variant that has "uncertainty", without those that stand there as words.
/// @throws InputError  where a pointer leads nowhere
[[nodiscard]] std::vector<StatedInput> stated_inputs(const Document& document,
                                                     const References& references);

/// @param document  case or variant, solved with `result`; has "uncertainty"
/// @throws InputError  where a pointer leads nowhere or a patched model has no meaning.
[[nodiscard]] ValidationUncertainty evaluate_validation_uncertainty(
    const Document& document, const AnalysisResult& result, const std::vector<Check>& checks,
    const References& references);

}  // namespace trammel::harness
