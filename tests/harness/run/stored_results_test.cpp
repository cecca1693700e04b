#include "harness/run/stored_results.h"

#include <boost/test/unit_test.hpp>

#include "harness/base/json_file.h"
#include "harness/input/catalogue.h"
#include "harness/run/results.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(stored_results)

using namespace trammel;
using namespace trammel::testing;

namespace {

namespace fs = std::filesystem;

/// Returns stored results of a cantilever with two meshes, a sweep and a drawing.
results::Results cantilever_results(const Folder& folder) {
  Json json = testing::cantilever();
  json["variants"]["two"]["model"]["elements"] = 2;
  json["sweeps"] = {{"mesh", {{"pointers", {"/model/elements"}}, {"values", {1, 2, 4, 8}}}}};
  json["checks"]["tip"] = {{"quantity", "displacement_y_m:B"},
                           {"role", "verification"},
                           {"bound", {{"at_least", -1}, {"at_most", 1}, {"why", "it is short"}}}};
  const std::vector<Case> cases = {testing::read(folder, json)};
  RunOptions options;
  options.store = folder.path() / "out/store";
  const References references;
  return collect_results(run_cases(cases, references, options), cases, references, options.store);
}

}  // namespace

BOOST_AUTO_TEST_CASE(results_read_back_with_their_store_are_unchanged) {
  const Folder folder;
  results::Results before = cantilever_results(folder);
  const fs::path file = write_results(before, folder.path() / "out");
  const results::Results after = load_results(file);
  BOOST_TEST(after.missing == "");
  BOOST_TEST(!before.runs[0].convergence.empty());
  BOOST_TEST(before.runs[0].drawing.has_value());
  const Json inputs = to_json(after)["cases"][after.cases[0].id]["inputs"];
  BOOST_TEST(inputs["loads/tip/force_N"]["value"] == "[0,100]");
  BOOST_TEST(inputs["members/AB/section"]["value"] == "bar");
  results::complete_and_validate(before);
  Json a = to_json(before), b = to_json(after);
  a.erase("store"), b.erase("store");
  BOOST_TEST(a.dump() == b.dump());
}

BOOST_AUTO_TEST_CASE(inherited_inputs_name_the_case_file_that_sets_them) {
  const Case given = harness::load_named_case("exact-statics");
  const Json json = to_json(collect_results({}, {given}, References(), ""));
  const Json& inputs = json["cases"]["exact-statics"]["inputs"];
  BOOST_TEST(inputs["manipulator/links/thickness_m"]["source"] == "table-1.json");
  BOOST_TEST(!inputs["loads/P/node"].contains("source"));
}

BOOST_AUTO_TEST_CASE(results_file_has_scalars_and_each_reason_once) {
  const Folder folder;
  const Json json = read_json(write_results(cantilever_results(folder), folder.path() / "out"));
  BOOST_TEST(json["store"] == "store");
  for (const Json& run : json["runs"]) {
    for (const Json& values : run["quantities"]) BOOST_TEST(values.size() == 1U);
    BOOST_TEST(!run.contains("drawing"));
    BOOST_TEST(!run.contains("convergence"));
    BOOST_TEST(!run["checks"][0].contains("message"));
    BOOST_TEST(run["checks"][0]["verdict"] == "pass");
    BOOST_TEST(run["checks"][0]["why"] == 0);
    BOOST_TEST(run["checks"][0]["quantity"] == 1);
  }
  BOOST_TEST(json["names"] == Json::array({"tip", "displacement_y_m:B"}));
  BOOST_TEST(json["reasons"].size() == 1U);
  BOOST_TEST(json["reasons"][0] == "it is short");
}

BOOST_AUTO_TEST_CASE(shared_citation_is_stored_once) {
  results::Results results;
  for (const char* id : {"a", "b"}) {
    results.references.emplace_back();
    results.references.back().id = id;
    results.references.back().citation = "One book.";
  }
  results.references.back().notes = "A note.";
  Json json = to_json(results);
  BOOST_TEST(json["citations"] ==
             Json::array({"One book.", ""}));  // the empty text is the position in the source
  BOOST_TEST(json["references"]["b"]["citation"] == 0);
  const results::Results read = results::read_results(json);
  BOOST_TEST(read.references.at(1).citation == "One book.");
  BOOST_TEST(read.references.at(0).notes == "");
  BOOST_TEST(read.references.at(1).notes == "A note.");
  json["references"]["b"]["citation"] = 1;
  BOOST_CHECK_THROW((void)results::read_results(json), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(copy_without_its_store_reports_what_is_missing) {
  const Folder folder;
  const fs::path file = write_results(cantilever_results(folder), folder.path() / "out");
  fs::create_directories(folder.path() / "copy");
  fs::copy(file, folder.path() / "copy");
  const results::Results copy = load_results(folder.path() / "copy/results.json");
  BOOST_TEST(contains(copy.missing, "2 of 2 runs have no series"), copy.missing);
  BOOST_TEST(copy.runs[0].checks.at(0).why == "it is short");
  BOOST_TEST(copy.runs[0].quantity("displacement_y_m:B") != nullptr);
}

BOOST_AUTO_TEST_CASE(broken_and_foreign_store_files_count_as_missing) {
  const Folder folder;
  const results::Results results = cantilever_results(folder);
  const fs::path file = write_results(results, folder.path() / "out");
  const fs::path first = folder.path() / "out/store" / results.runs[0].stored,
                 second = folder.path() / "out/store" / results.runs[1].stored;
  const std::string whole = read_text(first);
  write_file(first, read_text(second));
  BOOST_TEST(contains(load_results(file).missing, "1 of 2 runs"));
  std::string bent = whole;
  bent[bent.size() / 2] ^= 1;
  write_file(first, bent);
  BOOST_TEST(contains(load_results(file).missing, "1 of 2 runs"));
  write_file(first, whole);
  BOOST_TEST(load_results(file).missing == "");
}

BOOST_AUTO_TEST_CASE(reason_index_beyond_the_list_is_refused) {
  const Folder folder;
  const fs::path file = write_results(cantilever_results(folder), folder.path() / "out");
  Json json = read_json(file);
  json["runs"][0]["checks"][0]["why"] = 1;
  write_file(file, json.dump());
  BOOST_TEST(contains(testing::input_error_message([&] { (void)load_results(file); }), "/reasons"));
}

BOOST_AUTO_TEST_SUITE_END()
