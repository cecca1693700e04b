#include "harness/scene/drawing.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(drawing)

using namespace trammel::harness;

namespace {

std::vector<Eigen::VectorXd> wave(double periods) {
  std::vector<Eigen::VectorXd> q;
  for (int i = 0; i <= 960; ++i)
    q.emplace_back(Eigen::VectorXd::Constant(1, std::sin(2 * M_PI * periods * i / 960)));
  return q;
}

}  // namespace

BOOST_AUTO_TEST_CASE(moments_are_of_all_of_a_slow_motion_and_of_the_beginning_of_a_fast_one) {
  const std::vector<std::size_t> slow = drawn_samples(wave(1), 20);
  BOOST_TEST(slow.size() == 48);
  BOOST_TEST(slow.front() == 0);
  BOOST_TEST(slow.back() == 960);
  const std::vector<std::size_t> fast = drawn_samples(wave(48), 20);
  BOOST_TEST(fast.size() == 48);
  BOOST_TEST(fast.back() > 60);  // three periods
  BOOST_TEST(fast.back() < 250);
  BOOST_TEST(drawn_samples(wave(1), 1000).size() == 6);
  BOOST_TEST(drawn_samples({Eigen::VectorXd::Zero(1)}, 20).empty());
}

BOOST_AUTO_TEST_SUITE_END()
