#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iostream>

#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/input/catalogue.h"
#include "harness/printing/printing.h"
#include "harness/run/results.h"
#include "harness/run/run.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

std::string note(const Convergence& found, std::size_t k) {
  if (found.at_roundoff_floor[k]) return "round-off";
  return found.in_asymptotic_range[k] ? "asymptotic" : "";
}

/// Describes the results of a refinement study: observed order of convergence, fitted error law and
/// extrapolated value.
std::string describe_convergence(const Convergence& found) {
  std::vector<std::string> parts;
  if (found.theory_order)
    parts.push_back("order by theory " + rounded(*found.theory_order) +
                    (found.lower_order ? " and " + rounded(*found.lower_order) : ""));
  if (found.two_term) {
    const results::Numbers& of = found.two_term->coefficients;
    parts.push_back(fmt::format("error = {:.4g} h^{} + {:.4g} h^{} within {:.2g} %", *of[0],
                                *found.theory_order, *of[1], *found.lower_order,
                                100 * *found.two_term->max_relative_misfit));
  }
  if (found.fitted_order) parts.push_back("fitted " + rounded(*found.fitted_order, 4));
  if (found.richardson) {
    parts.push_back("extrapolated " + shortest_decimal(*found.richardson));
    if (found.exact)
      parts.push_back(
          fmt::format("with a relative error of {:.2g}",
                      std::abs(*found.richardson - *found.exact) / std::abs(*found.exact)));
  } else if (found.values.size() > 2) {
    parts.emplace_back("the values do not converge");
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void print(const Convergence& found) {
  std::cout << "  "
            << (found.statistic.empty() ? fmt::format("{}[{}]", found.quantity, found.index)
                                        : found.statistic + " of " + found.quantity);
  if (found.exact)
    std::cout << ", exact " << shortest_decimal(*found.exact) << " (" << found.reference << ")";
  std::cout << '\n';
  Rows table({found.sweep.c_str(),
              {"value", "", 12},
              {"error", "", 3},
              {"order", "", 4},
              {"GCI", "", 3},
              {"safety factor", "", 3},
              ""});
  for (std::size_t k = 0; k < found.values.size(); ++k)
    table.add({*found.parameter[k], *found.values[k], *found.error[k], *found.order[k],
               *found.gci[k], *found.safety_factor[k], note(found, k)});
  table.print(std::cout, "    ");
  std::cout << wrapped(describe_convergence(found), "    ") << '\n';
}

}  // namespace

int converge_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const auto [given, variant] = load_case_variant(options.word, options.variant);
  if (!given.document.value().contains("sweeps"))
    throw given.document.error("", "expected 'sweeps', which define the refinement");
  if (!variant.empty()) (void)patched(given, variant);
  const References references;
  const std::vector<Run> runs =
      run_cases({given}, references, {variant, options.jobs, TrackedQuantities::all, {}});
  require_uninterrupted(runs);
  for (const Run& run : runs) {
    if (run.fault != results::Fault::none) {
      std::cerr << run.reason << '\n';
      return run.fault == results::Fault::input ? 2 : 3;
    }
    if (options.json) continue;
    std::cout << run.case_id << ":" << run.variant << "\n\n";
    for (const Convergence& found : run.convergence) print(found);
  }
  const int status = exit_status(runs) == 3 ? 3 : 0;
  const results::Results results = collect_results(runs, {given}, references);
  if (options.json) {
    std::cout << format_json(to_json(results), kLineDepth);
    return status;
  }
  print_numerical_uncertainty(results);
  std::cout << "error: relative to the exact value, else to the extrapolated value; GCI: grid\n"
               "convergence index with Roache's safety factor, 1.25 if the order is near "
               "the theoretical order, else 3\n";
  return status;
}

}  // namespace trammel::harness
