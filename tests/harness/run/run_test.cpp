#include "harness/run/run.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/input/document.h"
#include "harness/judge/evaluate_check.h"
#include "harness/judge/sweep.h"
#include "harness/run/results.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(run)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::testing;

namespace {

/// Returns the modes of a cantilever with a sweep, and writes the exact first frequency as a
/// reference.
Json beam(const Folder& folder) {
  const double EI = 2e11 * 0.05 * 1e-3 / 12, mu = 7800 * 0.005, root = 1.8751040687119611;
  const double exact = root * root / 4 * std::sqrt(EI / mu) / (2 * std::acos(-1.0));
  folder.write_reference("exact", "Hz", exact, {{"relative", 1e-14}}, "computed");
  folder.write_reference("root", "1", root, {{"relative", 1e-14}}, "computed");
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 2}}}};
  json["sweeps"]["elements"] = {
      {"pointers", {"/model/elements"}}, {"values", {1, 2, 4, 8, 16}}, {"theory_order", 4}};
  json["checks"]["order"] = Json::parse(R"({
    "quantity": "frequency_Hz", "index": 0, "reference": "exact", "role": "verification",
    "order": {"sweep": "elements", "within": 0.1, "richardson_within": 1e-8,
              "wave_number": {"reference": "root", "at_most": 1},
              "leading_term": {"coefficient": 6.944e-4, "within": 0.2},
              "why": "error (beta h)^4 / 1440"}})");
  return json;
}

std::vector<Run> run_all(const std::vector<Case>& cases, unsigned jobs = 1,
                         const std::string& variant = "") {
  const References references;
  RunOptions options;
  options.jobs = jobs;
  options.variant = variant;
  return run_cases(cases, references, options);
}

const CheckResult& find(const Run& run, const std::string& name) {
  for (const CheckResult& one : run.checks)
    if (one.name == name) return one;
  throw std::runtime_error("no check " + name);
}

}  // namespace

BOOST_AUTO_TEST_CASE(observed_order_leading_term_and_limit_are_judged) {
  const Folder folder;
  Json json = beam(folder);
  std::vector<Run> runs = run_all({testing::read(folder, json)});
  for (const char* name : {"order", "order.leading-term", "order.richardson"})
    BOOST_TEST((find(runs.at(0), name).verdict == Verdict::pass), name);
  BOOST_TEST(exit_status(runs) == 0);
  BOOST_TEST(std::abs(find(runs[0], "order").computed.value() - 4) < 0.05);
  // With lumped instead of consistent masses, the order of convergence is 2 instead of 4, and the
  // leading error term differs from the expected one.
  json["model"]["members"]["AB"]["mass_matrix"] = "lumped";
  runs = run_all({testing::read(folder, json)});
  BOOST_TEST((find(runs.at(0), "order").verdict == Verdict::fail));
  BOOST_TEST((find(runs.at(0), "order.leading-term").verdict == Verdict::fail));
  BOOST_TEST(exit_status(runs) == 1);
}

BOOST_AUTO_TEST_CASE(uncomputed_checks_and_missing_error_bands_fail) {
  const Folder folder;
  Json json = beam(folder);
  json["variants"]["no-length"]["model"]["nodes"]["B"] = {0, 0};
  const Case beams = testing::read(folder, json);
  const std::vector<Run> broken = run_all({beams}, 1, "no-length");
  BOOST_TEST((find(broken.at(0), "order").verdict == Verdict::error));
  BOOST_TEST(contains(find(broken.at(0), "order").message, "not computed: "));
  std::vector<Run> runs = run_all({beams}, 1, "base");
  BOOST_TEST(exit_status(runs) == 0);
  Convergence study = runs.at(0).convergence.at(0);
  for (results::Number& band : study.gci) band = *band * 1e-3;
  runs[0].convergence.assign(100, study);
  BOOST_TEST(exit_status(runs) == 1);
  BOOST_TEST(element_size("halvings", 3) == 0.125);
}

