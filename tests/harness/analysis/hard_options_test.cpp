// ctest: labels=hard timeout=300
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/input/catalogue.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(hard_options)

/// Battery 14: whatever the options, a result is finite or says why there is none.
using namespace trammel;
using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;
using testing::contains;
using testing::Folder;

namespace {

Json catalogue_case(const char* id) {
  Json json = load_named_case(id).document.value();
  for (const char* key :
       {"extends", "checks", "stress_suite", "variants", "sweeps", "figures", "expect_status"}) {
    json.erase(key);
  }
  return json;
}

/// Runs it; `words` are what the reason must contain where there is no solution.
void check_outcome(const Json& json, const std::vector<const char*>& words) {
  const Folder folder;
  const References references;
  const AnalysisResult result =
      analyse(patched(testing::read(folder, json), "base"), references, {false});
  const std::string options = json.at("analysis").dump();
  if (result.outcome.solved()) {
    for (const auto& [name, quantity] : result.quantities) {
      for (const double value : quantity.values) {
        if (!std::isfinite(value)) BOOST_ERROR(name << " is not finite with " << options);
      }
    }
    return;
  }
  BOOST_TEST(result.quantities.empty(), options);
  BOOST_TEST(!result.outcome.reason.empty(), options);
  if (result.outcome.status != Status::not_converged) return;
  for (const char* word : words) {
    BOOST_TEST(contains(result.outcome.reason, word), options << ": " << result.outcome.reason);
  }
}

void try_motion_options(Json json, double end, const std::vector<double>& steps) {
  Json& options = json["analysis"]["large-motion"];
  options.erase("extrapolated");
  options.erase("output_step_s");
  options["end_time_s"] = end;
  options["steps"] = 3000;
  for (const double step : steps) {
    options["step_s"] = step;
    for (const double radius : {0.0, 0.5, 0.9, 1.0}) {
      for (const bool adaptive : {false, true}) {
        Json one = json;
        one["analysis"]["large-motion"]["spectral_radius"] = radius;
        if (adaptive) one["analysis"]["large-motion"]["tolerance"] = 1e-6;
        check_outcome(one, {"step", "time", "correction"});
      }
    }
    if (options.contains("track")) continue;  // by generalized-alpha only
    Json one = json;
    one["analysis"]["large-motion"]["integrator"] = "energy-momentum";
    check_outcome(one, {"step", "time", "correction"});
    one["analysis"]["large-motion"]["strain_rate_damping_s"] = 1e-3;
    check_outcome(one, {"step", "time", "correction"});
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_option_of_motion_gives_numbers_or_a_reason) {
  try_motion_options(catalogue_case("iftomm-a01-pendulum"), 0.5, {1e-3, 0.1, 1});
  try_motion_options(catalogue_case("iftomm-a03-andrews"), 1e-3, {1e-5, 1e-4, 1e-3});
  try_motion_options(catalogue_case("ansys-vm258-spin-up"), 0.5, {1e-3, 0.05, 0.5});
  try_motion_options(catalogue_case("tracking-exact"), 0.05, {1e-3, 0.01, 0.1});
}

BOOST_AUTO_TEST_CASE(every_option_of_statics_gives_numbers_or_a_reason) {
  for (const char* id : {"elastica-tip-load", "roll-up", "ansys-vm136", "hard-11-toggle"}) {
    Json json = catalogue_case(id);
    Json& options = json["analysis"]["large-statics"];
    options.erase("whole_path");
    options["points"] = 200;
    for (const double factor : {1e-12, 1.0, 3.0, 1e3, 1e12}) {
      options["load_factors"] = {factor};
      for (const bool leave : {false, true}) {
        options["switch_branch"] = leave;
        check_outcome(json, {"load factor"});
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(every_solver_of_linear_hard_models_gives_numbers_or_a_reason) {
  Json json = catalogue_case("hard-05-stiff-platform");
  for (const double factor : {1e-12, 1.0, 1e6, 1e12, 1e18}) {
    json["model"]["manipulator"]["platform_material"]["E_Pa"] = 6.9e10 * factor;
    json["analysis"] = {{"statics", Json::object()}};
    check_outcome(json, {});
    json["analysis"] = {{"large-statics", Json::object()}};
    check_outcome(json, {"load factor"});
    for (const char* path : {"automatic", "dense", "sparse"}) {
      json["analysis"] = {{"modes", {{"count", 6}, {"eigensolver", path}}}};
      check_outcome(json, {});
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
