#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <set>

#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/input/catalogue.h"
#include "harness/input/document.h"
#include "harness/input/reference_library.h"
#include "references/data/family.h"
#include "references/data/reference.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(schema)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::harness;
using testing::contains;

namespace {

/// "pointer: message" of the case with one place changed.
std::string fault(Json json, const std::string& pointer, const Json& value) {
  json[JsonPointer(pointer)] = value;
  const auto found = find_schema_fault(json, "case");
  return found ? found->pointer + ": " + found->message : "";
}

std::string robot_fault(const std::string& pointer, const Json& value) {
  return fault(testing::manipulator(), pointer, value);
}

}  // namespace

BOOST_AUTO_TEST_CASE(good_cases_obey_the_schema) {
  BOOST_TEST(!find_schema_fault(testing::manipulator(), "case").has_value());
  BOOST_TEST(!find_schema_fault(testing::cantilever(), "case").has_value());
}

BOOST_AUTO_TEST_CASE(a_misspelt_key_is_answered_with_the_nearest_right_one) {
  BOOST_TEST(robot_fault("/model/manipulator/material/E_pa", 1) ==
             "/model/manipulator/material/E_pa: expected no key of that name; did you mean "
             "'E_Pa'?");
  BOOST_TEST(contains(robot_fault("/modle", Json::object()), "did you mean 'model'?"));
  BOOST_TEST(contains(robot_fault("/model/manipulator/links/thicknes_m", 1),
                      "did you mean 'thickness_m'?"));
  BOOST_TEST(contains(robot_fault("/model/manipulator/qqqq", 1), "known here: 'base_m'"));
}

BOOST_AUTO_TEST_CASE(a_misspelt_word_is_answered_with_the_nearest_right_one) {
  BOOST_TEST(contains(robot_fault("/model/manipulator/joints/active", "lokced"),
                      "(got \"lokced\"); did you mean 'locked'?"));
}

BOOST_AUTO_TEST_CASE(a_value_outside_of_its_range_is_answered_with_the_range) {
  BOOST_TEST(robot_fault("/model/manipulator/links/thickness_m", -0.1) ==
             "/model/manipulator/links/thickness_m: expected a number above 0 (got -0.1)");
  BOOST_TEST(robot_fault("/model/manipulator/links/elements", 0) ==
             "/model/manipulator/links/elements: expected a whole number at least 1 and at most "
             "65536 (got 0)");
  BOOST_TEST(contains(robot_fault("/model/manipulator/links/elements", 2.5), "a whole number"));
  BOOST_TEST(contains(robot_fault("/model/manipulator/links/elements", nullptr), "(got null)"));
  BOOST_TEST(robot_fault("/model/pose/x_m", "far") ==
             "/model/pose/x_m: expected a number (got \"far\")");
}

BOOST_AUTO_TEST_CASE(what_stands_twice_in_a_list_of_names_is_refused) {
  BOOST_TEST(fault(testing::cantilever(), "/model/supports/A", {"x", "y"}).empty());
  BOOST_TEST(contains(fault(testing::cantilever(), "/model/supports/A", {"x", "x"}),
                      "/model/supports/A: expected"));
}

BOOST_AUTO_TEST_CASE(alternatives_are_all_named) {
  BOOST_TEST(robot_fault("/model/manipulator/links/mass_kg", true) ==
             "/model/manipulator/links/mass_kg: expected a number above 0 or 'from-density' "
             "(got true)");
  // Inside an alternative the innermost fault is the cause.
  BOOST_TEST(robot_fault("/model/manipulator/links/proximal_length_m", {0.2, -0.2, 0.2}) ==
             "/model/manipulator/links/proximal_length_m/1: expected a number above 0 (got -0.2)");
}

BOOST_AUTO_TEST_CASE(a_missing_key_is_named_where_it_is_missing) {
  Json json = testing::manipulator();
  json["model"]["manipulator"]["material"].erase("E_Pa");
  const auto found = find_schema_fault(json, "case");
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(found->pointer == "/model/manipulator/material");
  BOOST_TEST(found->message == "expected the key 'E_Pa' (got 'nu' and 'rho_kg_m3')");
}

BOOST_AUTO_TEST_CASE(a_key_that_needs_another_beside_it_is_answered_with_that) {
  BOOST_TEST(robot_fault("/analysis", {{"grnn", {{"search", {{"from", 1}}}}}}) ==
             "/analysis/grnn/search: expected the key 'to' (got 'from')");
}

BOOST_AUTO_TEST_CASE(an_analysis_is_exactly_one) {
  BOOST_TEST(contains(robot_fault("/analysis", Json::object()), "expected exactly one of"));
  BOOST_TEST(
      contains(robot_fault("/analysis", {{"modes", {{"count", 1}}}, {"statics", Json::object()}}),
               "expected exactly one of"));
}

