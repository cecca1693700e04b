#include "harness/run/claims.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/input/catalogue.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(claims)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::testing;

namespace {

Document claim_set(const Json& readings, const std::string& expected,
                   const std::string& together = "parts") {
  Json json = Json::parse(R"({"title": "A paper", "source": "someone-2020", "claims": {"1": {
    "title": "It holds", "claim": "It holds.", "place": "Page 1", "conclusion": "So it is."}}})");
  json["claims"]["1"].update(
      {{"interpretations", readings}, {"combine_as", together}, {"expected", expected}});
  Document document;
  document.apply_patch("claims.json", "", json);
  document.validate("claims");
  return document;
}

CheckResult entry(const std::string& name, double computed, double expected) {
  CheckResult one;
  one.name = name;
  one.unit = "m";
  one.computed = computed;
  one.expected = expected;
  one.verdict = Verdict::pass;
  return one;
}

/// Returns a run of the case "bend" with the check "tip" of two values, the check "tip-y" of one
/// value, and the quantity frequency_Hz.
Run bend(double first, double second) {
  Run run;
  run.case_id = "bend";
  run.variant = "base";
  run.status = results::Status::solved;
  run.checks = {entry("tip", first, 1), entry("tip", second, 1), entry("tip-y", 5, 1)};
  run.checks[0].index = 0;
  run.checks[1].index = 1;
  run.quantities["frequency_Hz"] = {{1, 3, 2}, {}};
  return run;
}

const Json ratio = {{"description", "tip over target"},
                    {"case", "bend"},
                    {"check", "tip"},
                    {"metric", "ratio"},
                    {"confirms", {0.9, 1.1}},
                    {"contradicts", {1.5, nullptr}}};

const Json grows = {{"description", "growth"},    {"case", "bend"},
                    {"quantity", "frequency_Hz"}, {"metric", "steps"},
                    {"confirms", {0, nullptr}},   {"contradicts", {nullptr, 0}}};

std::string verdict(const Document& document, const std::vector<Run>& runs) {
  return evaluate_claims(document, runs).claims.at(0).verdict;
}

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_and_rules_alone_decide_a_claim) {
  const Document document = claim_set({{"r", ratio}}, "confirmed");
  BOOST_TEST((verdict(document, {bend(1, 1.05)}) == "confirmed"));
  BOOST_TEST((verdict(document, {bend(2, 3)}) == "contradicted"));
  BOOST_TEST((verdict(document, {bend(1, 3)}) == "confirmed in part"));
  BOOST_TEST((verdict(document, {bend(1.2, 1.3)}) == "cannot be decided"));
  BOOST_TEST((verdict(document, {}) == "not measured"));
}

BOOST_AUTO_TEST_CASE(changed_verdict_of_a_claim_is_detected) {
  const Document document = claim_set({{"r", ratio}}, "confirmed");
  BOOST_TEST(exit_status(evaluate_claims(document, {bend(1, 1)})) == 0);
  BOOST_TEST(exit_status(evaluate_claims(document, {bend(1, 2)})) == 1);
  BOOST_TEST(!evaluate_claims(document, {}).as_recorded);
}

BOOST_AUTO_TEST_CASE(claim_set_with_a_changed_verdict_is_not_as_recorded) {
  Json json = claim_set({{"r", ratio}}, "confirmed").value();
  json["claims"]["2"] = json["claims"]["1"];
  json["claims"]["2"]["expected"] = "contradicted";
  const Document document = Document::from_json("claims.json", json);
  BOOST_TEST(!evaluate_claims(document, {bend(1, 1)}).as_recorded);
}

BOOST_AUTO_TEST_CASE(claim_with_a_missing_number_is_not_measured) {
  const Document document = claim_set({{"r", ratio}}, "confirmed");
  Run broken = bend(1, 1);
  broken.status = results::Status::error;
  BOOST_TEST((verdict(document, {broken}) == "not measured"));
  Run other = bend(1, 1);
  other.case_id = "buckle";
  BOOST_TEST((verdict(document, {other}) == "not measured"));
  Run half = bend(1, 1);
  half.checks[1].computed.reset();
  const auto found = evaluate_claims(document, {half});
  BOOST_TEST((found.claims.at(0).verdict == "not measured"));
  BOOST_TEST((found.claims.at(0).interpretations.at(0).verdict == "not measured"));
  half.checks[1].computed = std::nan("");
  BOOST_TEST((verdict(document, {half}) == "not measured"));
}

BOOST_AUTO_TEST_CASE(missing_interpretation_leaves_a_claim_unmeasured) {
  Json other = ratio;
  other["check"] = "tip-y";
  Run half = bend(1, 1);
  half.checks[1].computed.reset();
  BOOST_TEST(
      (verdict(claim_set({{"r", ratio}, {"s", other}}, "contradicted"), {half}) == "not measured"));
}

BOOST_AUTO_TEST_CASE(relative_metric_refers_to_the_expected_value) {
  Json relative = ratio;
  relative["metric"] = "relative";
  relative["confirms"] = {0.45, 0.55};
  relative["contradicts"] = {0.6, nullptr};
  const Document document = claim_set({{"r", relative}}, "confirmed");
  BOOST_TEST((verdict(document, {bend(1.5, 1.5)}) == "confirmed"));
  BOOST_TEST((verdict(document, {bend(3, 3)}) == "contradicted"));
}

