#include "harness/judge/input_uncertainty.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>

BOOST_AUTO_TEST_SUITE(input_uncertainty)

using namespace trammel;
using namespace trammel::harness;

namespace {

using Values = std::vector<double>;

/// Returns the outputs 3 d0 - 4 d1 and (1 + d0)^2 of a model. The inputs d0 and d1 deviate from 0
/// by at most their half widths, 0.1 and 0.2.
std::optional<Values> linear_and_square_outputs(const Values& d) {
  return Values{3 * d[0] - 4 * d[1], (1 + d[0]) * (1 + d[0])};
}

const Values kHalfWidths = {0.1, 0.2};

}  // namespace

BOOST_AUTO_TEST_CASE(linear_model_has_exact_input_uncertainties) {
  const auto u = uncertainty_by_derivatives(linear_and_square_outputs, kHalfWidths);
  BOOST_REQUIRE(u.has_value());
  BOOST_TEST(u->at(0)[0] == 0.3 / std::sqrt(3.0), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(u->at(1)[0] == -0.8 / std::sqrt(3.0), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(u->at(0)[1] == 0.2 / std::sqrt(3.0), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(u->at(1)[1] == 0);
}

BOOST_AUTO_TEST_CASE(sampling_gives_the_deviation_of_a_uniform_input) {
  const auto u = uncertainty_by_sampling(linear_and_square_outputs, kHalfWidths, 400, 1);
  BOOST_TEST(u.samples == 400);
  BOOST_TEST(u.failed == 0);
  BOOST_TEST(u.standard[0] == std::hypot(0.3, 0.8) / std::sqrt(3.0),
             boost::test_tools::tolerance(0.05));  // random correlation of columns, 1/sqrt(400)
  // The variance of (1 + d)^2 with uniform d in [-h, h] is 4 h^2 / 3 + 4 h^4 / 45, here with h =
  // 0.1.
  BOOST_TEST(u.standard[1] == std::sqrt(0.04 / 3 + 4e-4 / 45), boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(each_stratum_of_each_input_is_sampled_once) {
  std::vector<std::set<int>> visited(2);
  const auto record = [&](const Values& d) -> std::optional<Values> {
    for (std::size_t k = 0; k < 2; ++k)
      visited[k].insert(static_cast<int>(std::floor((d[k] / kHalfWidths[k] + 1) * 25)));
    return Values{0.0};
  };
  (void)uncertainty_by_sampling(record, kHalfWidths, 50, 7);
  BOOST_TEST(visited[0].size() == 50U);
  BOOST_TEST(visited[1].size() == 50U);
  BOOST_TEST(*visited[1].begin() == 0);
  BOOST_TEST(*visited[1].rbegin() == 49);
}

BOOST_AUTO_TEST_CASE(deviation_of_samples_is_unbiased) {
  Values seen;
  const auto record = [&](const Values& d) -> std::optional<Values> {
    seen.push_back(d[0]);
    return Values{d[0]};
  };
  const auto u = uncertainty_by_sampling(record, kHalfWidths, 4, 7);
  BOOST_TEST_REQUIRE(seen.size() >= 4U);
  const Values last(seen.end() - 4, seen.end());
  double mean = 0, square = 0;
  for (const double x : last) mean += x / 4;
  for (const double x : last) square += (x - mean) * (x - mean);
  BOOST_TEST(u.standard[0] == std::sqrt(square / 3), boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(samples_depend_on_the_seed) {
  const auto a = uncertainty_by_sampling(linear_and_square_outputs, kHalfWidths, 40, 3);
  const auto b = uncertainty_by_sampling(linear_and_square_outputs, kHalfWidths, 40, 3);
  const auto c = uncertainty_by_sampling(linear_and_square_outputs, kHalfWidths, 40, 4);
  BOOST_TEST(a.standard[0] == b.standard[0]);
  BOOST_TEST(a.standard[0] != c.standard[0]);
}

BOOST_AUTO_TEST_CASE(samples_without_a_solution_are_counted_and_left_out) {
  const auto out_of_reach = [](const Values& d) -> std::optional<Values> {
    if (d[0] > 0.05) return std::nullopt;
    return Values{d[0]};
  };
  const auto u = uncertainty_by_sampling(out_of_reach, kHalfWidths, 400, 5);
  BOOST_TEST(u.failed == 100);
  BOOST_TEST(u.samples == 300);
  BOOST_TEST(u.standard[0] == 0.15 / std::sqrt(12.0), boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(no_derivative_if_the_model_has_no_solution) {
  const auto nothing = [](const Values& d) -> std::optional<Values> {
    if (d[1] < 0) return std::nullopt;
    return Values{1.0};
  };
  BOOST_TEST(!uncertainty_by_derivatives(nothing, kHalfWidths).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