BOOST_AUTO_TEST_CASE(every_key_of_the_schemas_says_what_it_is) {
  for (const char* name : {"adapter_result", "case", "cost", "reference", "results"}) {
    const Json text =
        read_json(data_root() / "cases" / "schema" / (std::string(name) + ".schema.json"));
    BOOST_TEST(text.contains("description"), name);
    for (const auto& item : text.at("properties").items()) {
      const bool elsewhere = item.value().contains("$ref") || item.key() == "runs" ||
                             item.key() == "title" || item.key() == "values";
      BOOST_TEST((item.value().contains("description") || elsewhere), name << ' ' << item.key());
    }
  }
}

BOOST_AUTO_TEST_CASE(the_schemas_use_only_what_is_checked) {
  const std::string checked =
      " type enum minimum maximum exclusiveMinimum minLength pattern minItems maxItems uniqueItems "
      "items required anyOf properties description minProperties maxProperties $ref "
      "additionalProperties dependencies ";
  const std::set<std::string> at_the_root = {"$schema", "title", "definitions"};
  const std::function<void(const Json&, bool)> visit = [&](const Json& rule, bool is_root) {
    if (!rule.is_object()) return;
    const bool refers = rule.contains("$ref") || rule.contains("anyOf");
    for (const auto& item : rule.items()) {
      const std::string& key = item.key();
      BOOST_TEST((contains(checked, " " + key + " ") || (is_root && at_the_root.count(key) > 0)),
                 key);
      if (key == "pattern") BOOST_TEST(item.value() == "^[A-Za-z0-9][A-Za-z0-9._-]*$");
      const bool used = key == "description" || key == "$ref" || key == "anyOf";
      BOOST_TEST((!refers || used), key << " beside $ref or anyOf is not checked");
      if (key == "properties" || key == "definitions" || key == "anyOf") {
        for (const Json& inner : item.value()) visit(inner, false);
      } else if (key == "items" || key == "additionalProperties") {
        visit(item.value(), false);
      }
    }
  };
  for (const char* name : {"adapter_result", "case", "claims", "cost", "reference", "results"}) {
    visit(read_json(data_root() / "cases" / "schema" / (std::string(name) + ".schema.json")), true);
  }
}

BOOST_AUTO_TEST_CASE(every_stored_reference_obeys_the_schema) {
  int seen = 0;
  const std::string values = (data_root() / "references" / "values").string();
  for (const auto& [family, file] : json_files(values)) {
    const Json json = read_json(file);
    const auto found = find_schema_fault(json, "reference");
    BOOST_TEST(!found.has_value(), family << (found ? ": " + found->pointer + found->message : ""));
    // The form in which a reference is found without splitting all files.
    const auto keys = keys_of_blocks(read_file(file).text);
    const bool has_schema = json.contains("$schema");
    BOOST_TEST(keys.size() == json.size() - (has_schema ? 1 : 0), family);
    ++seen;
  }
  BOOST_TEST(seen > 10);
}

BOOST_AUTO_TEST_CASE(orders_of_singular_corners_are_twice_the_stored_exponents) {
  const auto exponent = [](const std::string& of) {
    const References references;
    return references.add(references.catalogue().at(of + "-corner-exponent")).values[0];
  };
  const auto sweep = [](const std::string& of, const std::string& variant) {
    const Json json = read_json(Catalogue().find_case(of));
    return (variant.empty() ? json : json["variants"][variant])["sweeps"]["divisions"];
  };
  const auto check = [](const Json& order, double exponent_at_corner) {
    BOOST_TEST(std::abs(order.get<double>() - 2 * exponent_at_corner) < 5e-4);
  };
  check(sweep("cooks-membrane", "even")["theory_order"], exponent("cook"));
  check(sweep("cooks-membrane", "three-node")["lower_order"], exponent("cook"));
  check(sweep("nafems-fv32", "")["lower_order"], exponent("nafems-fv32"));
  check(sweep("macneal-harder-beam", "fine")["lower_order"], exponent("macneal-harder"));
}

BOOST_AUTO_TEST_CASE(every_integer_of_the_schemas_has_a_bound_that_its_reader_can_hold) {
  const std::function<void(const Json&, const std::string&)> visit = [&](const Json& rule,
                                                                         const std::string& key) {
    if (rule.is_object() && rule.value("type", Json()) == "integer") {
      const double most = key == "seed" ? 9007199254740991 : 2147483647;
      BOOST_TEST((rule.contains("maximum") && rule["maximum"].get<double>() <= most), key);
    }
    if (!rule.is_structured()) return;
    for (const auto& item : rule.items()) visit(item.value(), item.key());
  };
  for (const char* name : {"case", "claims", "cost", "reference"}) {
    visit(read_json(data_root() / "cases" / "schema" / (std::string(name) + ".schema.json")), name);
  }
  const Json suite = {{"item", 2147483648}, {"indicators", {"c"}}};
  BOOST_TEST(contains(fault(testing::cantilever(), "/stress_suite", suite), "/stress_suite/item"));
}

BOOST_AUTO_TEST_CASE(what_must_be_positive_is_not_zero) {
  BOOST_TEST(robot_fault("/model/manipulator/material/E_Pa", 1e-300).empty());
  BOOST_TEST(
      contains(robot_fault("/model/manipulator/material/E_Pa", 0), "material/E_Pa: expected"));
}

BOOST_AUTO_TEST_SUITE_END()
