#include "harness/studies/mode_match.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/analysis/analysis.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(mode_match)

using namespace trammel;
using namespace trammel::testing;

namespace {

SampledModes modes(std::vector<double> frequency, const Eigen::MatrixXd& shape) {
  return {std::move(frequency), shape};
}

}  // namespace

BOOST_AUTO_TEST_CASE(modes_are_matched_by_shape_and_not_by_number) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(5, 3);
  Eigen::MatrixXd swapped(5, 3);
  swapped << I.col(1), -2 * I.col(0), I.col(2);
  const auto matches = match_modes(modes({1, 2, 3}, I), modes({1.5, 1.6, 3}, swapped));
  BOOST_REQUIRE(matches.size() == 3);
  BOOST_TEST(matches[0].b.at(0) == 1U);
  BOOST_TEST(matches[1].b.at(0) == 0U);
  BOOST_TEST(matches[2].b.at(0) == 2U);
  for (const ModeMatch& match : matches)
    BOOST_TEST(match.overlap == 1, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(repeated_modes_are_matched_as_a_set) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(5, 3);
  Eigen::MatrixXd turned = I;
  turned.col(0) = std::cos(0.7) * I.col(0) + std::sin(0.7) * I.col(1);
  turned.col(1) = -std::sin(0.7) * I.col(0) + std::cos(0.7) * I.col(1);
  const auto matches = match_modes(modes({1, 1, 3}, I), modes({2, 2 * (1 + 1e-9), 3}, turned));
  BOOST_REQUIRE(matches.size() == 2);
  BOOST_TEST(matches[0].a.size() == 2);
  BOOST_TEST(matches[0].b.size() == 2);
  BOOST_TEST(matches[0].overlap == 1, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(modes_of_a_split_pair_match_the_repeated_pair) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(5, 3);
  const SampledModes pair = modes({1, 1, 3}, I), parted = modes({1, 1.1, 3}, I);
  const auto apart = match_modes(parted, pair);
  BOOST_REQUIRE(apart.size() == 3);
  for (std::size_t i = 0; i < 2; ++i) {
    BOOST_TEST(apart[i].b.size() == 2U);
    BOOST_TEST(apart[i].overlap == 1, boost::test_tools::tolerance(1e-12));
  }
  const auto together = match_modes(pair, parted);
  BOOST_REQUIRE(together.size() == 2);
  BOOST_TEST((together[0].b == std::vector<std::size_t>{0, 1}));
}

BOOST_AUTO_TEST_CASE(orthogonal_modes_have_no_match) {
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(5, 5);
  const auto matches = match_modes(modes({1, 2}, I.leftCols(2)), modes({1, 2}, I.rightCols(2)));
  for (const ModeMatch& match : matches) BOOST_TEST(match.b.empty());
}

BOOST_AUTO_TEST_CASE(two_meshes_of_one_beam_have_the_same_modes) {
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 3}}}};
  const AnalysisResult coarse = analyze(testing::document_of(json), {}, {true});
  json["model"]["elements"] = 16;
  const AnalysisResult fine = analyze(testing::document_of(json), {}, {true});
  const auto [a, b] = sample_modes(coarse.quantities.at("frequency_Hz").values, *coarse.drawing,
                                   fine.quantities.at("frequency_Hz").values, *fine.drawing);
  const auto matches = match_modes(a, b);
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST(matches.at(i).b.at(0) == i);
    BOOST_TEST(matches[i].overlap > 0.999);
  }
}

BOOST_AUTO_TEST_SUITE_END()
