#pragma once

#include <nlohmann/json.hpp>

namespace trammel::testing {

/// A results file as a real catalogue makes it, without any solver: several families, sixteen
/// variants against two references at two poses, refinement sweeps down to round-off, a circle of
/// 631 points, drawings with shapes, known discrepancies, and one of everything that goes wrong
/// (a failing check, a check without a number, one not run, a singular run, a run with an error).
/// Titles contain what HTML, XML, CSV and gnuplot must not take as theirs.
[[nodiscard]] nlohmann::ordered_json sample_results();

}  // namespace trammel::testing
