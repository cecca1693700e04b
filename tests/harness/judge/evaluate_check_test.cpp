#include "harness/judge/evaluate_check.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "harness/base/statistic.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(evaluate_check)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::testing;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A run with three frequencies, their reference, and one check of the frequencies.
struct Bench {
  std::shared_ptr<Folder> folder = std::make_shared<Folder>();
  Json check = {{"quantity", "frequency_Hz"},
                {"reference", "truth"},
                {"role", "verification"},
                {"tolerance", {{"relative", 1e-3}, {"why", "a reason"}}}};
  Json reference = {{"id", "truth"},          {"title", "Truth"},
                    {"kind", "paper"},        {"unit", "Hz"},
                    {"values", {10, 20, 30}}, {"uncertainty", {{"absolute", 1e-6}}},
                    {"source", "me"},         {"place", "here"}};
  Quantities quantities = {{"frequency_Hz", {{10, 20, 30}, {}}}};
  Quantities other = {{"frequency_Hz", {{5, 10, 15}, {}}}};
  bool has_other = true;
  const results::SolverIdentity* other_solver = nullptr;

  std::vector<CheckResult> judge_all() {
    folder->write_reference(reference);
    Json json = testing::cantilever();
    json["checks"]["c"] = check;
    json["variants"]["other"] = Json::object();
    const Document document = patched(testing::read(*folder, json), "base");
    const auto checks = read_checks(document, "base", {"base", "other"});
    const References references;
    const auto variant = [&](const std::string&) { return has_other ? &other : nullptr; };
    return harness::evaluate_check(checks.at(0),
                                   {document, quantities, {}, references, variant, other_solver});
  }
  /// Returns the worst verdict of all values of the check, and stores the message of this verdict.
  std::string verdict() {
    Verdict worst = Verdict::pass;
    for (const CheckResult& one : judge_all()) {
      message = one.verdict == Verdict::pass ? message : one.message;
      if (one.verdict != Verdict::pass && worst != Verdict::error) worst = one.verdict;
    }
    return to_string(worst);
  }
  void set(std::size_t i, double value) { quantities["frequency_Hz"].values.at(i) = value; }

  std::string message;
};

Bench validation_bench(const char* kind, const Json& window) {
  Bench bench;
  bench.check.erase("tolerance");
  bench.check["role"] = "validation";
  bench.check["expect"] = {{kind, "a reason"}, {"relative_between", window}};
  return bench;
}

}  // namespace

BOOST_AUTO_TEST_CASE(agreeing_entries_of_a_check_pass_separately) {
  Bench bench;
  const auto all = bench.judge_all();
  BOOST_REQUIRE(all.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST((all[i].verdict == Verdict::pass));
    BOOST_TEST(all[i].index.value() == i);
    BOOST_TEST(all[i].expected.value() == all[i].computed.value());
    BOOST_TEST(all[i].unit == "Hz");
    BOOST_TEST(all[i].why == "a reason");
  }
}

BOOST_AUTO_TEST_CASE(difference_beyond_tolerance_fails_with_either_sign) {
  for (const double sign : {-1.0, 1.0}) {
    Bench bench;
    bench.set(1, 20 * (1 + sign * 0.9e-3));
    BOOST_TEST(bench.verdict() == "pass");
    bench.set(1, 20 * (1 + sign * 1.1e-3));
    BOOST_TEST(bench.verdict() == "fail");
  }
}

