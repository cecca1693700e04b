#include "references/data/family.h"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

BOOST_AUTO_TEST_SUITE(family)

using namespace trammel::references;
using Json = nlohmann::json;

BOOST_AUTO_TEST_CASE(json_members_are_split_at_brackets_outside_strings) {
  const auto members = json_members(R"( {"b": {"x": [1, "}\"]\\"]}, "a" : "\\", "c":1} )");
  BOOST_REQUIRE(members.has_value());
  BOOST_TEST(members->size() == 3U);
  BOOST_TEST(Json::parse(*find_member(*members, "b"))["x"][1] == "}\"]\\");
  BOOST_TEST(Json::parse(*find_member(*members, "a")) == "\\");
  BOOST_TEST(Json::parse(*find_member(*members, "c")) == 1);
  BOOST_TEST(!find_member(*members, "x").has_value());
  BOOST_TEST(json_members("{}")->empty());
}

BOOST_AUTO_TEST_CASE(text_that_is_no_object_of_unique_keys_is_not_split) {
  for (const char* text :
       {"", "[]", "{", "{\"a\"", "{\"a\": 1", "{\"a\": \"1}", "{\"a\": \"\\\"}", "{\"a\": 1,}",
        "{\"a\": 1} 2", "{\"a\": 1, \"b\": 2, \"a\": 3}", "{a: 1}"})
    BOOST_TEST(!json_members(text).has_value(), text);
}

BOOST_AUTO_TEST_CASE(top_level_keys_are_found_in_formatted_json) {
  const auto keys = top_level_keys(
      "{\n  \"$schema\": \"s\",\n  \"common\": {\n    \"x\": {\n    },\n    \"y\": {}\n  },\n"
      "  \"first\": {\n  },\n  \"second\": {}\n}\n");
  BOOST_TEST((keys == std::vector<std::string_view>{"common", "first", "second"}));
  BOOST_TEST(top_level_keys("").empty());
}

BOOST_AUTO_TEST_CASE(keys_of_a_reference_override_those_of_its_family) {
  const Json common = Json::parse(R"({"unit": "m", "uncertainty": {"relative": 1},
    "derivation": {"program": "p", "arguments": {"a": {"x": 1}}}})");
  const Json own = Json::parse(R"({"uncertainty": {"absolute": 2},
    "derivation": {"arguments": {"a": {"y": 2}, "b": 3}}})");
  BOOST_TEST(merge_common_keys(common, own) ==
             Json::parse(R"({"unit": "m", "uncertainty": {"absolute": 2},
    "derivation": {"program": "p", "arguments": {"a": {"x": 1, "y": 2}, "b": 3}}})"));
  BOOST_TEST(merge_common_keys(Json(), {{"unit", "m"}}) == (Json{{"unit", "m"}}));
}

BOOST_AUTO_TEST_SUITE_END()
