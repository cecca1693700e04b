#include <boost/test/unit_test.hpp>

#include "references/beams/programs.h"

BOOST_AUTO_TEST_SUITE(tapered_beam)

using namespace trammel::references;
using boost::test_tools::tolerance;

namespace {

/// w L^2 / sqrt(E I / (rho A)) of the clamped end.
std::vector<double> dimensionless(double depth_ratio, double width_ratio) {
  const double pi = 3.14159265358979323846;
  std::vector<double> values = tapered_beam_program({{"length_m", 1},
                                                     {"E_Pa", 12},
                                                     {"rho_kg_m3", 1},
                                                     {"thickness_m", {1.0, depth_ratio}},
                                                     {"width_m", {1.0, width_ratio}},
                                                     {"count", 3}});
  for (double& value : values) value *= 2 * pi;
  return values;
}

}  // namespace

BOOST_AUTO_TEST_CASE(without_taper_it_is_the_uniform_cantilever) {
  const std::vector<double> w = dimensionless(1, 1);
  BOOST_TEST(w[0] == 3.5160152685, tolerance(1e-10));
  BOOST_TEST(w[1] == 22.0344915647, tolerance(1e-10));
  BOOST_TEST(w[2] == 61.6972144135, tolerance(1e-10));
}

// S. Naguleswaran, J. Sound Vib. 172 (1994), and earlier tables by Downs: four decimals.
BOOST_AUTO_TEST_CASE(truncated_wedges_and_cones_have_the_published_frequencies) {
  const std::vector<double> wedge = dimensionless(0.5, 1), cone = dimensionless(0.5, 0.5);
  const std::vector<double> wedge_table = {3.8238, 18.3173, 47.2648};
  const std::vector<double> cone_table = {4.6252, 19.5476, 48.5789};
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST(wedge[i] == wedge_table[i], tolerance(2e-5));
    BOOST_TEST(cone[i] == cone_table[i], tolerance(2e-5));
  }
}

BOOST_AUTO_TEST_SUITE_END()
