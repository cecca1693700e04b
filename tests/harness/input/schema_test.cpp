#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
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
using namespace trammel::testing;

namespace {

/// JSON pointer into a case, an invalid value, and a part of the expected "pointer: message".
struct Refusal {
  const char *pointer, *value, *message;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
  return out << refusal.pointer << " " << refusal.value;
}

const Refusal kRefusals[] = {
    {"/model/manipulator/material/E_pa", "1",
     "/model/manipulator/material/E_pa: unknown key; did you mean 'E_Pa'?"},
    {"/modle", "{}", "did you mean 'model'?"},
    {"/model/manipulator/links/thicknes_m", "1", "did you mean 'thickness_m'?"},
    {"/model/manipulator/qqqq", "1", "unknown key; expected 'base_m'"},
    {"/model/manipulator/joints/active", "\"lokced\"", "(got \"lokced\"); did you mean 'locked'?"},
    {"/model/manipulator/links/thickness_m", "-0.1",
     "/model/manipulator/links/thickness_m: expected a number above 0 (got -0.1)"},
    {"/model/manipulator/links/elements", "0",
     "/model/manipulator/links/elements: expected a whole number at least 1 and at most 65536 (got "
     "0)"},
    {"/model/manipulator/links/elements", "2.5", "a whole number"},
    {"/model/manipulator/links/elements", "null", "(got null)"},
    {"/model/manipulator/material/E_Pa", "0", "material/E_Pa: expected"},
    {"/model/pose/x_m", "\"far\"", "/model/pose/x_m: expected a number (got \"far\")"},
    {"/model/supports", R"({"P": ["x", "x"]})", "/model/supports/P: expected"},
    {"/model/manipulator/links/mass_kg", "true",
     "/model/manipulator/links/mass_kg: expected a number above 0 or 'from-density' (got true)"},
    // If a value may have several forms, such as a number or an array, the error message contains
    // the pointer of the innermost invalid value.
    {"/model/manipulator/links/proximal_length_m", "[0.2, -0.2, 0.2]",
     "/model/manipulator/links/proximal_length_m/1: expected a number above 0 (got -0.2)"},
    {"/model/manipulator/material", R"({"nu": 0.33, "rho_kg_m3": 2700})",
     "/model/manipulator/material: expected the key 'E_Pa' (got 'nu' and 'rho_kg_m3')"},
    {"/analysis", R"({"grnn": {"search": {"from": 1}}})",
     "/analysis/grnn/search: expected the key 'to' (got 'from')"},
    {"/analysis", "{}", "expected exactly one of"},
    {"/analysis", R"({"modes": {"count": 1}, "statics": {}})", "expected exactly one of"},
    {"/stress_suite", R"({"item": 2147483648, "indicators": ["c"]})", "/stress_suite/item"}};

}  // namespace

BOOST_DATA_TEST_CASE(invalid_value_is_refused_at_its_place, kRefusals, refusal) {
  Json json = testing::manipulator();
  BOOST_TEST(!find_schema_fault(json, "case").has_value());
  json[JsonPointer(refusal.pointer)] = Json::parse(refusal.value);
  const auto found = find_schema_fault(json, "case");
  BOOST_REQUIRE(found.has_value());
  BOOST_TEST(contains(found->pointer + ": " + found->message, refusal.message),
             found->pointer << ": " << found->message);
}

BOOST_AUTO_TEST_CASE(valid_values_at_the_limits_are_accepted) {
  Json json = testing::manipulator();
  json["model"]["manipulator"]["material"]["E_Pa"] = 1e-300;
  json["model"]["supports"]["P"] = {"x", "y"};
  BOOST_TEST(!find_schema_fault(json, "case").has_value());
}

BOOST_AUTO_TEST_CASE(every_key_of_the_schemas_has_a_description) {
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

BOOST_AUTO_TEST_CASE(schemas_use_only_implemented_keywords) {
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
      BOOST_TEST((!refers || used), key << " next to $ref or anyOf is not checked");
      if (key == "properties" || key == "definitions" || key == "anyOf") {
        for (const Json& inner : item.value()) visit(inner, false);
      } else if (key == "items" || key == "additionalProperties") {
        visit(item.value(), false);
      }
    }
  };
  for (const char* name : {"adapter_result", "case", "claims", "cost", "reference", "results"})
    visit(read_json(data_root() / "cases" / "schema" / (std::string(name) + ".schema.json")), true);
}

BOOST_AUTO_TEST_CASE(every_stored_reference_obeys_the_schema) {
  int seen = 0;
  const std::string values = (data_root() / "references" / "values").string();
  for (const auto& [family, file] : json_files(values)) {
    const Json json = read_json(file);
    const auto found = find_schema_fault(json, "reference");
    BOOST_TEST(!found.has_value(), family << (found ? ": " + found->pointer + found->message : ""));
    // `top_level_keys` finds all references of a family file. This requires the usual line breaks,
    // and replaces parsing the file.
    const auto keys = top_level_keys(read_file(file).text);
    const bool has_schema = json.contains("$schema");
    BOOST_TEST(keys.size() == json.size() - (has_schema ? 1 : 0), family);
    ++seen;
  }
  BOOST_TEST(seen > 10);
}

BOOST_AUTO_TEST_CASE(orders_of_corners_are_twice_the_stored_exponents) {
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

BOOST_AUTO_TEST_CASE(every_integer_of_the_schemas_has_a_bound) {
  const std::function<void(const Json&, const std::string&)> visit = [&](const Json& rule,
                                                                         const std::string& key) {
    if (rule.is_object() && rule.value("type", Json()) == "integer") {
      const double most = key == "seed" ? 9007199254740991 : 2147483647;
      BOOST_TEST((rule.contains("maximum") && rule["maximum"].get<double>() <= most), key);
    }
    if (!rule.is_structured()) return;
    for (const auto& item : rule.items()) visit(item.value(), item.key());
  };
  for (const char* name : {"case", "claims", "cost", "reference"})
    visit(read_json(data_root() / "cases" / "schema" / (std::string(name) + ".schema.json")), name);
}

BOOST_AUTO_TEST_SUITE_END()
