#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "harness/run/claims.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(paper_items)

using namespace trammel;
using namespace trammel::testing;
using results::PaperItem;

namespace {

std::vector<PaperItem> load_paper_item(const Json& item) {
  const Document document = Document::from_json(
      "claims.json", {{"claims", {{"1", Json::object()}}}, {"items", {{"equation-1", item}}}});
  return load_paper_items(document, Catalogue());
}

std::string item_error(Json item) {
  item["section"] = "1";
  item["what"] = "w";
  return input_error_message([&] { (void)load_paper_item(item); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_item_and_claim_of_the_paper_has_a_row) {
  const Document claim_set = load_claims();
  const std::vector<PaperItem> items = load_paper_items(claim_set, Catalogue());
  const auto has = [&](const std::string& id) {
    return std::any_of(items.begin(), items.end(), [&](const auto& one) { return one.id == id; });
  };
  for (int i = 1; i <= 38; ++i) BOOST_TEST(has("equation-" + std::to_string(i)), i);
  for (int i = 1; i <= 2; ++i) BOOST_TEST(has("table-" + std::to_string(i)), i);
  for (int i = 1; i <= 19; ++i) BOOST_TEST(has("figure-" + std::to_string(i)), i);
  for (const auto& claim : claim_set.value().at("claims").items()) {
    BOOST_TEST(std::any_of(items.begin(), items.end(),
                           [&](const PaperItem& one) {
                             return std::find(one.claims.begin(), one.claims.end(), claim.key()) !=
                                    one.claims.end();
                           }),
               claim.key());
  }
}

BOOST_AUTO_TEST_CASE(paper_item_must_name_existing_counterparts) {
  const auto shown = [](const Json& counterpart) {
    return item_error({{"shown_by", {counterpart}}});
  };
  BOOST_TEST(shown({{"case", "circle-load"}, {"quantity", "reaction_x_N:A1"}}) == "");
  BOOST_TEST(contains(shown({{"case", "circle-lode"}}), "circle-load"));
  BOOST_TEST(contains(shown({{"case", "circle-load"}, {"variant", "x"}}), "variant of the case"));
  BOOST_TEST(contains(shown({{"case", "circle-load"}, {"figure", "x"}}), "figure of the case"));
  BOOST_TEST(contains(shown({{"case", "circle-load"}, {"quantity", "frequency_Hz"}}),
                      "/items/equation-1/shown_by/0/quantity: the analysis of"));
  BOOST_TEST(contains(item_error({{"claims", {"2"}}}), "expected a claim (got '2')"));
  BOOST_TEST(contains(item_error(Json::object()), "requires 'shown_by', 'claims' or 'reason'"));
}

BOOST_AUTO_TEST_CASE(verdicts_are_counted_by_quantity_and_variant) {
  results::Check passes, differs;
  passes.quantity = differs.quantity = "displacement_x_m:P";
  passes.verdict = differs.verdict = results::Verdict::pass;
  passes.expectation = results::Expectation::agrees;
  differs.expectation = results::Expectation::known_discrepancy;
  results::Check other = passes;
  other.quantity = "displacement_y_m:P";
  results::Run run, variant;
  run.case_id = variant.case_id = "circle-load";
  run.variant = "base";
  variant.variant = "rigid-platform";
  run.checks = {passes, differs, other};
  variant.checks = {passes};
  results::Results all;
  all.runs = {run, variant};
  const auto verdict = [&](const std::string& of_variant, const std::string& quantity) {
    std::vector<PaperItem> items(1);
    items[0].shown_by = {{"circle-load", of_variant, quantity, "", ""}};
    judge_paper_items(all, items);
    return items[0].shown_by[0].verdict;
  };
  BOOST_TEST(verdict("", "displacement_x_m:P") == "2 checks pass and 1 known discrepancy");
  BOOST_TEST(verdict("rigid-platform", "") == "1 check passes");
  BOOST_TEST(verdict("", "rotation_rad:P") == "computed, not judged");
  BOOST_TEST(verdict("elbows-hinged", "") == "not computed");
}

BOOST_AUTO_TEST_SUITE_END()
