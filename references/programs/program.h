#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// The programs that derive references again, by the name that a reference file gives in
/// "derivation": {"program": NAME, "arguments": {...}}, and the command trammel_derive.
namespace trammel::references {

struct Program {
  std::function<std::vector<Real>(const Arguments&)> run;
  /// The same as proved enclosures: 30 digits each, the last uncertain by one; empty where there is
  /// no proof.
  std::function<std::vector<std::string>(const Arguments&)> prove = {};
};

/// Returns the program of a name. programs.txt lists what each program derives, the source of its
/// equation and its arguments.
[[nodiscard]] const std::map<std::string, Program>& programs();

/// The values that a program gives, in SI.
/// @throws DerivationError  unknown program or unusable arguments; the pointer is relative to them.
[[nodiscard]] std::vector<double> derive(const std::string& program, const Json& arguments);

/// Prove what the programs frame-frequencies and beam-roots derive.
[[nodiscard]] std::vector<std::string> prove_frame_frequencies(const Arguments& arguments);
[[nodiscard]] std::vector<std::string> prove_beam_roots(const Arguments& arguments);

/// The values that a program proves, 30 digits each.
/// @throws DerivationError  if it has no proof, and as `derive`.
[[nodiscard]] std::vector<std::string> prove(const std::string& program, const Json& arguments);

/// @param command_line  the words of it, without the program's name.
/// @returns the exit status: 0 everything holds, 1 a stored value is not what comes out, 2 bad
///          usage or input (one line on `err`), 3 our own fault.
[[nodiscard]] int derive_command(const std::vector<std::string>& command_line, std::ostream& out,
                                 std::ostream& err);

/// The text of a file that is built into the program, by its name. @throws std::logic_error  if
/// there is no such file.
[[nodiscard]] const std::string& embedded_text(const std::string& file);

}  // namespace trammel::references
