#include "solver/elements/block_mesh.h"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/elements/triangle_element.h"
#include "solver/linear/system.h"

BOOST_AUTO_TEST_SUITE(block_mesh)

using namespace trammel::solver;
using boost::test_tools::tolerance;

namespace {

constexpr double kPi = std::numbers::pi;

/// Returns the membrane of NAFEMS LE1: a quarter of the area between two ellipses.
Block elliptic_quarter(Index cells) {
  Block block;
  block.corners = {Vector2d(2, 0), Vector2d(3.25, 0), Vector2d(0, 2.75), Vector2d(0, 1)};
  block.sides[1] = Ellipse{{0, 0}, {3.25, 2.75}};
  block.sides[3] = Ellipse{{0, 0}, {2, 1}};
  block.cells = {cells, 2 * cells};
  return block;
}

Block annulus_quarter(double inner, double outer, Index quarter, Index radial, Index around) {
  const auto at = [&](double r, Index k) {
    const double t = static_cast<double>(k % 4) * kPi / 2;
    return Vector2d(r * std::cos(t), r * std::sin(t));
  };
  Block block;
  block.corners = {at(inner, quarter), at(outer, quarter), at(outer, quarter + 1),
                   at(inner, quarter + 1)};
  block.sides[1] = Ellipse{{0, 0}, {outer, outer}};
  block.sides[3] = Ellipse{{0, 0}, {inner, inner}};
  block.cells = {radial, around};
  return block;
}

double area(const Model& model) {
  double sum = 0;
  for (const Triangle& triangle : model.triangles) {
    const double a = 1.0 / 6;  // quadrature of degree 2: exact for the area of six-node triangles
    for (const Vector3d& at :
         {Vector3d(4 * a, a, a), Vector3d(a, 4 * a, a), Vector3d(a, a, 4 * a)}) {
      sum += evaluate_shape_functions(model, triangle, at).signed_area / 3;
    }
  }
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(six_node_triangles_have_the_area_of_the_ellipse) {
  const double exact = kPi / 4 * (3.25 * 2.75 - 2 * 1);
  double last = 0;
  for (const Index cells : {2, 4, 8}) {
    Model model;
    model.plates = {{"p", {1, 1, 0}, 1}};
    append_mesh(model, 0, mesh_blocks({elliptic_quarter(cells)}, true));
    const double error = std::abs(area(model) / exact - 1);
    BOOST_TEST(error < 1e-3);
    if (last > 0) BOOST_TEST(last / error > 14);  // fourth order
    last = error;
  }
}

BOOST_AUTO_TEST_CASE(four_annulus_quarters_share_nodes_of_a_closed_ring) {
  std::vector<Block> blocks;
  for (Index k = 0; k < 4; ++k) blocks.push_back(annulus_quarter(1, 2, k, 2, 3));
  for (const bool six : {false, true}) {
    const BlockMesh mesh = mesh_blocks(blocks, six);
    const std::size_t around = six ? 24 : 12, across = six ? 5 : 3;
    BOOST_TEST(mesh.positions.size() == around * across);
    BOOST_TEST(mesh.triangles.size() == 4u * 2 * 2 * 3);
  }
}

BOOST_AUTO_TEST_CASE(mesh_grading_is_the_ratio_of_last_and_first_cell) {
  Block block;
  block.corners = {Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)};
  block.cells = {5, 1};
  block.grading = {8, 1};
  const BlockMesh mesh = mesh_blocks({block}, false);
  const auto x = [&](std::size_t i) {
    return mesh.positions[static_cast<std::size_t>(mesh.sides[0][0][i])].x();
  };
  BOOST_TEST((x(5) - x(4)) / (x(1) - x(0)) == 8, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(mesh_is_joined_to_existing_nodes) {
  Block block;
  block.corners = {Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(0, 1)};
  block.cells = {2, 2};
  Model model;
  model.plates = {{"p", {1, 1, 0}, 1}};
  model.nodes = {{"elsewhere", {3, 0}}, {"middle", {0.5, 0.5}}, {"corner", {1, 1 + 1e-13}}};
  const std::vector<Index> nodes = append_mesh(model, 0, mesh_blocks({block}, false));
  BOOST_TEST(model.nodes.size() == 3u + 9 - 2);
  BOOST_TEST((std::count(nodes.begin(), nodes.end(), 1) == 1));
  BOOST_TEST((std::count(nodes.begin(), nodes.end(), 2) == 1));
  // A second plate next to the first plate shares the three nodes of the common side.
  for (Vector2d& corner : block.corners) corner.x() += 1;
  append_mesh(model, 0, mesh_blocks({block}, false));
  BOOST_TEST(model.nodes.size() == 10u + 9 - 3);
}

BOOST_AUTO_TEST_CASE(invalid_blocks_are_refused) {
  Block block = elliptic_quarter(2);
  block.corners[1] = {3, 0};
  BOOST_CHECK_THROW((void)mesh_blocks({block}, true), ModelError);
  block = elliptic_quarter(2);
  block.cells = {0, 2};
  BOOST_CHECK_THROW((void)mesh_blocks({block}, true), ModelError);
}

BOOST_AUTO_TEST_CASE(pressure_on_a_curved_side_is_that_on_its_chord) {
  const BlockMesh mesh = mesh_blocks({elliptic_quarter(4)}, true);
  Model model;
  model.plates = {{"membrane", {210e9, 1, 0.3}, 0.1}};
  const std::vector<Index> nodes = append_mesh(model, 0, mesh);
  const std::vector<Index>& side = mesh.sides[0][1];
  const auto node = [&](std::size_t i) { return nodes[static_cast<std::size_t>(side[i])]; };
  for (std::size_t i = 0; i + 2 < side.size(); i += 2) {
    EdgeLoad load;
    load.plate = 0;
    load.nodes = {node(i), node(i + 2), node(i + 1)};
    load.normal = 10e6;
    model.edge_loads.push_back(load);
  }
  const System system = assemble(model);
  Vector2d sum = Vector2d::Zero();
  for (const auto& c : system.coordinates.node)
    sum += Vector2d(system.load[c[0]], system.load[c[1]]);
  BOOST_TEST(sum.x() == 10e6 * 0.1 * 2.75, tolerance(1e-12));  // for any curve with these ends
  BOOST_TEST(sum.y() == 10e6 * 0.1 * 3.25, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(distorted_triangles_cover_the_rectangle) {
  for (const double distortion : {0.0, 0.29})
    for (const bool six : {false, true}) {
      const Model model = mesh_rectangle({0.8, 0.5, 9, six, distortion}, {});
      double sum = 0, smallest = 1, largest = 0;
      for (const Triangle& triangle : model.triangles) {
        const double part =
            evaluate_shape_functions(model, triangle, Vector3d::Constant(1.0 / 3)).signed_area;
        smallest = std::min(smallest, part);
        largest = std::max(largest, part);
        sum += part;
      }
      BOOST_TEST(smallest > 0.02 * 0.8 * 0.5 / 81);
      BOOST_TEST((smallest < 0.5 * largest) == (distortion > 0));
      BOOST_TEST(model.triangles.size() == 162U);
      BOOST_TEST(model.nodes.size() == (six ? 19U * 19U : 100U));
      BOOST_TEST(sum == 0.4, tolerance(1e-13));
    }
}

BOOST_AUTO_TEST_CASE(members_of_a_line_alternate_between_long_and_short) {
  const Model model = mesh_line({Vector2d(1, 1), Vector2d(5, 4), 4, 0.25}, {});
  BOOST_TEST(model.members.size() == 4U);
  const auto length = [&](std::size_t i) {
    return (model.nodes[i + 1].position - model.nodes[i].position).norm();
  };
  BOOST_TEST(length(0) == 5.0 / 4 * 1.25, tolerance(1e-14));
  BOOST_TEST(length(1) == 5.0 / 4 * 0.75, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(distortion_that_folds_an_element_is_refused) {
  BOOST_CHECK_THROW((void)mesh_rectangle({1, 1, 4, false, 0.3}, {}), ModelError);
  BOOST_CHECK_THROW((void)mesh_rectangle({1, 1, 4, false, -0.1}, {}), ModelError);
  BOOST_CHECK_THROW((void)mesh_line({Vector2d(0, 0), Vector2d(1, 0), 4, 1.0}, {}), ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
