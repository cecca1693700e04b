#include <algorithm>
#include <cmath>
#include <exception>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "references/data/family.h"
#include "references/data/reference.h"
#include "references/programs/program.h"

namespace trammel::references {

namespace {

std::string number_in_column(double value, int width, int digits) {
  std::ostringstream text;
  text << std::setw(width) << std::setprecision(digits) << value;
  return text.str();
}

int run_program(const std::string& name, const std::string& text, bool proving, std::ostream& out) {
  const Json arguments = Json::parse(text, nullptr, false);
  if (arguments.is_discarded()) throw DerivationError("--arguments: not JSON");
  if (proving) {
    for (const std::string& digits : prove(name, arguments)) out << digits << "\n";
    return 0;
  }
  for (const double value : derive_values(name, arguments))
    out << number_in_column(value, 0, 17) << "\n";
  return 0;
}

void print_values(const Comparison& comparison, std::ostream& out) {
  out << "  " << std::setw(24) << "stored" << std::setw(25) << "derived" << std::setw(12)
      << "difference" << std::setw(13) << "uncertainty"
      << "\n";
  for (std::size_t i = 0; i < comparison.stored.size(); ++i) {
    const double derived = i < comparison.derived.size() ? comparison.derived[i] : NAN;
    out << "  " << number_in_column(comparison.stored[i], 24, 17)
        << number_in_column(derived, 25, 17)
        << number_in_column(derived - comparison.stored[i], 12, 2)
        << number_in_column(comparison.uncertainty[i], 13, 3) << "\n";
  }
  if (comparison.derived.size() > comparison.stored.size())
    out << "  " << comparison.derived.size() - comparison.stored.size()
        << " derived values are not stored\n";
}

/// Prints the values of a proved reference whose stored digits differ from the proved digits.
void print_proved_digits(const Comparison& comparison, std::ostream& out) {
  const std::vector<std::string>&stored = comparison.printed, &proved = comparison.proved;
  if (stored.empty()) return;
  if (stored == proved) out << "  all digits stored are proved\n";
  if (stored.size() != proved.size())
    out << "  digits of " << stored.size() << " values stored, " << proved.size() << " proved\n";
  for (std::size_t i = 0; i < std::min(stored.size(), proved.size()); ++i) {
    if (stored[i] != proved[i])
      out << "  value " << i << ": stored " << stored[i] << ", proved " << proved[i] << "\n";
  }
}

bool print_comparison(const Comparison& comparison, std::ostream& out) {
  out << comparison.id << " [" << comparison.unit << "]";
  if (comparison.program.empty()) {
    out << ": no derivation\n";
    return true;
  }
  out << " by " << comparison.program << "\n";
  print_values(comparison, out);
  print_proved_digits(comparison, out);
  out << "  " << (comparison.within_uncertainty() ? "confirmed" : "NOT CONFIRMED") << "\n";
  return comparison.within_uncertainty();
}

/// Prints the comparisons of a family file, or of a single reference (FILE:ID).
bool print_comparisons(const std::string& place, std::ostream& out) {
  const std::size_t colon = place.rfind(".json:");
  const std::string file = colon == std::string::npos ? place : place.substr(0, colon + 5);
  auto family = read_family(file);
  if (colon != std::string::npos) {
    const std::string id = place.substr(colon + 6);
    if (family.count(id) == 0) throw DerivationError(file + ": /" + id + ": expected a reference");
    family = {{id, family.at(id)}};
  }
  bool holds = true;
  for (const auto& [id, reference] : family)
    holds = print_comparison(compare_with_derivation(reference, file, id), out) && holds;
  return holds;
}

int run(const std::vector<std::string>& command_line, std::ostream& out, std::ostream& err) {
  if (command_line.empty()) {
    err << embedded_text("usage.txt");
    return 2;
  }
  if (command_line[0] == "--help" || command_line[0] == "-h") {
    out << embedded_text("usage.txt");
    return 0;
  }
  if (command_line[0] == "--list" && command_line.size() == 1) {
    out << embedded_text("programs.txt");
    return 0;
  }
  const bool proving = command_line[0] == "--prove";
  if ((proving || command_line[0] == "--program") &&
      (command_line.size() == 2 ||
       (command_line.size() == 4 && command_line[2] == "--arguments"))) {
    return run_program(command_line[1], command_line.size() == 4 ? command_line[3] : "{}", proving,
                       out);
  }
  for (const std::string& argument : command_line) {
    if (argument.rfind("--", 0) == 0)
      throw DerivationError("cannot use '" + argument + "'; --help lists the options");
  }
  bool holds = true;
  for (const std::string& file : command_line) holds = print_comparisons(file, out) && holds;
  return holds ? 0 : 1;
}

}  // namespace

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
  const Reference reference = read_reference(json, file, id);
  result = {reference.id, "", reference.unit, reference.values, reference.uncertainty, {}, {}, {}};
  if (reference.kind == ReferenceKind::proved) result.printed = reference.printed;
  if (!json.contains("derivation")) return result;
  const Arguments derivation(json["derivation"], file + ": /" + id + "/derivation",
                             {"program", "arguments"});
  result.program = derivation.text("program");
  try {
    result.derived = derive_values(result.program, derivation["arguments"]);
    if (!result.printed.empty()) result.proved = prove(result.program, derivation["arguments"]);
  } catch (const DerivationError& error) {
    const std::string message = error.what();
    const bool is_pointer = message.rfind('/', 0) == 0;  // JSON pointer into the arguments
    throw DerivationError(
        (is_pointer ? derivation.pointer("arguments") : file + ": /" + id + "/derivation: ") +
        message);
  }
  return result;
}

int derive_command(const std::vector<std::string>& command_line, std::ostream& out,
                   std::ostream& err) {
  try {
    return run(command_line, out, err);
  } catch (const DerivationError& error) {
    err << "trammel_derive: " << error.what() << "\n";
    return 2;
  } catch (const ReferenceError& error) {
    err << "trammel_derive: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    err << "trammel_derive: internal error: " << error.what() << "\n";
    return 3;
  }
}

}  // namespace trammel::references
