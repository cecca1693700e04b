#include <boost/test/unit_test.hpp>

#include "solver/elements/triangle_element.h"
#include "solver/model/quadrature.h"

BOOST_AUTO_TEST_SUITE(triangle_interpolation)

namespace t = trammel::solver;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const std::vector<Vector3d> kNodes = {{1, 0, 0},   {0, 1, 0},   {0, 0, 1},
                                      {.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}};

/// Straight sides, or side 12 bent outwards.
t::Model one_triangle(bool six_nodes, double bend = 0) {
  t::Model model;
  for (const Vector2d& p : {Vector2d(0.1, 0.2), Vector2d(1.3, 0.1), Vector2d(0.4, 0.9)}) {
    model.nodes.push_back({"", p});
  }
  t::Triangle triangle;
  triangle.nodes = {0, 1, 2, -1, -1, -1};
  if (six_nodes) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.nodes[3 + k] = static_cast<t::Index>(model.nodes.size());
      const Vector2d sum = model.nodes[k].position + model.nodes[(k + 1) % 3].position;
      model.nodes.push_back({"", sum / 2 + (k == 1 ? bend : 0.0) * Vector2d(1, 1)});
    }
  }
  model.triangles.push_back(triangle);
  return model;
}

t::TriangleInterpolation at(const t::Model& model, const Vector3d& L) {
  return t::interpolate(model, model.triangles[0], L);
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_shape_function_is_one_at_its_node_and_zero_at_the_others) {
  for (const bool six : {false, true}) {
    const t::Model model = one_triangle(six, 0.05);
    for (std::size_t i = 0; i < (six ? 6U : 3U); ++i) {
      const auto here = at(model, kNodes[i]);
      BOOST_TEST((here.position - model.nodes[i].position).norm() < 1e-15);
      for (std::size_t j = 0; j < 6; ++j) {
        BOOST_TEST(here.N[static_cast<t::Index>(j)] == (i == j ? 1.0 : 0.0));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(gradients_of_the_coordinates_are_the_unit_vectors) {
  for (const double bend : {0.0, 0.05}) {
    for (const bool six : {false, true}) {
      const t::Model model = one_triangle(six, bend);
      const auto here = at(model, {0.2, 0.5, 0.3});
      Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
      Vector2d sum = Vector2d::Zero();
      for (t::Index i = 0; i < here.nodes; ++i) {
        const auto node = static_cast<std::size_t>(i);
        gradient += model.nodes[node].position * here.gradient.col(i).transpose();
        sum += here.gradient.col(i);
      }
      BOOST_TEST((gradient - Eigen::Matrix2d::Identity()).norm() < 1e-14);
      BOOST_TEST(sum.norm() < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(six_straight_nodes_hold_any_quadratic) {
  const t::Model model = one_triangle(true);
  const auto f = [](const Vector2d& p) {
    return 1 + 2 * p.x() - p.y() + 3 * p.x() * p.x() - 4 * p.x() * p.y() + 5 * p.y() * p.y();
  };
  const auto here = at(model, {0.2, 0.5, 0.3});
  double value = 0;
  Vector2d gradient = Vector2d::Zero();
  for (t::Index i = 0; i < 6; ++i) {
    const double nodal = f(model.nodes[static_cast<std::size_t>(i)].position);
    value += here.N[i] * nodal;
    gradient += nodal * here.gradient.col(i);
  }
  const Vector2d p = here.position;
  BOOST_TEST(value == f(p), boost::test_tools::tolerance(1e-14));
  BOOST_TEST(gradient.x() == 2 + 6 * p.x() - 4 * p.y(), boost::test_tools::tolerance(1e-13));
  BOOST_TEST(gradient.y() == -1 - 4 * p.x() + 10 * p.y(), boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_SUITE_END()
