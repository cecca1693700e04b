#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// The programs that re-derive references, by the name that a reference file gives in
/// "derivation": {"program": NAME, "arguments": {...}}.
namespace trammel::references {

struct Program {
  std::function<std::vector<double>(const Json&)> run;
  /// The same as proved enclosures: 30 digits each, the last uncertain by one; empty where there is
  /// no proof.
  std::function<std::vector<std::string>(const Json&)> prove = {};
};

/// What each derives, with its equation's source, and what it takes stands in programs.txt.
[[nodiscard]] const std::map<std::string, Program>& programs();

/// The values that a program gives, in SI.
/// @throws DerivationError  unknown program or unusable arguments; the pointer is relative to them.
[[nodiscard]] std::vector<double> derive(const std::string& program, const Json& arguments);

/// Prove what the programs frame-frequencies and beam-roots derive.
[[nodiscard]] std::vector<std::string> prove_frame_frequencies(const Json& arguments);
[[nodiscard]] std::vector<std::string> prove_beam_roots(const Json& arguments);

/// The values that a program proves, 30 digits each.
/// @throws DerivationError  where it has no proof, and as `derive`.
[[nodiscard]] std::vector<std::string> prove(const std::string& program, const Json& arguments);

}  // namespace trammel::references
