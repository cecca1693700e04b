#include <boost/test/unit_test.hpp>

#include "solver/elements/block_mesh.h"
#include "solver/elements/triangle_element.h"

BOOST_AUTO_TEST_SUITE(distorted_mesh)

namespace t = trammel::solver;
using Eigen::Vector2d;

namespace {

double area(const t::Model& model, const t::Triangle& triangle) {
  t::TrianglePoints points;
  for (std::size_t k = 0; k < 3; ++k) {
    points[k] = model.nodes[static_cast<std::size_t>(triangle.nodes[k])].position;
  }
  return t::signed_area(points);
}

}  // namespace

BOOST_AUTO_TEST_CASE(triangles_cover_the_rectangle_and_none_is_turned_over) {
  for (const double distortion : {0.0, 0.29}) {
    for (const bool six : {false, true}) {
      const t::Model model = t::mesh_rectangle({0.8, 0.5, 9, six, distortion}, {});
      double sum = 0;
      for (const t::Triangle& triangle : model.triangles) {
        BOOST_TEST(area(model, triangle) > 0.02 * 0.8 * 0.5 / 81);
        sum += area(model, triangle);
      }
      BOOST_TEST(model.triangles.size() == 162U);
      BOOST_TEST(model.nodes.size() == (six ? 19U * 19U : 100U));
      BOOST_TEST(sum == 0.4, boost::test_tools::tolerance(1e-13));
    }
  }
}

BOOST_AUTO_TEST_CASE(refinement_does_not_smooth_the_distortion_out) {
  // Smallest over largest triangle; a smooth map would bring it to 1.
  for (const t::Index cells : {8, 64}) {
    const t::Model model = t::mesh_rectangle({1, 1, cells, false, 0.25}, {});
    double smallest = 1, largest = 0;
    for (const t::Triangle& triangle : model.triangles) {
      smallest = std::min(smallest, area(model, triangle));
      largest = std::max(largest, area(model, triangle));
    }
    BOOST_TEST(smallest < 0.5 * largest);
  }
}

BOOST_AUTO_TEST_CASE(members_of_a_line_alternate_between_long_and_short) {
  const t::Model model = t::mesh_line({Vector2d(1, 1), Vector2d(5, 4), 4, 0.25}, {});
  BOOST_TEST(model.members.size() == 4U);
  BOOST_TEST((model.nodes.back().position - Vector2d(5, 4)).norm() < 1e-15);
  const double first = (model.nodes[1].position - model.nodes[0].position).norm();
  const double second = (model.nodes[2].position - model.nodes[1].position).norm();
  BOOST_TEST(first == 5.0 / 4 * 1.25, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(second == 5.0 / 4 * 0.75, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_distortion_that_could_turn_an_element_over_is_refused) {
  BOOST_CHECK_THROW((void)t::mesh_rectangle({1, 1, 4, false, 0.3}, {}), t::ModelError);
  BOOST_CHECK_THROW((void)t::mesh_rectangle({1, 1, 4, false, -0.1}, {}), t::ModelError);
  BOOST_CHECK_THROW((void)t::mesh_line({Vector2d(0, 0), Vector2d(1, 0), 4, 1.0}, {}),
                    t::ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
