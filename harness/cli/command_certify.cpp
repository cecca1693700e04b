#include <algorithm>
#include <cfenv>
#include <filesystem>
#include <iostream>
#include <utility>

#include "harness/analysis/analysis.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/cli/commands.h"
#include "harness/results/fields.h"
#include "harness/run/certification.h"
#include "harness/run/results.h"
#include "harness/run/run.h"
#include "harness/run/stored_results.h"

namespace trammel::results {

TRAMMEL_FIELDS(harness::ConfigurationRow, required("configuration", &S::name),
               TRAMMEL_REQUIRED(checks, missing, median_digits, fewest_digits),
               required("fewest_of", &S::least_certain));
TRAMMEL_FIELDS(harness::VerdictFlip, TRAMMEL_REQUIRED(check, configuration, from, to));
TRAMMEL_FIELDS(harness::TightTolerance, TRAMMEL_REQUIRED(check, configuration, tolerance, noise));
TRAMMEL_FIELDS(harness::Certification, required("configurations", &S::rows),
               TRAMMEL_REQUIRED(flips), required("tight_tolerances", &S::tight));

}  // namespace trammel::results

namespace trammel::harness {
namespace {

constexpr std::pair<const char*, int> kRounding[] = {{"to the nearest", FE_TONEAREST},
                                                     {"upwards", FE_UPWARD},
                                                     {"downwards", FE_DOWNWARD},
                                                     {"toward zero", FE_TOWARDZERO}};

std::vector<Configuration> compute_configurations(const std::vector<Case>& cases,
                                                  const CommandOptions& given) {
  const References references;
  std::vector<Configuration> configurations;
  for (const auto& [name, mode] : kRounding) {
    const RunOptions options{.jobs = given.jobs, .memory_bytes = given.memory_bytes};
    set_solver_rounding_mode(mode);
    const std::vector<Run> runs =
        run_with_progress(cases, references, options, std::string("runs rounding ") + name);
    set_solver_rounding_mode(FE_TONEAREST);
    configurations.push_back({name, collect_results(runs, cases, references)});
  }
  return configurations;
}

void print_certificate(const Json& certificate) {
  const auto print_rows = [&](const char* title, const char* key,
                              const std::vector<Column>& columns) {
    std::cout << title;
    Rows(columns, certificate[key]).print(std::cout, "  ");
  };
  print_rows("Digits (of 16) of checked numbers that equal those with rounding to the nearest\n",
             "configurations",
             {{"configuration"},
              {"checks"},
              {"missing"},
              {"median_digits", "digits (median)", 3},
              {"fewest_digits", "fewest", 3},
              {"fewest_of", "least certain"}});
  if (!certificate["tight_tolerances"].empty())
    print_rows("\nTolerances below ten times the noise (difference)\n", "tight_tolerances",
               {{"check"}, {"tolerance", "", 2}, {"noise", "", 2}, {"configuration"}});
  if (certificate["flips"].empty()) {
    std::cout << "\nNo verdict differs between the configurations, and none is missing.\n";
  } else {
    print_rows("\nVerdicts and runs that differ or are missing\n", "flips",
               {{"check", "check or run"}, {"from", "verdict"}, {"to", "now"}, {"configuration"}});
  }
}

/// Requires that stored results belong to the current case files. Otherwise, differences could also
/// be due to changed inputs.
void require_same_cases(const std::vector<Case>& cases, const std::filesystem::path& file,
                        const results::Results& stored) {
  for (const Case& one : cases) {
    const auto then = std::ranges::find(stored.cases, one.id(), &results::CaseInfo::id);
    if (then != stored.cases.end() && then->hash != case_hash(one))
      throw InputError(file.string(), "/cases/" + one.id() + "/hash",
                       "the results belong to another version of this case; compute them again");
  }
}

}  // namespace

int certify_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const std::vector<Case> cases = select_cases(options);
  std::vector<Configuration> stored;
  for (const std::string& name : options.builds) {
    const std::filesystem::path file = results_file_path(name);
    stored.push_back({name, read_results_json(file)});
    require_same_cases(cases, file, stored.back().results);
  }
  std::vector<Configuration> configurations = compute_configurations(cases, options);
  for (Configuration& build : stored) configurations.push_back(std::move(build));
  const Certification certificate = certify(configurations);
  const bool any = std::ranges::any_of(certificate.rows,
                                       [](const ConfigurationRow& row) { return row.checks > 0; });
  if (!any) throw InputError("no selected case has a check; expected a case with checks");
  const Json json = results::to_json(certificate);
  if (options.json) {
    std::cout << format_json(json, 2);
  } else {
    print_certificate(json);
  }
  return certificate.flips.empty() ? 0 : 1;
}

}  // namespace trammel::harness
