#include "references/programs/derivation_comparison.h"

#include <cmath>

#include "references/data/reference.h"
#include "references/programs/program.h"

namespace trammel::references {

bool Comparison::within_uncertainty() const {
  if (derived.size() != stored.size() || proved != printed) return false;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (!(std::abs(derived[i] - stored[i]) <= uncertainty[i])) return false;
  }
  return true;
}

Comparison compare_with_derivation(const Json& json, const std::string& file,
                                   const std::string& id) {
  Comparison result;
  try {
    const Reference reference = read_reference(json, file, id);
    result = {reference.id, "", reference.unit, reference.values, reference.uncertainty, {},
              {},           {}};
    if (reference.kind == ReferenceKind::proved) result.printed = reference.printed;
  } catch (const ReferenceError& error) {
    throw DerivationError(error.what());
  }
  if (!json.contains("derivation")) return result;
  const Arguments derivation(json["derivation"], file + ": /" + id + "/derivation",
                             {"program", "arguments"});
  result.program = derivation.text("program");
  try {
    result.derived = derive(result.program, derivation["arguments"]);
    if (!result.printed.empty()) result.proved = prove(result.program, derivation["arguments"]);
  } catch (const DerivationError& error) {
    const std::string message = error.what();
    const bool is_pointer = message.rfind('/', 0) == 0;  // into the arguments
    throw DerivationError(
        (is_pointer ? derivation.pointer("arguments") : file + ": /" + id + "/derivation: ") +
        message);
  }
  return result;
}

}  // namespace trammel::references
