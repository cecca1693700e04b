#include <malloc.h>

#include <boost/test/unit_test.hpp>

#include "harness/input/case.h"
#include "harness/input/catalogue.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(case_file)

using namespace trammel;
using namespace trammel::testing;

BOOST_AUTO_TEST_CASE(variant_is_applied_as_a_merge_patch) {
  const Folder folder;
  Json json = testing::cantilever();
  json["variants"]["deep"] = {
      {"title", "Twice as deep"},
      {"model",
       {{"sections", {{"bar", {{"rectangle", {{"thickness_m", 0.2}}}}}}}, {"loads", nullptr}}}};
  const Case given = testing::read(folder, json);
  BOOST_TEST((given.variants() == std::vector<std::string>{"base", "deep"}));
  BOOST_TEST(given.variant_title("deep") == "Twice as deep");
  const Json base = patched(given, "base").value(), deep = patched(given, "deep").value();
  const JsonPointer bar("/model/sections/bar/rectangle");
  BOOST_TEST((base.at(bar) == Json{{"thickness_m", 0.1}, {"width_m", 0.05}}));
  BOOST_TEST((deep.at(bar) == Json{{"thickness_m", 0.2}, {"width_m", 0.05}}));
  BOOST_TEST(base["model"].contains("loads"));
  BOOST_TEST(!deep["model"].contains("loads"));  // null in a patch removes the key
  BOOST_TEST(deep["title"] == base["title"]);
  BOOST_TEST(!deep.contains("variants"));
}

BOOST_AUTO_TEST_CASE(invalid_variant_is_refused_at_its_place) {
  const Folder folder;
  Json json = testing::cantilever();
  json["variants"]["thin"]["model"]["sections"]["bar"]["rectangle"]["thickness_m"] = -1;
  json["variants"]["removed"]["model"]["sections"]["bar"]["material"] = nullptr;
  const Case given = testing::read(folder, json);
  const std::string file = given.file.string();
  BOOST_TEST(input_error_message([&] { (void)patched(given, "thin"); }) ==
             file +
                 ": /variants/thin/model/sections/bar/rectangle/thickness_m: expected a number "
                 "above 0 (got -1)");
  BOOST_TEST(contains(input_error_message([&] { (void)patched(given, "removed"); }),
                      "/variants/removed/model/sections/bar: expected the key 'material'"));
  BOOST_TEST(
      contains(input_error_message([&] { (void)patched(given, "thn"); }), "did you mean 'thin'?"));
}

BOOST_AUTO_TEST_CASE(extending_case_inherits_model_but_no_checks) {
  const Folder folder;
  Json base = testing::cantilever();
  base["labels"] = {"mine"};
  base["checks"]["c"] = {{"quantity", "estimated_correct_digits"},
                         {"role", "verification"},
                         {"bound", {{"at_least", 1}, {"why", "w"}}}};
  base["variants"]["v"] = {
      {"model", {{"elements", 2}}}, {"checks", {{"c", nullptr}}}, {"expect_status", "singular"}};
  (void)folder.write(base);
  const Case given = testing::read(folder, {{"id", "longer"},
                                            {"title", "Longer"},
                                            {"extends", "cantilever.json"},
                                            {"model", {{"nodes", {{"B", {3, 0}}}}}}});
  BOOST_TEST((given.document.value()["model"]["nodes"] == Json{{"A", {0, 0}}, {"B", {3, 0}}}));
  BOOST_TEST(given.title() == "Longer");
  BOOST_TEST(given.labels().empty());
  BOOST_TEST(!given.document.value().contains("checks"));
  for (const char* key : {"checks", "expect_status"})
    BOOST_TEST(!given.document.value()["variants"]["v"].contains(key), key);
  BOOST_TEST((given.variants() == std::vector<std::string>{"base", "v"}));
  BOOST_TEST(patched(given, "v").value()["model"]["elements"] == 2);
}

BOOST_AUTO_TEST_CASE(error_in_an_extended_case_names_its_file) {
  const Folder folder;
  Json base = testing::cantilever();
  base["model"]["materials"]["steel"]["E_Pa"] = "stiff";
  const auto file = folder.write(base);
  const Json json = {{"id", "x"}, {"title", "X"}, {"extends", "cantilever"}};
  BOOST_TEST(input_error_message([&] { (void)testing::read(folder, json); }) ==
             file.string() +
                 ": /model/materials/steel/E_Pa: expected a number above 0 (got "
                 "\"stiff\")");
}

BOOST_AUTO_TEST_CASE(cyclic_extension_is_refused) {
  const Folder folder;
  (void)folder.write({{"id", "a"}, {"title", "A"}, {"extends", "b"}});
  const Json b = {{"id", "b"}, {"title", "B"}, {"extends", "a"}};
  BOOST_TEST(contains(input_error_message([&] { (void)testing::read(folder, b); }),
                      "/extends: the case extends itself"));
}

