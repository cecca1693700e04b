// ctest: labels=slow timeout=900
#include "harness/analysis/size_estimate.h"

#include <sys/resource.h>

#include <functional>
#include <sstream>

#include "harness/base/processes.h"
#include "harness/run/results.h"
#include "harness/run/run_store.h"
#include "tests/support/harness/analysing.h"

BOOST_AUTO_TEST_SUITE(size_estimate)

using namespace trammel;
using namespace trammel::harness;

namespace {

struct Memory {
  double estimated = 0, most = 0;  ///< estimated and measured peak memory [B]
};

/// Measures the memory of an analysis in a separate process, which excludes memory of other
/// analyses.
Memory measure_memory(const std::function<Json()>& make) {
  Memory memory;
  const auto work = [&] {
    const Document document = testing::document_of(make());
    const double estimated = estimate_problem_size(document).bytes;
    Run run;
    record_result(analyze(document, References(), {true}), run);
    BOOST_REQUIRE(run.is_solved());
    (void)serialize(run);
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return std::to_string(estimated) + " " + std::to_string(used.ru_maxrss);
  };
  const auto ended = [&](std::size_t, const ProcessOutcome& outcome) {
    BOOST_REQUIRE((outcome.termination == ProcessOutcome::Termination::answered));
    std::istringstream(outcome.text) >> memory.estimated >> memory.most;
    memory.most *= 1024;
  };
  BOOST_REQUIRE(run_in_worker_processes({{work, 300}}, {}, ended) == 0);
  return memory;
}

void check(const std::string& name, const std::function<Json(int)>& sized,
           const std::vector<int>& sizes) {
  const double none = measure_memory(testing::cantilever).most;
  for (const int size : sizes) {
    const Memory memory = measure_memory([&] { return sized(size); });
    const double ratio = memory.estimated / (memory.most - none);
    BOOST_TEST((ratio >= 1 && ratio <= 3), name << ' ' << size << ": estimated "
                                                << memory.estimated / 1e6 << " MB, " << ratio
                                                << " times what was measured");
  }
}

Json harmonic_case(int elements, int points) {
  Json json = testing::cantilever();
  json["model"]["elements"] = elements;
  json["analysis"] = Json::parse(
      R"({"harmonic": {"from_Hz": 1, "to_Hz": 20,
                       "outputs": ["displacement_x_m:B", "displacement_y_m:B"]}})");
  json["analysis"]["harmonic"]["points"] = points;
  return json;
}

Json membrane_case(int cells, const char* triangles) {
  Json json = Json::parse(R"({"id": "membrane", "title": "Membrane", "analysis": {"manufactured": {
    "membrane": {"field": "clamped", "length_m": 0.8, "height_m": 0.5, "thickness_m": 0.01,
                 "material": {"E_Pa": 7e10, "rho_kg_m3": 2700, "nu": 0.33}}}}})");
  json["analysis"]["manufactured"]["cells"] = cells;
  json["analysis"]["manufactured"]["membrane"]["triangles"] = triangles;
  return json;
}

Json samples(int count) {
  Json json = {{"id", "samples"}, {"title", "Samples"}};
  Json& network = json["analysis"]["grnn"];
  network = {{"queries", {{0.5, 1}}}, {"sigma", 1}};
  for (int i = 0; i < count; ++i) {
    network["samples"]["inputs"].push_back({0.1 * i, i * i % 7});
    network["samples"]["outputs"].push_back({i % 13});
  }
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(estimate_is_one_to_three_times_the_measured_memory) {
  check("points of a response", [](int n) { return harmonic_case(10, n); }, {20000, 40000, 100000});
  check("elements that vibrate", [](int n) { return harmonic_case(n, 2); }, {2000, 4000, 8000});
  const auto damped = [](int n) {
    Json json = harmonic_case(n, 2);
    json["analysis"]["harmonic"]["damping"]["rayleigh"]["stiffness_s"] = 1e-5;
    return json;
  };
  check("elements that vibrate, damped", damped, {2000, 4000, 8000});
  check("three-node", [](int n) { return membrane_case(n, "three-node"); }, {96, 144, 192});
  check("six-node", [](int n) { return membrane_case(n, "six-node"); }, {48, 72, 96});
  check("samples", samples, {10000, 20000, 40000});
  const auto path = [](int n) {
    Json json = testing::manipulator();
    json["model"].erase("pose");
    json["model"]["trajectory"]["circle"] = {
        {"center_m", {0.25, 0.144}}, {"radius_m", 0.01}, {"points", n}, {"step_s", 0.01},
        {"angular_speed_rad_s", 1},  {"phi_rad", 0}};
    json["analysis"] = {{"grnn", {{"train", n / 2}, {"sigma", 0.1}}}};
    return json;
  };
  check("points of a path", path, {2000, 4000, 8000});
  const auto map = [](int n) {
    Json json = testing::manipulator();
    json["analysis"] = {{"sensitivity-map", {{"columns", n}, {"orientations_deg", {0}}}}};
    return json;
  };
  check("positions of a map", map, {80, 100, 120});  // the heap grows in steps of 0.13 MB
}

BOOST_AUTO_TEST_SUITE_END()
