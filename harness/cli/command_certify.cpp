#include "harness/cli/command_certify.h"

#include <algorithm>
#include <cfenv>
#include <filesystem>
#include <iostream>
#include <utility>

#include "harness/analysis/analysis.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
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
                                                     {"towards zero", FE_TOWARDZERO}};

std::vector<Configuration> computed(const std::vector<Case>& cases, const RunCommand& command) {
  const References references;
  std::vector<Configuration> configurations;
  for (const auto& [name, mode] : kRounding) {
    RunOptions options;
    options.jobs = command.jobs;
    options.memory_bytes = command.memory_bytes;
    set_solver_rounding(mode);
    const std::vector<Run> runs =
        run_shown(cases, references, options, std::string("runs rounded ") + name);
    set_solver_rounding(FE_TONEAREST);
    configurations.push_back({name, results_of(runs, cases, references)});
  }
  return configurations;
}

std::string digits_text(double digits) {
  return digits >= 16 ? "all" : rounded(digits, 3);
}

void print(const Certification& certificate) {
  Table rows({"configuration", ">checks", ">missing", ">digits (median)", ">fewest", "of"});
  for (const ConfigurationRow& row : certificate.rows)
    rows.add({row.name, std::to_string(row.checks), std::to_string(row.missing),
              digits_text(row.median_digits), digits_text(row.fewest_digits), row.least_certain});
  rows.print(std::cout, "");
  std::cout << "digits of judged numbers that agree with those rounded to the nearest\n";
  if (!certificate.tight.empty()) {
    std::cout << "\nTolerances less than ten times the noise\n";
    Table tight({"check", ">tolerance", ">noise", "configuration"});
    for (const TightTolerance& one : certificate.tight)
      tight.add({one.check, rounded(one.tolerance, 2), rounded(one.noise, 2), one.configuration});
    tight.print(std::cout, "  ");
  }
  if (certificate.flips.empty()) {
    std::cout << "\nNo verdict differs, and none is missing.\n";
    return;
  }
  std::cout << "\nVerdicts and runs that differ or are missing\n";
  Table flips({"check or run", "verdict", "is", "configuration"});
  for (const VerdictFlip& flip : certificate.flips)
    flips.add({flip.check, flip.from, flip.to, flip.configuration});
  flips.print(std::cout, "  ");
}

/// Results of another input differ by it, not by how they were computed.
void require_same_cases(const std::vector<Case>& cases, const std::filesystem::path& file,
                        const results::Results& stored) {
  for (const Case& one : cases) {
    const auto then = std::ranges::find(stored.cases, one.id(), &results::CaseInfo::id);
    if (then != stored.cases.end() && then->hash != case_hash(one))
      throw InputError(file.string(), "/cases/" + one.id() + "/hash",
                       "expected results of the case as it is now; run it again");
  }
}

}  // namespace

int certify_command(const RunCommand& command, const std::vector<std::string>& builds) {
  const std::vector<Case> cases = select_cases(command);
  std::vector<Configuration> stored;
  for (const std::string& name : builds) {
    const std::filesystem::path file = is_directory(std::filesystem::path(name))
                                           ? std::filesystem::path(name) / "results.json"
                                           : std::filesystem::path(name);
    stored.push_back({name, read_summary(file)});
    require_same_cases(cases, file, stored.back().results);
  }
  std::vector<Configuration> configurations = computed(cases, command);
  for (Configuration& build : stored) configurations.push_back(std::move(build));
  const Certification certificate = certify(configurations);
  const bool any = std::ranges::any_of(certificate.rows,
                                       [](const ConfigurationRow& row) { return row.checks > 0; });
  if (!any) throw InputError("expected cases with checks, for there is nothing to certify");
  if (command.json) {
    std::cout << pretty(results::to_json(certificate), 2);
  } else {
    print(certificate);
  }
  return certificate.flips.empty() ? 0 : 1;
}

}  // namespace trammel::harness
