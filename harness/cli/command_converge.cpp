#include "harness/cli/command_converge.h"

#include <cmath>
#include <iostream>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/judge/uncertainty_summary.h"
#include "harness/printing/print_uncertainty.h"
#include "harness/run/results.h"
#include "harness/run/run.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

std::string note(const Convergence& found, std::size_t k) {
  if (found.at_roundoff_floor[k]) return "round-off";
  return found.in_asymptotic_range[k] ? "asymptotic" : "";
}

/// The two-term law of the relative error in words.
std::string law(const Convergence& found) {
  const results::Numbers& of = found.two_term->coefficients;
  return "error = " + rounded(*of[0], 4) + " h^" + rounded(*found.theory_order) + " + " +
         rounded(*of[1], 4) + " h^" + rounded(*found.lower_order) + " within " +
         rounded(100 * *found.two_term->max_relative_misfit, 2) + " %";
}

void print(const Convergence& series) {
  std::cout << "  " << (series.statistic.empty() ? "" : series.statistic + " of ")
            << series.quantity;
  if (series.statistic.empty()) std::cout << "[" << series.index << "]";
  if (series.exact)
    std::cout << ", exact " << shortest(*series.exact) << " (" << series.reference << ")";
  std::cout << '\n';
  Table table({">" + series.sweep, ">value", ">error", ">order", ">GCI", ">safety factor", ""});
  for (std::size_t k = 0; k < series.values.size(); ++k) {
    table.add({rounded(*series.parameter[k]), rounded(*series.values[k], 12),
               rounded(*series.error[k], 3), rounded(*series.order[k], 4),
               rounded(*series.gci[k], 3), rounded(*series.safety_factor[k], 3), note(series, k)});
  }
  table.print(std::cout, "    ");
  std::string last;
  if (series.theory_order) last += "order by theory " + rounded(*series.theory_order);
  if (series.lower_order) last += " and " + rounded(*series.lower_order);
  if (series.two_term) last += ", " + law(series);
  if (series.fitted_order) last += ", fitted " + rounded(*series.fitted_order, 4);
  if (series.richardson) {
    last += std::string(last.empty() ? "" : ", ") + "extrapolated " + shortest(*series.richardson);
    if (series.exact) {
      last += ", off by " +
              rounded(std::abs(*series.richardson - *series.exact) / std::abs(*series.exact), 2);
    }
  } else if (series.values.size() > 2) {
    last += std::string(last.empty() ? "" : ", ") + "no value that it converges to";
  }
  std::cout << wrapped(last, "    ") << '\n';
}

}  // namespace

int converge_command(const std::string& name, const std::string& variant, unsigned jobs,
                     bool json) {
  const Case given = load_named_case(name);
  if (!given.document.value().contains("sweeps")) {
    throw given.document.error("", "expected 'sweeps', which say what to refine");
  }
  if (!variant.empty()) (void)patched(given, variant);
  const References references;
  const std::vector<Run> runs =
      run_cases({given}, references, {variant, jobs, TrackedQuantities::all, {}});
  require_complete(runs);
  for (const Run& run : runs) {
    if (run.fault != results::Fault::none) {
      std::cerr << run.reason << '\n';
      return run.fault == results::Fault::input ? 2 : 3;
    }
    if (json) continue;
    std::cout << run.case_id << ":" << run.variant << "\n\n";
    for (const Convergence& found : run.convergence) print(found);
  }
  const int status = exit_status(runs) == 3 ? 3 : 0;
  if (json) {
    std::cout << pretty(to_json(results_of(runs, {given}, references)), kLineDepth);
    return status;
  }
  print_numerical_uncertainty(summarise_numerical_uncertainty(runs), std::cout);
  std::cout << "error: relative, of the exact value or else of the extrapolated one; GCI: grid\n"
               "convergence index with Roache's safety factor, 1.25 where the order is near "
               "theory, else 3\n";
  return status;
}

}  // namespace trammel::harness