BOOST_AUTO_TEST_CASE(exit_status_is_that_of_the_worst_run) {
  CheckResult failing;
  failing.verdict = Verdict::fail;
  Run run;
  run.checks = {failing};
  BOOST_TEST(exit_status({run}) == 1);
  run.fault = results::Fault::input;
  BOOST_TEST(exit_status({run}) == 2);
  run.fault = results::Fault::internal;
  BOOST_TEST(exit_status({run}) == 3);
}

BOOST_AUTO_TEST_CASE(order_from_too_few_meshes_is_an_error) {
  const Folder folder;
  Json json = beam(folder);
  json["sweeps"]["elements"]["values"] = {4, 8};
  const auto runs = run_all({testing::read(folder, json)});
  BOOST_TEST((find(runs.at(0), "order").verdict == Verdict::error));
  BOOST_TEST(contains(find(runs.at(0), "order").message, "only 2 meshes qualify"));
}

BOOST_AUTO_TEST_CASE(order_of_a_sweep_with_a_missing_level_is_an_error) {
  const Folder folder;
  const Case beams = testing::read(folder, beam(folder));
  const References references;
  std::vector<Run> runs = run_all({beams});
  Convergence study = runs.at(0).convergence.at(0);
  study.broken = true;
  const Document document = patched(beams, "base");
  const std::vector<Check> checks = read_checks(document, "base", beams.variants());
  const std::vector<Convergence> convergence = {study};
  const CheckContext context{document, runs[0].quantities, convergence, references,
                             [](const auto&) { return nullptr; }};
  const CheckResult judged = evaluate_order_check(checks.at(0), context).at(0);
  BOOST_TEST((judged.verdict == Verdict::error));
  BOOST_TEST(judged.message == "a refinement level has no finite value");
}

BOOST_AUTO_TEST_CASE(results_do_not_depend_on_jobs_and_obey_their_schema) {
  const Folder folder;
  Json json = beam(folder);
  for (int i = 1; i < 6; ++i)
    json["variants"]["v" + std::to_string(i)]["model"]["nodes"]["B"] = {1 + 0.1 * i, 0.2};
  json["variants"]["nothing-holds"]["model"]["supports"] = {{"A", {"x"}}};
  const std::vector<Case> cases = {testing::read(folder, json)};
  const auto text = [&](unsigned jobs) {
    const References references;
    Json results = to_json(collect_results(run_all(cases, jobs), cases, references));
    const auto fault = find_schema_fault(results, "results");
    BOOST_TEST(!fault.has_value(), (fault ? fault->pointer + ": " + fault->message : ""));
    results.erase("environment");
    for (Json& one : results["runs"]) one.erase("cost");
    return results.dump();
  };
  const std::string alone = text(1);
  BOOST_TEST(alone.size() > 1000);
  for (const unsigned jobs : {2U, 5U, 16U}) BOOST_TEST((text(jobs) == alone));
}

BOOST_AUTO_TEST_CASE(singular_model_passes_only_where_expected) {
  const Folder folder;
  Json json = testing::cantilever();
  json["model"]["supports"] = {{"A", {"x", "y"}}};
  json["checks"]["c"] = {{"quantity", "estimated_correct_digits"},
                         {"role", "verification"},
                         {"bound", {{"at_least", 3}, {"why", "w"}}}};
  std::vector<Run> runs = run_all({testing::read(folder, json)});
  BOOST_TEST((runs.at(0).status == results::Status::singular));
  BOOST_TEST((find(runs[0], "unexpected-status").verdict == Verdict::fail));
  BOOST_TEST((find(runs[0], "c").verdict == Verdict::error));
  BOOST_TEST(exit_status(runs) == 1);
  json["expect_status"] = "singular";
  runs = run_all({testing::read(folder, json)});
  BOOST_TEST((find(runs.at(0), "status").verdict == Verdict::pass));
  BOOST_TEST(runs[0].checks.size() == 1);
  BOOST_TEST(exit_status(runs) == 0);
  json["expect_status"] = "not-converged";
  runs = run_all({testing::read(folder, json)});
  BOOST_TEST((find(runs.at(0), "status").verdict == Verdict::fail));
  json["expect_status"] = "singular";
  json["model"]["supports"]["A"] = {"x", "y", "rotation"};
  runs = run_all({testing::read(folder, json)});
  BOOST_TEST((find(runs.at(0), "status").verdict == Verdict::fail));
  BOOST_TEST(exit_status(runs) == 1);
}

