#include "harness/run/run_store.h"

#include <boost/test/unit_test.hpp>
#include <chrono>
#include <cmath>

#include "harness/base/json_file.h"
#include "harness/run/results.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(run_store)

using namespace trammel;
using namespace trammel::testing;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entries(const fs::path& store) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(store)) files.push_back(entry.path());
  return files;
}

/// Returns a cantilever with variants and writes a reference next to the case.
Json cases(const Folder& folder, double reference_N) {
  folder.write_reference("load", "N", reference_N, {{"absolute", 0}}, "computed");
  Json json = testing::cantilever();
  json["variants"]["long"]["model"]["nodes"]["B"] = {3, 0};
  json["variants"]["unsupported"]["model"]["supports"] = {{"A", {"x", "y"}}};
  json["sweeps"]["elements"] = {
      {"pointers", {"/model/elements"}}, {"values", {1, 2, 4}}, {"theory_order", 4}};
  return json;
}

struct Resumed {
  std::string results;
  std::vector<double> wall_s;  ///< a stored run keeps the time of its computation
};

Resumed run_all(const Folder& folder, const Json& json, bool resume) {
  const References references;
  const std::vector<Case> all = {testing::read(folder, json)};
  RunOptions options;
  options.store = folder.path() / "store";
  options.resume = resume;
  const std::vector<Run> runs = run_cases(all, references, options);
  Json results = to_json(collect_results(runs, all, references, options.store));
  results["environment"].erase("date");
  results["environment"].erase("stored_runs");
  Resumed resumed{results.dump(), {}};
  for (const Run& run : runs) resumed.wall_s.push_back(run.cost.wall_s);
  return resumed;
}

}  // namespace

BOOST_AUTO_TEST_CASE(stored_computation_is_bit_identical) {
  Run computation;
  computation.status = results::Status::solved;
  computation.quantities["q"] = {
      {0.1, -0.0, 5e-324, std::nan(""), -std::numeric_limits<double>::infinity()}, {1e-16}};
  computation.drawing.emplace();
  computation.drawing->nodes = {{0.1, std::nan("")}};
  computation.drawing->members = {{0, 0}};
  computation.effects = {{"shear", "", "why", true, false, 0, {}, 1.0 / 3, {}}};
  computation.sweeps = {{"s", {{2, computation.quantities}}}};
  const std::string bytes = serialize(computation);
  const Run again = parse_run(bytes);
  BOOST_TEST(serialize(again) == bytes);
  const auto& values = again.quantities.at("q").values;
  BOOST_TEST((values[0] == 0.1 && std::signbit(values[1]) && values[2] == 5e-324 &&
              std::isnan(values[3]) && std::isinf(values[4])));
}

BOOST_AUTO_TEST_CASE(resumed_run_returns_identical_results) {
  const Folder folder;
  const Json json = cases(folder, 100);
  const std::string first = run_all(folder, json, false).results;
  BOOST_TEST(entries(folder.path() / "store").size() == 3);
  BOOST_TEST(run_all(folder, json, true).results == first);
}

BOOST_AUTO_TEST_CASE(corrupted_stored_run_is_computed_again) {
  const Folder folder;
  const Json json = cases(folder, 100);
  const Resumed first = run_all(folder, json, false);
  const auto files = entries(folder.path() / "store");
  const std::string whole = read_text(files[0]);
  std::string bent = whole;
  bent[bent.size() / 2] = static_cast<char>(bent[bent.size() / 2] ^ 1);
  for (const std::string& broken :
       {std::string(), whole.substr(0, 20), whole.substr(0, whole.size() / 2), bent}) {
    write_file(files[0], broken);
    const Resumed again = run_all(folder, json, true);
    int kept = 0;
    for (std::size_t i = 0; i < 3; ++i) kept += int(again.wall_s[i] == first.wall_s[i]);
    BOOST_TEST(kept == 2);
    Run found;
    BOOST_TEST(load_stored_run(files[0], found));
    write_file(files[0], whole);
  }
}

