#include <boost/test/unit_test.hpp>
#include <numbers>

#include "solver/large/large_elastodynamics.h"

BOOST_AUTO_TEST_SUITE(joint_law)

using namespace trammel::solver;

BOOST_AUTO_TEST_CASE(joint_angle_continues_beyond_half_a_turn) {
  constexpr double kRate = 3;
  const large_motion::RigidMotion crank = large_motion::cached_motion([](double t) {
    InverseDynamics motion;
    motion.q.setZero();
    motion.q_dot.setZero();
    motion.q_ddot.setZero();
    motion.q[4] = std::remainder(0.2 + kRate * t, 2 * std::numbers::pi);
    motion.q_dot[4] = kRate;
    return motion;
  });
  const auto law = large_motion::joint_rotation_law(crank, Circle{}, 1, 4);
  for (const double t : {1.0, 1.5, 2.3, 9.0, 3.0, -4.0})
    BOOST_TEST(law(t)[0] == kRate * (t - 1), boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_SUITE_END()
