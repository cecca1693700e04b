#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>

#include "solver/elements/triangle_element.h"
#include "solver/linear/statics.h"

BOOST_AUTO_TEST_SUITE(triangle6_element)

using namespace trammel::solver;
using boost::test_tools::tolerance;

namespace {

using Vector12d = Eigen::Matrix<double, 12, 1>;

Model one(bool curved) {
  Model model;
  model.nodes = {{"", {0.1, 0}}, {"", {1.2, 0.3}}, {"", {0.4, 1}}};
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}, {2, 0}}) {
    model.nodes.push_back({"", (model.nodes[a].position + model.nodes[b].position) / 2});
  }
  if (curved) model.nodes[4].position += Vector2d(0.08, 0.05);
  model.plates = {{"p", {7e10, 2700, 0.33}, 0.002}};
  model.triangles = {{0, {0, 1, 2, 3, 4, 5}}};
  return model;
}

template <class Field>
Vector12d sample(const Model& model, Field field) {
  Vector12d u;
  for (std::size_t i = 0; i < 6; ++i) {
    u.segment<2>(static_cast<Index>(2 * i)) = field(model.nodes[i].position);
  }
  return u;
}

using Matrix12d = TriangleMatrix<6>;

Matrix12d stiffness(const Model& model) {
  const auto k = triangle_stiffness(triangle_nodes<6>(model, model.triangles[0]), model.plates[0]);
  return k.B.transpose() * k.c.asDiagonal() * k.B;
}

}  // namespace

BOOST_AUTO_TEST_CASE(rigid_motions_store_no_energy_and_are_the_only_ones) {
  for (const bool curved : {false, true}) {
    const Model model = one(curved);
    const Matrix12d k = stiffness(model);
    for (const Vector12d& u :
         {sample(model, [](const Vector2d&) { return Vector2d(1, 0); }),
          sample(model, [](const Vector2d&) { return Vector2d(0, 1); }),
          sample(model, [](const Vector2d& p) { return Vector2d(-p.y(), p.x()); })}) {
      BOOST_TEST((k * u).norm() < 1e-13 * k.norm());
    }
    const Eigen::SelfAdjointEigenSolver<Matrix12d> eigen(k);
    BOOST_TEST(eigen.eigenvalues()[3] > 1e-3 * eigen.eigenvalues()[11]);
  }
}

BOOST_AUTO_TEST_CASE(a_quadratic_displacement_stores_its_exact_energy) {
  // u = (x^2, 0): exx = 2 x, energy = t E / (1 - nu^2) integral 4 x^2.
  const Model model = one(false);
  const Vector12d u = sample(model, [](const Vector2d& p) { return Vector2d(p.x() * p.x(), 0); });
  const auto& n = model.nodes;
  double second = 0;  // integral of x^2 over the area: mean of the squares at the side middles
  for (std::size_t i = 3; i < 6; ++i) second += n[i].position.x() * n[i].position.x() / 3;
  const Vector2d a = n[1].position - n[0].position;
  const Vector2d b = n[2].position - n[0].position;
  const double area = (a.x() * b.y() - a.y() * b.x()) / 2;
  const Plate& plate = model.plates[0];
  const double c = plate.material.E / (1 - plate.material.nu * plate.material.nu);
  BOOST_TEST(u.dot(stiffness(model) * u) == plate.thickness * c * 4 * second * area,
             tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_mass_is_the_plates_also_with_a_curved_side) {
  for (const bool curved : {false, true}) {
    const Model model = one(curved);
    const Matrix12d M =
        triangle_mass(triangle_nodes<6>(model, model.triangles[0]), model.plates[0]);
    const Vector12d x = sample(model, [](const Vector2d&) { return Vector2d(1, 0); });
    // A parabola adds two thirds of its chord times its height.
    const Vector2d chord = model.nodes[2].position - model.nodes[1].position;
    const Vector2d bulge(0.08, 0.05);
    const double extra =
        curved ? 2 / 3.0 * std::abs(chord.x() * bulge.y() - chord.y() * bulge.x()) : 0;
    const Vector2d a = model.nodes[1].position - model.nodes[0].position;
    const Vector2d b = model.nodes[2].position - model.nodes[0].position;
    const double area = (a.x() * b.y() - a.y() * b.x()) / 2 + extra;
    BOOST_TEST(x.dot(M * x) == 2700 * 0.002 * area, tolerance(1e-13));
    const Eigen::SelfAdjointEigenSolver<Matrix12d> eigen(M);
    BOOST_TEST(eigen.eigenvalues()[0] > 0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