BOOST_AUTO_TEST_CASE(file_name_of_a_stored_run_depends_on_its_inputs) {
  const Folder folder;
  Json json = cases(folder, 100);
  const auto name = [&] { return run_file_name(testing::read(folder, json).document, true); };
  const std::string first = name();
  BOOST_TEST(name() == first);
  BOOST_TEST(run_file_name(testing::read(folder, json).document, false) != first);
  json["model"]["elements"] = 5;
  BOOST_TEST(name() != first);
}

BOOST_AUTO_TEST_CASE(changed_case_renames_stored_run_of_its_options) {
  const Folder folder;
  Json tried = testing::cantilever();
  tried["id"] = "tried";
  const Json options = Json::parse(R"({"id": "options", "title": "t", "analysis": {
    "options": {"cases": {"tried": {}}, "analyses": {"statics": {}}}}})");
  const auto name = [&] {
    (void)folder.write(tried);
    return run_file_name(load_case(folder.write(options)).document, true);
  };
  const std::string first = name();
  tried["model"]["elements"] = 5;
  BOOST_TEST(name() != first);
}

BOOST_AUTO_TEST_CASE(changed_or_added_reference_invalidates_stored_run) {
  const Folder folder;
  const std::string place = (folder.path() / "references.json").string() + "#/";
  folder.write_reference({{"id", "r"}, {"values", {1}}});
  Run computation;
  computation.references[place + "r"] = "0";
  const auto entry = folder.path() / "entry";
  write_file(entry, serialize(computation));
  BOOST_TEST(!load_stored_run(entry, computation));
  computation.references = {{place + "r", References().hash(place + "r")}, {place + "absent", ""}};
  write_file(entry, serialize(computation));
  BOOST_TEST(load_stored_run(entry, computation));
  folder.write_reference({{"id", "other"}, {"values", {1}}});
  BOOST_TEST(load_stored_run(entry, computation));
  folder.write_reference({{"id", "absent"}, {"values", {1}}});
  BOOST_TEST(!load_stored_run(entry, computation));
}

BOOST_AUTO_TEST_CASE(times_of_another_machine_are_not_reused) {
  const Folder folder;
  Run computation;
  computation.machine = "another";
  const auto entry = folder.path() / "entry";
  write_file(entry, serialize(computation));
  BOOST_TEST(load_stored_run(entry, computation));
  computation.cost.timings = {{"t", 1, 1}};
  write_file(entry, serialize(computation));
  BOOST_TEST(!load_stored_run(entry, computation));
  computation.machine = machine_name();
  write_file(entry, serialize(computation));
  BOOST_TEST(load_stored_run(entry, computation));
}

BOOST_AUTO_TEST_CASE(unchanged_scenes_of_effects_are_measured_once) {
  const Folder folder;
  int measured = 0;
  const auto measure = [&] {
    ++measured;
    return EffectScenes{{"scene", "statics", "none", 0.01, 0.002, true, 3, 2, 1, 0.5, 0.1, {}, {}}};
  };
  Json json = testing::cantilever();
  const auto scenes = [&](bool resume) {
    const Case given = testing::read(folder, json);
    return cached_effect_study(given.document, measure, folder.path() / "store", resume);
  };
  (void)scenes(true);
  const EffectScenes again = scenes(true);
  BOOST_TEST(measured == 1);
  BOOST_TEST(again.at(0).scene == "scene");
  BOOST_TEST(again.at(0).chosen_s == 2);
  (void)scenes(false);
  BOOST_TEST(measured == 2);
  json["model"]["nodes"]["B"] = {3, 0};
  (void)scenes(true);
  BOOST_TEST(measured == 3);
}

BOOST_AUTO_TEST_CASE(stored_runs_unused_for_a_month_are_removed) {
  const Folder folder;
  const auto old = folder.path() / "old.cbor", used = folder.path() / "used.cbor";
  const auto other = folder.write("old.json", "1");
  Run computation;
  for (const auto& file : {old, used, other}) {
    if (file != other) write_file(file, serialize(computation));
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() - std::chrono::days(31));
  }
  BOOST_TEST(load_stored_run(used, computation));
  prepare_store(folder.path());
  BOOST_TEST(!std::filesystem::exists(old));
  BOOST_TEST(std::filesystem::exists(used));
  BOOST_TEST(std::filesystem::exists(other));
}

BOOST_AUTO_TEST_SUITE_END()