BOOST_AUTO_TEST_CASE(failed_regression_check_fails_the_run) {
  const Folder folder;
  Json json = testing::cantilever();
  json["checks"]["as-before"] = {{"quantity", "displacement_y_m:B"},
                                 {"role", "regression"},
                                 {"bound", {{"at_most", 0}, {"why", "not what it was"}}}};
  const std::vector<Run> runs = run_all({testing::read(folder, json)});
  BOOST_TEST((find(runs.at(0), "as-before").verdict == Verdict::fail));
  BOOST_TEST(exit_status(runs) == 1);
}

BOOST_AUTO_TEST_CASE(invalid_input_affects_its_own_run_only) {
  const Folder folder;
  Json json = testing::cantilever();
  json["variants"]["lost"]["model"]["members"]["AB"]["nodes"] = {"A", "Q"};
  const auto runs = run_all({testing::read(folder, json)});
  BOOST_REQUIRE(runs.size() == 2);
  BOOST_TEST(runs[0].is_solved());
  BOOST_TEST((runs[1].status == results::Status::error));
  BOOST_TEST(
      contains(runs[1].reason, "/variants/lost/model/members/AB/nodes/1: expected the name"));
  BOOST_TEST(exit_status(runs) == 2);
}

BOOST_AUTO_TEST_CASE(exceeded_limits_affect_their_own_run_only) {
  const Folder folder;
  Json slow = testing::endless(), large = testing::cantilever();
  slow["timeout_s"] = 1;
  large["id"] = "large";
  large["model"]["elements"] = 65536;
  const References references;
  RunOptions options;
  options.jobs = 2;
  options.memory_bytes = 250000000;
  const auto runs = run_cases({testing::read(folder, slow), testing::read(folder, large),
                               testing::read(folder, testing::cantilever())},
                              references, options);
  BOOST_TEST(
      contains(
          runs[0].reason,
          "computation that ends within timeout_s (base: stopped after 1 s of processor time)"),
      runs[0].reason);
  BOOST_TEST(contains(runs[1].reason, "/model/elements: expected a computation of at most 0.25 GB"),
             runs[1].reason);
  BOOST_TEST(runs[2].is_solved());
  BOOST_TEST(exit_status(runs) == 2);
}

BOOST_AUTO_TEST_CASE(compared_variant_is_computed_but_not_reported) {
  const Folder folder;
  Json json = testing::cantilever();
  json["variants"]["soft"]["model"]["materials"]["steel"]["E_Pa"] = 1e11;
  json["checks"]["half"] = {
      {"quantity", "displacement_y_m:B"},
      {"against_variant", "soft"},
      {"role", "validation"},
      {"expect", {{"agrees", "E is twice"}, {"ratio_between", {0.49, 0.51}}}}};
  auto runs = run_all({testing::read(folder, json)}, 1, "base");
  BOOST_REQUIRE(runs.size() == 1);
  BOOST_TEST((find(runs[0], "half").verdict == Verdict::pass));
  runs = run_all({testing::read(folder, json)});
  BOOST_REQUIRE(runs.size() == 2);
  BOOST_TEST(runs[1].checks.empty());  // the variant is not compared with itself
}

BOOST_AUTO_TEST_SUITE_END()
