#include "tests/fuzz/target.h"

#include <algorithm>
#include <fstream>
#include <new>
#include <regex>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/input/catalogue.h"
#include "harness/judge/evaluate_check.h"
#include "harness/results/result_fields.h"
#include "harness/run/claims.h"
#include "harness/run/results.h"
#include "harness/run/run_store.h"
#include "harness/studies/cost_study.h"
#include "harness/studies/discretization_error.h"
#include "harness/studies/validation_uncertainty.h"
#include "reports/page/report.h"

namespace trammel::fuzz {
namespace {

namespace fs = std::filesystem;
using namespace harness;

const Catalogue& catalogue() {
  static const Catalogue all;
  return all;
}

/// Computes and judges a variant as the command `run` does.
/// @param all  true: also computes sweeps and uncertainties
void compute(const Case& given, const std::string& variant, bool all) {
  const References references;
  const Document document = patched(given, variant);
  const auto checks = read_checks(document, variant, given.variants());
  Run run;
  run.case_id = given.id();
  run.variant = variant;
  AnalysisResult result = analyze(document, references, {true});
  results::ErrorEstimates errors;
  if (all && result.outcome.solved()) errors = estimate_errors(document, result, references);
  record_result(std::move(result), run);
  if (run.is_solved()) {
    if (all) run.sweeps = run_sweep_levels(document, references);
    if (all && document.value().contains("uncertainty"))
      run.uncertainty =
          evaluate_validation_uncertainty(document, run.quantities, checks, errors, references);
    for (const results::Sweep& sweep : run.sweeps)
      for (Convergence& found :
           sweep_convergence(sweep, document, checks, references, TrackedQuantities::named))
        run.convergence.push_back(std::move(found));
    const auto other = [&](const std::string&) { return &run.quantities; };
    const CheckContext context{document, run.quantities, run.convergence, references, other};
    for (const Check& check : checks)
      for (CheckResult& judged : evaluate_check(check, context))
        run.checks.push_back(std::move(judged));
  }
  run = parse_run(serialize(run));
  (void)results::read_results(results::to_json(collect_results({run}, {given}, references)));
}

void test_case(const fs::path& file, std::size_t pick, const std::function<void()>& computing) {
  const Case given = load_case(file, catalogue());
  std::vector<std::string> variants = given.variants();
  const auto own = std::find(variants.begin(), variants.end(), "fuzz");
  if (own != variants.end()) {
    variants = {"fuzz"};
  } else if (pick > 0) {
    variants = {variants[pick % 3 == 0 ? pick % variants.size() : 0]};
  }
  computing();
  for (const std::string& variant : variants) compute(given, variant, pick % 4 == 0);
}

void test_claims(const fs::path& file) {
  static const std::vector<Case> cases = {load_case(catalogue().find_case("table-2-audit")),
                                          load_case(catalogue().find_case("claims-audit"))};
  Document claims = Document::from_json(file.string(), read_json(file));
  claims.validate("claims");
  (void)cases_used_by(claims, cases);
  std::vector<Run> runs;
  for (const Case& some : cases) {
    Run run;
    run.case_id = some.id();
    run.variant = kBaseVariant;
    record_result(analyze(patched(some, kBaseVariant), References(), {false}), run);
    runs.push_back(std::move(run));
  }
  (void)results::to_json(evaluate_claims(claims, runs));
}

void test_results(const fs::path& file, const fs::path& sample) {
  try {
    reports::write_junit(results::read_results(file), file.parent_path() / "junit.xml");
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());  // report functions throw other types
  }
  CommandOptions compare;
  compare.words = {file.string(), sample.string()};
  (void)compare_command(compare, {});
}

void test_references(const fs::path& file) {
  const References library;
  const Json family = read_json(file);
  if (!family.is_object()) throw InputError(file.string(), "", "expected an object");
  for (const auto& item : family.items())
    if (references::is_reference_id(item.key()))
      (void)library.add(file.string() + "#/" + item.key());
}

void test_file(const Input& input, const fs::path& file, const std::function<void()>& computing) {
  if (input.kind == "case") test_case(file, input.pick, computing);
  if (input.kind == "cost")
    for (const SweepExtent extent : {SweepExtent::quick, SweepExtent::full})
      (void)load_cost_study(file, extent, References());
  if (input.kind == "claims") test_claims(file);
  if (input.kind == "reference") test_references(file);
  if (input.kind != "results") return;
  const fs::path sample = file.parent_path() / "sample.json";
  if (!fs::exists(sample)) write_file(sample, sample_results().dump());
  test_results(file, sample);
}

/// Checks that the error message for a refused input is one line with a position in the file.
Verdict judge_refusal(const std::string& message) {
  static const std::regex place("(: /|: line |at byte |expected )");
  const bool is_line = std::none_of(message.begin(), message.end(),
                                    [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (!is_line) return {Outcome::wrong, "control characters in: " + message};
  if (!std::regex_search(message, place)) return {Outcome::wrong, "no position in: " + message};
  return {Outcome::refused, message};
}

}  // namespace

const char* to_string(Outcome outcome) {
  constexpr std::array<const char*, kOutcomes> names = {"unfinished", "valid",    "refused",
                                                        "no memory",  "crash",    "hang",
                                                        "stopped",    "internal", "wrong"};
  return names.at(static_cast<std::size_t>(outcome));
}

bool is_finding(Outcome outcome) {
  return outcome == Outcome::unfinished || outcome == Outcome::crash || outcome == Outcome::hang ||
         outcome == Outcome::internal || outcome == Outcome::wrong;
}

Json sample_results() {
  static const Json sample = [] {
    const References references;
    std::vector<Case> cases;
    for (const char* name : {"cantilever-tip-force", "table-2-audit"})
      cases.push_back(load_case(catalogue().find_case(name)));
    return results::to_json(collect_results(run_cases(cases, references, {}), cases, references));
  }();
  return sample;
}

Verdict test_input(const Input& input, const fs::path& folder,
                   const std::function<void()>& computing) {
  const fs::path file = folder / (input.name + ".json");
  std::ofstream(file, std::ios::binary) << input.text;
  try {
    test_file(input, file, computing);
    if (input.is_invalid) return {Outcome::wrong, "accepted, although the schema forbids it"};
    return {Outcome::valid, ""};
  } catch (const InputError& error) {
    return judge_refusal(one_line(error.what()));
  } catch (const std::bad_alloc&) {
    return {Outcome::no_memory, "the input requires too much memory"};
  } catch (const std::exception& error) {
    return {Outcome::internal, error.what()};
  }
}

}  // namespace trammel::fuzz