BOOST_AUTO_TEST_CASE(extended_case_may_be_in_another_folder) {
  const Folder folder;
  (void)folder.write("sub/cantilever.json", testing::cantilever().dump());
  const Json json = {{"id", "x"}, {"title", "X"}, {"extends", "sub/cantilever.json"}};
  BOOST_TEST(testing::read(folder, json).document.value().contains("analysis"));
  const Json lost = {{"id", "x"}, {"title", "X"}, {"extends", "sub/cantilver.json"}};
  BOOST_TEST(contains(input_error_message([&] { (void)testing::read(folder, lost); }),
                      "/extends: expected a catalogue case or a path relative to this file"));
}

BOOST_AUTO_TEST_CASE(stress_suite_indicator_must_be_a_check_of_the_case) {
  const Folder folder;
  const auto file =
      folder.write("beam.json", R"({"id": "beam", "title": "t", "analysis": {"modes": {"count": 1}},
    "stress_suite": {"item": 1, "indicators": ["digits", "driftt"]},
    "checks": {"digits": {"quantity": "q", "role": "verification", "bound": {"at_most": 1, "why": "w"}},
               "drift": {"quantity": "q", "role": "verification", "bound": {"at_most": 1, "why": "w"}}}})");
  const std::string said = input_error_message([&] { static_cast<void>(load_case(file)); });
  BOOST_TEST(contains(said, "/stress_suite/indicators/1"));
  BOOST_TEST(contains(said, "did you mean 'drift'?"));
}

BOOST_AUTO_TEST_CASE(case_id_is_the_file_name_in_the_catalogue_only) {
  const Folder folder;
  BOOST_TEST(load_case(folder.write("my beam.json", testing::cantilever().dump())).id() ==
             "cantilever");
  for (const Case& given : Catalogue().load()) BOOST_TEST(given.id() == given.file.stem().string());
}

BOOST_AUTO_TEST_CASE(sweep_sets_the_values_at_its_pointers) {
  const Folder folder;
  Json json = testing::cantilever();
  json["sweeps"]["length"] = {{"pointers", {"/model/elements", "/model/nodes/B/0"}},
                              {"values", {1, 2, 4}}};
  const auto found = sweep_levels(patched(testing::read(folder, json), "base"), "length");
  BOOST_REQUIRE(found.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& model = found[i].document.value()["model"];
    BOOST_TEST(model["elements"] == std::size_t{1} << i);
    BOOST_TEST((model["nodes"]["B"] == Json{std::size_t{1} << i, 0}));  // B.y keeps its value
    BOOST_TEST(found[i].parameter == static_cast<double>(std::size_t{1} << i));
  }
}

BOOST_AUTO_TEST_CASE(sweep_may_set_a_key_with_a_default) {
  const Folder folder;
  Json json = testing::cantilever();
  json["model"].erase("elements");
  json["sweeps"]["elements"] = {{"pointers", {"/model/elements"}}, {"values", {1, 2, 4}}};
  const auto found = sweep_levels(patched(testing::read(folder, json), "base"), "elements");
  BOOST_REQUIRE(found.size() == 3);
  BOOST_TEST(found[2].document.value()["model"]["elements"] == 4);
}

BOOST_AUTO_TEST_CASE(invalid_sweep_level_is_refused_at_its_value) {
  const Folder folder;
  Json json = testing::cantilever();
  json["sweeps"]["elements"] = {{"pointers", {"/model/elements"}}, {"values", {1, 2.5}}};
  json["sweeps"]["nowhere"] = {{"pointers", {"/model/elemnts"}}, {"values", {1, 2}}};
  json["sweeps"]["patches"] = {{"patches", {{{"model", {{"elements", 0}}}}, Json::object()}},
                               {"values", {1, 2}}};
  json["sweeps"]["both"] = json["sweeps"]["patches"];
  json["sweeps"]["both"]["pointers"] = {"/model/elements"};
  const Document base = patched(testing::read(folder, json), "base");
  const auto fault = [&](const char* sweep) {
    return input_error_message([&] { (void)sweep_levels(base, sweep); });
  };
  BOOST_TEST(contains(fault("elements"),
                      "/sweeps/elements/values/1: expected a whole number at least 1 and at most "
                      "65536 (got 2.5), at /model/elements"));
  BOOST_TEST(
      contains(fault("nowhere"), "/sweeps/nowhere/pointers/0: expected a pointer to a value"));
  BOOST_TEST(contains(fault("nowhere"), "did you mean 'elements'?"));
  BOOST_TEST(contains(fault("patches"), "/sweeps/patches/patches/0/model/elements: expected"));
  BOOST_TEST(contains(fault("both"), "/sweeps/both: expected exactly one of 'pointers'"));
}

BOOST_AUTO_TEST_CASE(variants_share_the_memory_of_their_file) {
  const Folder folder;
  Json json = testing::cantilever();
  const int count = 300;
  for (int i = 0; i < count; ++i)
    json["variants"]["v" + std::to_string(i)]["title"] = std::string(4000, 't');
  const Case given = testing::read(folder, json);
  const auto used = [] { return mallinfo2().uordblks; };
  const std::size_t before = used();
  std::vector<Document> documents;
  for (const std::string& variant : given.variants()) documents.push_back(patched(given, variant));
  BOOST_TEST(documents.size() == count + 1U);
  const std::size_t after = used();
  BOOST_TEST(after < before + 32 * 1024 * 1024);  // 301 copies of 1.2 MB would be 360 MB
}

BOOST_AUTO_TEST_SUITE_END()