BOOST_AUTO_TEST_CASE(claim_with_contradictory_alternatives_is_undecided) {
  Json second = ratio;
  second["check"] = "tip-y";
  const Json both = {{"x", ratio}, {"y", second}};
  const std::vector<Run> runs = {bend(1, 1)};
  BOOST_TEST((verdict(claim_set(both, "confirmed"), runs) == "confirmed in part"));
  BOOST_TEST((verdict(claim_set(both, "confirmed", "alternatives"), runs) == "cannot be decided"));
  second["check"] = "tip*";
  BOOST_TEST(evaluate_claims(claim_set({{"all", second}}, "confirmed"), runs)
                 .claims[0]
                 .interpretations[0]
                 .entries.size() == 3U);
}

BOOST_AUTO_TEST_CASE(claim_requiring_all_entries_fails_if_one_entry_fails) {
  Json jointly = ratio;
  jointly["require_all_entries"] = true;
  jointly["contradicts"] = "otherwise";
  const Document document = claim_set({{"r", jointly}}, "confirmed");
  BOOST_TEST((verdict(document, {bend(1, 1)}) == "confirmed"));
  BOOST_TEST((verdict(document, {bend(1, 3)}) == "contradicted"));
  BOOST_TEST((verdict(document, {bend(3, 1)}) == "contradicted"));
}

BOOST_AUTO_TEST_CASE(confirms_otherwise_accepts_all_not_contradicting) {
  Json away = ratio;
  away["confirms"] = "otherwise";
  away["contradicts"] = {-1, 1};
  const Document document = claim_set({{"r", away}}, "confirmed");
  BOOST_TEST(evaluate_claims(document, {bend(-3, 2)}).as_recorded);
  BOOST_TEST(!evaluate_claims(document, {}).as_recorded);
  BOOST_TEST(!evaluate_claims(document, {bend(0.5, 0.5)}).as_recorded);
}

BOOST_AUTO_TEST_CASE(growth_of_a_quantity_is_measured_between_entries) {
  const results::Claims found =
      evaluate_claims(claim_set({{"g", grows}}, "confirmed"), {bend(1, 1)});
  const results::ClaimInterpretation& reading = found.claims[0].interpretations[0];
  BOOST_REQUIRE(reading.entries.size() == 2U);
  BOOST_TEST(reading.entries[0].value == 2);
  BOOST_TEST(reading.entries[1].value == -1);
  BOOST_TEST(reading.unit == "Hz");
  BOOST_TEST((reading.verdict == "confirms in part"));
}

BOOST_AUTO_TEST_CASE(claim_on_a_nan_quantity_is_not_measured) {
  Json value = grows;
  value["metric"] = "value";
  Run run = bend(1, 1);
  run.quantities["frequency_Hz"] = {{1, std::nan(""), 2}, {}};
  const results::Claims found = evaluate_claims(claim_set({{"g", value}}, "confirmed"), {run});
  BOOST_TEST((found.claims[0].verdict == "not measured"));
  BOOST_TEST(found.claims[0].interpretations[0].entries.size() == 2U);
  for (const results::ClaimEntry& entry : found.claims[0].interpretations[0].entries)
    BOOST_TEST(std::isfinite(entry.value));
}

BOOST_AUTO_TEST_CASE(contradictory_claim_rule_is_refused) {
  const auto refusal = [](const char* key, const Json& value) {
    Json reading = ratio;
    reading[key] = value;
    if (value.is_null()) reading.erase(key);
    return input_error_message([&] {
      (void)evaluate_claims(claim_set({{"r", reading}}, "confirmed"), {bend(1, 1)});
    });
  };
  BOOST_TEST(contains(refusal("contradicts", {1, 2}), "/claims/1/interpretations/r: the ranges"));
  BOOST_TEST(contains(refusal("quantity", "frequency_Hz"), "expected either 'quantity'"));
  BOOST_TEST(contains(refusal("metric", "steps"), "/claims/1/interpretations/r/metric: expected"));
  BOOST_TEST(contains(refusal("metric", "quotient"), "/claims/1/interpretations/r/metric"));
}

BOOST_AUTO_TEST_CASE(eleven_claims_name_existing_cases_and_checks) {
  const Document document = load_claims();
  const results::Claims found = evaluate_claims(document, {});
  BOOST_TEST(found.claims.size() == 11U);
  for (const results::Claim& claim : found.claims) {
    const bool undecidable = !claim.undecidable.empty();
    BOOST_TEST((claim.verdict == (undecidable ? "cannot be decided" : "not measured")));
  }
  // Every interpretation of a claim names an existing case and check.
  const std::vector<Case> catalogue = Catalogue().load();
  for (const auto& [id, claim] : JsonView(document)["claims"].entries()) {
    if (!claim.has("interpretations")) continue;
    for (const auto& [name, reading] : claim["interpretations"].entries()) {
      if (!reading.has("case")) continue;
      const auto owner = std::find_if(
          catalogue.begin(), catalogue.end(),
          [&, &place = reading](const Case& one) { return one.id() == place.text("case"); });
      BOOST_TEST_REQUIRE((owner != catalogue.end()), id << " " << name);
      if (!reading.has("check") || reading.text("check").back() == '*') continue;
      BOOST_TEST(JsonView(owner->document)["checks"].has(reading.text("check")), id << " " << name);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
