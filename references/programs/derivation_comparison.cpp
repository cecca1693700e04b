#include "references/programs/derivation_comparison.h"

#include <cmath>
#include <fstream>

#include "references/numerics/roots.h"
#include "references/programs/program.h"

namespace trammel::references {

namespace {

/// Half a unit in the last printed place: "12.768" -> 5e-4, "1.2e-3" -> 5e-5.
double half_unit_in_last_place(const std::string& printed) {
  const std::size_t exponent_at = printed.find_first_of("eE");
  const std::string mantissa = printed.substr(0, exponent_at);
  const int exponent =
      exponent_at == std::string::npos ? 0 : std::stoi(printed.substr(exponent_at + 1));
  const std::size_t dot = mantissa.find('.');
  const int decimals = dot == std::string::npos ? 0 : static_cast<int>(mantissa.size() - dot - 1);
  return 0.5 * std::pow(10.0, exponent - decimals);
}

std::vector<double> absolute_uncertainty(const Arguments& reference,
                                         const std::vector<double>& values) {
  std::vector<double> result;
  if (!reference.has("uncertainty")) {
    const std::vector<std::string> printed = reference.texts("printed");
    if (printed.size() != values.size()) reference.fail("printed", "expected one text a value");
    for (const std::string& text : printed) result.push_back(half_unit_in_last_place(text));
    return result;
  }
  const Arguments given(reference["uncertainty"], "/uncertainty", {"relative", "absolute"});
  if (given.has("relative")) {
    const auto relative = static_cast<double>(given.not_negative("relative", 0));
    for (const double value : values) result.push_back(relative * std::abs(value));
    return result;
  }
  if (given["absolute"].is_array()) return to_doubles(given.numbers("absolute", values.size()));
  return std::vector<double>(values.size(), static_cast<double>(given.not_negative("absolute", 0)));
}

/// A pointer of the program's arguments becomes one of the file.
std::string pointer_in_file(const std::string& message) {
  return message.rfind('/', 0) == 0 ? "/derivation/arguments" + message : "/derivation: " + message;
}

}  // namespace

bool Comparison::within_uncertainty() const {
  if (derived.size() != stored.size()) return false;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (!(std::abs(derived[i] - stored[i]) <= uncertainty[i])) return false;
  }
  return true;
}

Comparison compare_with_derivation(const Json& json) {
  const Arguments reference(json, "");
  Comparison result;
  result.id = reference.text("id");
  result.unit = reference.text("unit");
  result.stored = to_doubles(reference.numbers("values"));
  result.uncertainty = absolute_uncertainty(reference, result.stored);
  if (!reference.has("derivation")) return result;
  const Arguments derivation(reference["derivation"], "/derivation", {"program", "arguments"});
  result.program = derivation.text("program");
  try {
    result.derived = derive(result.program, derivation["arguments"]);
  } catch (const DerivationError& error) {
    throw DerivationError(pointer_in_file(error.what()));
  }
  return result;
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw DerivationError(file.generic_string() + ": cannot be read");
  try {
    return Json::parse(in);
  } catch (const Json::parse_error& error) {
    throw DerivationError(file.generic_string() + ": not JSON at byte " +
                          std::to_string(error.byte));
  }
}

}  // namespace trammel::references