BOOST_AUTO_TEST_CASE(relative_difference_of_negative_values_keeps_its_sign) {
  Bench bench;
  bench.reference["values"] = {-10, -20, -30};
  bench.quantities["frequency_Hz"].values = {-10.005, -20, -30};
  BOOST_TEST(bench.judge_all().at(0).difference.value() == -5e-4,
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(fail_error_and_not_run_count_as_failures) {
  for (const Verdict closed : {Verdict::fail, Verdict::error, Verdict::not_run})
    BOOST_TEST(counts_as_failure(closed), to_string(closed));
  for (const Verdict open : {Verdict::pass, Verdict::recorded, Verdict::not_given})
    BOOST_TEST(!counts_as_failure(open), to_string(open));
}

BOOST_AUTO_TEST_CASE(absolute_tolerance_has_the_unit_of_the_quantity) {
  Bench bench;
  bench.check["tolerance"] = {{"absolute", 0.5}, {"why", "w"}};
  bench.set(2, 30.4);
  BOOST_TEST(bench.verdict() == "pass");
  bench.set(2, 30.6);
  BOOST_TEST(bench.verdict() == "fail");
}

BOOST_AUTO_TEST_CASE(not_finite_number_is_an_error) {
  for (const double value : {not_a_number, infinity, -infinity}) {
    Bench bench;
    bench.set(0, value);
    BOOST_TEST(bench.verdict() == "error");
    bench.check["statistic"] = "max";
    bench.check["reference_index"] = 2;
    BOOST_TEST(bench.verdict() == "error");
  }
}

BOOST_AUTO_TEST_CASE(nan_message_names_computed_or_expected_value) {
  Bench computed;
  computed.set(1, not_a_number);
  BOOST_TEST(computed.verdict() == "error");
  BOOST_TEST(contains(computed.message, "the computed value is"), computed.message);
  Bench expected;
  expected.check.erase("reference");
  expected.check["against_variant"] = "other";
  expected.other = {{"frequency_Hz", {{infinity, 20, 30}, {}}}};
  BOOST_TEST(expected.verdict() == "error");
  BOOST_TEST(contains(expected.message, "the expected value is"), expected.message);
  Bench none;
  none.reference["values"] = {0, 20, 30};
  BOOST_TEST(none.verdict() == "error");
  BOOST_TEST(contains(none.message, "the measure relative is undefined"), none.message);
}

BOOST_AUTO_TEST_CASE(missing_quantity_is_an_error_with_a_suggestion) {
  Bench bench;
  bench.check["quantity"] = "frequncy_Hz";
  BOOST_TEST(bench.verdict() == "error");
  BOOST_TEST(contains(bench.message, "no quantity 'frequncy_Hz'; did you mean 'frequency_Hz'?"));
  bench.check["quantity"] = "frequency_Hz:1";
  BOOST_TEST(bench.verdict() == "error");
  BOOST_TEST(contains(bench.message, "the key 'index' selects a value"));
}

BOOST_AUTO_TEST_CASE(wrong_length_is_an_error) {
  Bench shorter;
  shorter.quantities["frequency_Hz"].values.pop_back();
  BOOST_TEST(shorter.verdict() == "error");
  BOOST_TEST(contains(shorter.message, "the numbers of values differ: 2 computed, 3 expected"));
  Bench longer;
  longer.quantities["frequency_Hz"].values.push_back(40);
  BOOST_TEST(longer.verdict() == "error");
  Bench empty;
  empty.quantities["frequency_Hz"].values.clear();
  BOOST_TEST(empty.verdict() == "error");
}

BOOST_AUTO_TEST_CASE(index_outside_the_array_is_an_error) {
  Bench bench;
  bench.check["index"] = 3;
  bench.check["reference_index"] = 0;
  BOOST_TEST(bench.verdict() == "error");
  bench.check["index"] = 0;
  BOOST_TEST(bench.verdict() == "pass");
  bench.check["reference_index"] = 3;
  BOOST_TEST(bench.verdict() == "error");
}

BOOST_AUTO_TEST_CASE(wrong_unit_is_an_error) {
  Bench bench;
  bench.reference["unit"] = "rad/s";
  BOOST_TEST(bench.verdict() == "error");
  BOOST_TEST(contains(bench.message,
                      "the unit of frequency_Hz is Hz, that of reference truth is "
                      "rad/s"));
}

BOOST_AUTO_TEST_CASE(reference_less_certain_than_tolerance_is_an_error) {
  Bench bench;
  bench.reference["uncertainty"] = {{"absolute", 0.5}};
  BOOST_TEST(bench.verdict() == "error");
  BOOST_TEST(contains(bench.message, "the uncertainty of the reference is +-0.5"));
  bench.reference["uncertainty"] = {{"absolute", 0.015}};  // exceeds the tolerance, +-0.01
  BOOST_TEST(bench.verdict() == "error");
  bench.reference["uncertainty"] = {{"absolute", 0.009}};
  BOOST_TEST(bench.verdict() == "pass");
}

BOOST_AUTO_TEST_CASE(printed_digits_determine_the_uncertainty) {
  Bench bench;
  bench.reference.erase("uncertainty");
  bench.reference["printed"] = {"10.00", "20.000", "30"};
  BOOST_TEST(bench.verdict() ==
             "error");  // the uncertainty is half a unit of the last digit of "30"
  bench.reference["printed"] = {"10.00", "20.000", "30.00"};
  BOOST_TEST(bench.verdict() == "pass");
}

BOOST_AUTO_TEST_CASE(bound_judges_the_computed_value_only) {
  Bench bench;
  bench.check.erase("reference");
  bench.check.erase("tolerance");
  bench.check["bound"] = {{"at_least", 5}, {"at_most", 30}, {"why", "w"}};
  BOOST_TEST(bench.verdict() == "pass");
  bench.set(2, 30.1);
  BOOST_TEST(bench.verdict() == "fail");
  bench.set(2, 30);
  bench.set(0, 4.9);
  BOOST_TEST(bench.verdict() == "fail");
  bench.set(2, not_a_number);
  BOOST_TEST(bench.verdict() == "error");
}

BOOST_AUTO_TEST_CASE(value_outside_the_recorded_agreement_fails) {
  Bench bench = validation_bench("agrees", {-0.01, 0.01});
  BOOST_TEST(bench.verdict() == "pass");
  for (const double value : {9.8, 10.2}) {
    bench.set(0, value);
    BOOST_TEST(bench.verdict() == "fail");
    BOOST_TEST(contains(bench.message, "no longer agrees within the recorded range"));
  }
}

BOOST_AUTO_TEST_CASE(changed_known_discrepancy_fails) {
  Bench bench = validation_bench("known_discrepancy", {0.1, 0.2});
  bench.quantities["frequency_Hz"].values = {11.5, 23, 34.5};
  BOOST_TEST(bench.verdict() == "pass");
  BOOST_TEST((bench.judge_all()[0].expectation == Expectation::known_discrepancy));
  for (const double value : {10.0, 13.0}) {  // equal to the reference; too different
    bench.set(0, value);
    BOOST_TEST(bench.verdict() == "fail");
    BOOST_TEST(contains(bench.message, "the difference left its recorded range"));
  }
  bench.set(0, not_a_number);
  BOOST_TEST(bench.verdict() == "error");
}

BOOST_AUTO_TEST_CASE(known_discrepancy_may_contain_entries_that_agree) {
  Bench bench = validation_bench("known_discrepancy", {{-0.01, 0.01}, {0.1, 0.2}, {-0.3, -0.2}});
  bench.quantities["frequency_Hz"].values = {10.05, 23, 22};
  const auto all = bench.judge_all();
  for (const CheckResult& one : all) BOOST_TEST((one.verdict == Verdict::pass));
  BOOST_TEST((all[0].expectation == Expectation::agrees));
  BOOST_TEST((all[1].expectation == Expectation::known_discrepancy));
}

BOOST_AUTO_TEST_CASE(number_of_windows_must_equal_the_entries) {
  Bench bench = validation_bench("agrees", Json::array({-1, 1}));
  bench.check["expect"]["relative_between"] = {{-1, 1}, {-1, 1}, {-1, 1}};
  BOOST_TEST(bench.verdict() == "pass");
  bench.check["expect"]["relative_between"].push_back({-1, 1});
  BOOST_TEST(bench.verdict() == "error");
}

BOOST_AUTO_TEST_CASE(validation_without_expectation_is_recorded) {
  Bench bench = validation_bench("agrees", {-1, 1});
  bench.check.erase("expect");
  bench.set(0, 25);
  const auto all = bench.judge_all();
  BOOST_TEST((all[0].verdict == Verdict::recorded));
  BOOST_TEST(all[0].difference.value() == 1.5);
  BOOST_TEST(!counts_as_failure(all[0].verdict));
  bench.set(0, not_a_number);
  BOOST_TEST((bench.judge_all()[0].verdict == Verdict::error));
}

BOOST_AUTO_TEST_CASE(variants_are_judged_against_each_other) {
  Bench bench;
  bench.check = {{"quantity", "frequency_Hz"},
                 {"against_variant", "other"},
                 {"role", "validation"},
                 {"expect", {{"agrees", "twice as stiff"}, {"ratio_between", {1.9, 2.1}}}}};
  BOOST_TEST(bench.verdict() == "pass");
  bench.other["frequency_Hz"].values[1] = 12;
  BOOST_TEST(bench.verdict() == "fail");
  bench.has_other = false;
  BOOST_TEST(bench.verdict() == "error");
  BOOST_TEST(contains(bench.message, "no solution in variant 'other'"));
}

BOOST_AUTO_TEST_CASE(quantities_of_one_run_are_judged_against_each_other) {
  Bench bench;
  bench.quantities["other_Hz"].values = {11, 21, 31};
  bench.quantities["other_m"].values = {11, 21, 31};
  bench.check = {{"quantity", "frequency_Hz"},
                 {"against_quantity", "other_Hz"},
                 {"statistic", "max"},
                 {"role", "verification"},
                 {"tolerance", {{"absolute", 1}, {"why", "w"}}}};
  const auto all = bench.judge_all();
  BOOST_REQUIRE(all.size() == 1);
  BOOST_TEST((all[0].verdict == Verdict::pass));
  BOOST_TEST(all[0].difference.value() == -1);
  bench.check["against_quantity"] = "other_m";
  BOOST_TEST(bench.verdict() == "error");
  // A check may name its own variant, and compare two quantities of this variant.
  bench.check["against_quantity"] = "other_Hz";
  bench.check["against_variant"] = "base";
  bench.other = bench.quantities;
  BOOST_TEST(bench.judge_all().size() == 1U);
}

BOOST_AUTO_TEST_CASE(worst_entry_of_a_long_array_is_reported) {
  Bench bench;
  bench.check = {{"quantity", "frequency_Hz"},
                 {"role", "verification"},
                 {"bound", {{"at_most", 1}, {"why", "w"}}}};
  auto& values = bench.quantities["frequency_Hz"].values;
  values.assign(631, 0.5);
  values[100] = 0.9;
  auto all = bench.judge_all();
  BOOST_REQUIRE(all.size() == 1);
  BOOST_TEST((all[0].verdict == Verdict::pass));
  BOOST_TEST(all[0].index.value() == 100U);
  values[300] = 2;
  BOOST_TEST(bench.verdict() == "fail");
  values[500] = not_a_number;
  all = bench.judge_all();
  BOOST_TEST((all[0].verdict == Verdict::error));
  BOOST_TEST(all[0].index.value() == 500U);
  bench.check["bound"] = {{"at_least", 1}, {"why", "w"}};
  values.assign(631, 2);
  values[7] = 1.1;
  BOOST_TEST(bench.judge_all()[0].index.value() == 7U);
  bench.check["bound"]["at_most"] = 2.9;
  BOOST_TEST(bench.judge_all()[0].index.value() == 7U);
}

BOOST_AUTO_TEST_CASE(statistics_have_the_named_value) {
  const std::vector<double> values = {3, -4, 1};
  BOOST_TEST(statistic_of("max", values) == 3);
  BOOST_TEST(statistic_of("min", values) == -4);
  BOOST_TEST(statistic_of("max_abs", values) == 4);
  BOOST_TEST(statistic_of("mean", values) == 0);
  BOOST_TEST(statistic_of("sum", values) == 0);
  BOOST_TEST(statistic_of("first", values) == 3);
  BOOST_TEST(statistic_of("last", values) == 1);
  BOOST_TEST(statistic_of("range", values) == 7);
  BOOST_TEST(statistic_of("rms", values) == std::sqrt(26.0 / 3));
  BOOST_TEST(std::isnan(statistic_of("max", {1, not_a_number})));
  BOOST_TEST(std::isnan(statistic_of("max", {})));
}

BOOST_AUTO_TEST_CASE(contradictory_checks_are_refused) {
  const auto fault = [](const char* key, const Json& value, const char* gone = "") {
    Bench bench;
    bench.check.erase(gone);
    bench.check[key] = value;
    return input_error_message([&] { (void)bench.judge_all(); });
  };
  BOOST_TEST(contains(fault("bound", {{"at_most", 1}, {"why", "w"}}), "of the keys 'tolerance'"));
  BOOST_TEST(contains(fault("role", "validation"), "/checks/c/tolerance: a check of role"));
  BOOST_TEST(contains(fault("role", "verification", "tolerance"), "of the keys 'tolerance'"));
  BOOST_TEST(contains(fault("role", "verification", "reference"), "requires 'reference'"));
  BOOST_TEST(
      contains(fault("tolerance", {{"why", "w"}}), "exactly one of 'absolute' or 'relative'"));
  BOOST_TEST(contains(fault("reference", "truht"), "/checks/c/reference: expected the name of a "));
  BOOST_TEST(contains(fault("against_variant", "other"), "'reference' excludes 'against_variant'"));
  BOOST_TEST(contains(fault("variants", {"othr"}), "did you mean 'other'?"));
  BOOST_TEST(contains(fault("tolerance", {{"relative", 1e-3}}), "expected the key 'why'"));
}

BOOST_AUTO_TEST_CASE(negative_control_passes_if_the_fault_is_found) {
  Bench bench;
  const auto control = [&](const char* verdict, const char* message, int index) {
    bench.check["negative_control"] = {
        {"verdict", verdict}, {"message", message}, {"index", index}, {"why", "w"}};
    return bench.verdict();
  };
  bench.set(1, 20.1);
  BOOST_TEST(control("fail", "is outside of", 1) == "pass");
  BOOST_TEST(control("fail", "is outside of", 0) == "fail");
  BOOST_TEST(control("error", "is outside of", 1) == "fail");
  BOOST_TEST(control("fail", "another reason", 1) == "fail");
  bench.set(1, 20);
  BOOST_TEST(control("fail", "is outside of", 1) == "fail");
  BOOST_TEST(
      contains(bench.message, "expected 'fail' of entry 1 with 'is outside of' (got 'pass'"));
}

BOOST_AUTO_TEST_CASE(solver_printing_four_digits_is_judged_to_four_digits) {
  Bench bench;
  bench.check["tolerance"]["relative"] = 1e-6;
  bench.set(1, 20.004);
  BOOST_TEST(bench.verdict() == "fail");
  const results::SolverIdentity prints_four{"code", "1", {}, 4};
  bench.other_solver = &prints_four;
  BOOST_TEST(bench.verdict() == "pass");
  bench.set(1, 20.006);  // half a unit of the last digit of 20.01 is 0.005
  BOOST_TEST(bench.verdict() == "fail");
}

BOOST_AUTO_TEST_CASE(missing_answer_of_a_code_is_not_given) {
  const results::SolverIdentity code{"code", "1", {}, {}};
  Bench missing;
  missing.other_solver = &code;
  missing.quantities.clear();
  BOOST_TEST(missing.verdict() == "not-given");
  Bench misfit;
  misfit.other_solver = &code;
  misfit.quantities["frequency_Hz"].values.resize(2);
  BOOST_TEST(misfit.verdict() == "error");
}

BOOST_AUTO_TEST_SUITE_END()
