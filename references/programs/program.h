#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// Programs that derive stored references again, and the command trammel_derive. A reference file
/// contains the program and its arguments as "derivation": {"program": NAME, "arguments": {...}}.
namespace trammel::references {

struct Program {
  std::function<std::vector<Real>(const Arguments&)> run;
  /// Returns the values of the program as proved enclosures with 30 digits. The last digit is
  /// uncertain by one unit. The function is empty if the program has no proof.
  std::function<std::vector<std::string>(const Arguments&)> prove = {};
};

/// Returns all programs by name. programs.txt lists the results, equations, sources and arguments.
[[nodiscard]] const std::map<std::string, Program>& programs();

/// Returns the values that a program derives from its arguments, in SI units.
/// @throws DerivationError  if the program is unknown, or if an argument is invalid. The message
/// then contains the JSON pointer of the argument.
[[nodiscard]] std::vector<double> derive_values(const std::string& program, const Json& arguments);

/// Return proved values of the programs frame-frequencies and beam-roots, 30 digits each.
[[nodiscard]] std::vector<std::string> prove_frame_frequencies(const Arguments& arguments);
[[nodiscard]] std::vector<std::string> prove_beam_roots(const Arguments& arguments);

/// Returns the values that a program proves, 30 digits each.
/// @throws DerivationError  if the program is unknown or has no proof, or if an argument is
/// invalid.
[[nodiscard]] std::vector<std::string> prove(const std::string& program, const Json& arguments);

struct Comparison {
  std::string id;
  std::string program;  ///< empty: the reference has no derivation
  std::string unit;
  std::vector<double> stored;
  std::vector<double> uncertainty;           ///< absolute uncertainty of each value
  std::vector<double> derived;               ///< empty if the reference has no derivation
  std::vector<std::string> printed, proved;  ///< stored and derived digits of kind "proved"

  /// Returns true if every derived value lies within the stated uncertainty of the stored value,
  /// and if the proved digits are the stored digits.
  [[nodiscard]] bool within_uncertainty() const;
};

/// Derives the values of a reference again and compares them with the stored values.
/// @param reference  JSON of the reference with the common keys of its family.
/// @param file  name of the file in messages.
/// @throws DerivationError, ReferenceError  with the file and the JSON pointer inside it.
[[nodiscard]] Comparison compare_with_derivation(const Json& reference, const std::string& file,
                                                 const std::string& id);

/// Runs the command trammel_derive.
/// @returns  the exit status: 0 all values agree, 1 a derived value differs from the stored one,
///           2 bad usage or input (one line on `err`), 3 internal error.
[[nodiscard]] int derive_command(const std::vector<std::string>& command_line, std::ostream& out,
                                 std::ostream& err);

/// Returns the text of programs.txt or usage.txt, which are built into the program.
/// @throws std::logic_error  if there is no such file.
[[nodiscard]] const std::string& embedded_text(const std::string& file);

}  // namespace trammel::references
