#include "harness/run/shards.h"

#include <boost/test/unit_test.hpp>

#include "harness/base/json_file.h"
#include "harness/run/results.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(shards)

using namespace trammel;
using namespace trammel::testing;

namespace {

namespace fs = std::filesystem;

/// Returns a case with four variants. The base is compared with one of them, and one ends with an
/// error.
std::vector<Case> cases(const Folder& folder) {
  Json json = testing::cantilever();
  json["variants"]["long"]["model"]["nodes"]["B"] = {3, 0};
  json["variants"]["two"]["model"]["elements"] = 2;
  json["variants"]["unsolvable"]["model"]["members"]["AB"]["nodes"] = {"A", "C"};
  json["checks"]["longer"] = {{"quantity", "displacement_y_m:B"},
                              {"against_variant", "long"},
                              {"role", "verification"},
                              {"tolerance", {{"relative", 10}, {"why", "only that it is there"}}}};
  return {testing::read(folder, json)};
}

std::string results_text(const std::vector<Run>& runs, const std::vector<Case>& all) {
  Json json = to_json(collect_results(runs, all, References()));
  json["environment"].erase("date");
  json["environment"].erase("stored_runs");
  json.erase("store");
  for (Json& run : json["runs"]) run.erase("cost"), run.erase("stored");
  return json.dump();
}

RunOptions into(const fs::path& folder) {
  RunOptions options;
  options.store = folder / kStoreFolder;
  return options;
}

std::vector<fs::path> compute_shards(const Folder& folder, const std::vector<Case>& all,
                                     std::size_t count) {
  std::vector<fs::path> folders;
  for (std::size_t number = 1; number <= count; ++number) {
    folders.push_back(folder.path() / std::to_string(number));
    const Shard shard{number, count};
    write_shard(folders.back(), shard, {{"labels", {"x"}}},
                run_shard(all, into(folders.back()), shard));
  }
  return folders;
}

void change(const fs::path& folder, const char* key, const Json& value) {
  Json json = read_json(folder / kShardFile);
  json[key] = value;
  write_file(folder / kShardFile, json.dump());
}

}  // namespace

BOOST_AUTO_TEST_CASE(shard_option_is_read_from_k_of_n) {
  BOOST_TEST(parse_shard("2/8").number == 2U);
  BOOST_TEST(parse_shard("8/8").count == 8U);
  for (const char* bad : {"", "2", "0/3", "4/3", "1/100001", "-1/3", "1/3 ", "1/", "/3", "a/b"})
    BOOST_TEST(contains(input_error_message([&] { (void)parse_shard(bad); }), "expected K/N"), bad);
}

BOOST_AUTO_TEST_CASE(merged_shards_equal_a_run_without_shards) {
  const Folder folder;
  const std::vector<Case> all = cases(folder);
  const std::string whole = results_text(run_cases(all, References(), {}), all);
  const auto folders = compute_shards(folder, all, 3);
  RunOptions options = into(folder.path() / "merged");
  BOOST_TEST(merge_shards({folders[2], folders[0], folders[1]}, options.store)["labels"][0] == "x");
  options.resume = options.any_machine = true;
  std::size_t done_before = 0;
  options.progress = [&](std::size_t done, std::size_t) {
    if (done_before == 0) done_before = done;
  };
  BOOST_TEST(results_text(run_cases(all, References(), options), all) == whole);
  BOOST_TEST(done_before == 4U);  // the first reported variant ends with an error
}

BOOST_AUTO_TEST_CASE(incomplete_and_inconsistent_shards_are_refused) {
  const Folder folder;
  const auto folders = compute_shards(folder, cases(folder), 2);
  const fs::path store = folder.path() / "merged";
  const auto said = [&](const std::vector<fs::path>& some) {
    return input_error_message([&] { (void)merge_shards(some, store); });
  };
  BOOST_TEST(said(folders) == "");
  BOOST_TEST(contains(said({folders[0]}), "missing: 2"));
  BOOST_TEST(contains(said({folders[0], folders[0], folders[1]}), "each shard once"));
  BOOST_TEST(contains(said({folders[0], folder.path()}), "of a finished shard"));
  const std::string second = read_text(folders[1] / kShardFile);
  const auto said_with = [&](const char* key, const Json& value) {
    change(folders[1], key, value);
    const std::string line = said(folders);
    write_file(folders[1] / kShardFile, second);
    return line;
  };
  BOOST_TEST(contains(said_with("program", "another"), "expected this program"));
  BOOST_TEST(contains(said_with("of", 3), "/of: expected the same value"));
  BOOST_TEST(contains(said_with("selection", "all"), "/selection: expected the same value"));
  BOOST_TEST(contains(said_with("shard", 0), "/shard: expected a positive number"));
  BOOST_TEST(contains(said_with("computations", Json::array()), "in all shards (got"));
  const Json names = read_json(folders[0] / kShardFile)["computations"];
  BOOST_TEST(contains(said_with("computations", names), "each computation in one shard"));
}

BOOST_AUTO_TEST_SUITE_END()
