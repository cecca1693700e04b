#include "solver/elements/triangle_element.h"

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(triangle_element)

using namespace trammel::solver;
using boost::test_tools::tolerance;
using Eigen::Matrix2d;

namespace {

const Plate kPlate = {"plate", {6.9e10, 2700, 0.33}, 0.0015};
const Vector2d kBulge(0.08, 0.05);  // displacement of the middle of side 12
const Matrix2d kTurn{{0, -1}, {1, 0}};

/// Triangle of n nodes. The side between the nodes 1 and 2 (counted from 0) is straight or a
/// parabola.
template <std::size_t n>
struct Element {
  TriangleNodes<n> nodes;

  explicit Element(bool curved = false) {
    const TrianglePoints corners = {Vector2d(0.1, 0), Vector2d(1.2, 0.3), Vector2d(0.4, 1)};
    for (std::size_t i = 0; i < n; ++i)
      nodes[i] = i < 3 ? corners[i] : (corners[i - 3] + corners[(i - 2) % 3]) / 2;
    if (curved) nodes[4] += kBulge;
  }

  /// Returns the nodal values of a displacement field.
  template <class Field>
  Eigen::Matrix<double, 2 * n, 1> sample(const Field& field) const {
    Eigen::Matrix<double, 2 * n, 1> u;
    for (std::size_t i = 0; i < n; ++i)
      u.template segment<2>(2 * static_cast<Index>(i)) = field(nodes[i]);
    return u;
  }
  [[nodiscard]] TriangleMatrix<n> stiffness() const {
    const TriangleStiffness<n> k = triangle_stiffness(nodes, kPlate);
    return k.B.transpose() * k.c.asDiagonal() * k.B;
  }
  [[nodiscard]] TriangleMatrix<n> mass() const { return triangle_mass(nodes, kPlate); }
  [[nodiscard]] double corner_area() const { return signed_area({nodes[0], nodes[1], nodes[2]}); }
};

template <std::size_t n>
void check_null_space_and_mass(bool curved) {
  const Element<n> element(curved);
  const TriangleMatrix<n> k = element.stiffness(), M = element.mass();
  BOOST_TEST((k - k.transpose()).norm() < 1e-15 * k.norm());
  const auto along = element.sample([](const Vector2d&) { return Vector2d(1, 0); });
  const auto across = element.sample([](const Vector2d&) { return Vector2d(0, 1); });
  const auto turn = element.sample([](const Vector2d& p) { return Vector2d(kTurn * p); });
  for (const auto& u : {along, across, turn}) BOOST_TEST((k * u).norm() < 1e-13 * k.norm());
  const Eigen::SelfAdjointEigenSolver<TriangleMatrix<n>> eigen(k);
  BOOST_TEST(eigen.eigenvalues()[3] > 1e-3 * eigen.eigenvalues()[2 * n - 1]);
  // The parabolic side increases the area of the triangle by two thirds of the product of its chord
  // and its height.
  const Vector2d chord = element.nodes[2] - element.nodes[1];
  const double bulge = 2 / 3.0 * std::abs(chord.x() * kBulge.y() - chord.y() * kBulge.x());
  const double area = element.corner_area() + (curved ? bulge : 0);
  const double mass = kPlate.material.rho * kPlate.thickness * area;
  BOOST_TEST(along.dot(M * along) == mass, tolerance(1e-13));
  BOOST_TEST(across.dot(M * across) == mass, tolerance(1e-13));
  BOOST_TEST(std::abs(along.dot(M * across)) < 1e-14 * mass);
  BOOST_TEST(Eigen::SelfAdjointEigenSolver<TriangleMatrix<n>>(M).eigenvalues()[0] > 0);
  if (curved) return;
  const Vector2d centroid = (element.nodes[0] + element.nodes[1] + element.nodes[2]) / 3;
  const auto spin =
      element.sample([&](const Vector2d& p) { return Vector2d(kTurn * (p - centroid)); });
  double sides = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sides += (element.nodes[i] - element.nodes[(i + 1) % 3]).squaredNorm();
  BOOST_TEST(spin.dot(M * spin) == mass * sides / 36, tolerance(1e-13));
}

/// Checks values and gradients of the shape functions at nodes and at an interior point.
template <std::size_t n>
void check_interpolation(bool curved) {
  const Element<n> element(curved);
  for (std::size_t i = 0; i < n; ++i) {
    const TriangleInterpolation here =
        evaluate_shape_functions(element.nodes, triangle_node_area_coordinates()[i]);
    BOOST_TEST((here.position - element.nodes[i]).norm() < 1e-15);
    BOOST_TEST(here.N == (Eigen::Matrix<double, 6, 1>::Unit(static_cast<Index>(i))));
  }
  const TriangleInterpolation here = evaluate_shape_functions(element.nodes, {0.2, 0.5, 0.3});
  Matrix2d gradient = Matrix2d::Zero();
  for (std::size_t i = 0; i < n; ++i)
    gradient += element.nodes[i] * here.gradient.col(static_cast<Index>(i)).transpose();
  BOOST_TEST((gradient - Matrix2d::Identity()).norm() < 1e-14);
  BOOST_TEST(here.gradient.leftCols<n>().rowwise().sum().norm() < 1e-14);
}

}  // namespace

BOOST_AUTO_TEST_CASE(rigid_motions_are_the_null_space_and_carry_the_mass) {
  check_null_space_and_mass<3>(false);
  check_null_space_and_mass<6>(false);
  check_null_space_and_mass<6>(true);
}

BOOST_AUTO_TEST_CASE(shape_functions_reproduce_the_coordinates) {
  check_interpolation<3>(false);
  check_interpolation<6>(false);
  check_interpolation<6>(true);
}

BOOST_AUTO_TEST_CASE(uniform_strain_has_its_stress_and_energy) {
  const Element<3> element;
  const Matrix2d F{{1e-3, 2e-3}, {-5e-4, -7e-4}};
  const Vector6d u =
      element.sample([&](const Vector2d& p) { return Vector2d(Vector2d(0.1, 0.2) + F * p); });
  const Vector3d d = triangle_deformation_matrix(element.nodes) * u;
  const double exx = F(0, 0), eyy = F(1, 1), gxy = F(0, 1) + F(1, 0);
  BOOST_TEST(d[0] == exx + eyy, tolerance(1e-12));
  BOOST_TEST(d[1] == exx - eyy, tolerance(1e-12));
  BOOST_TEST(d[2] == gxy, tolerance(1e-12));
  const Material& m = kPlate.material;
  const double c = m.E / (1 - m.nu * m.nu);
  const Vector3d stress = membrane_stress(m, d);
  BOOST_TEST(stress[0] == c * (exx + m.nu * eyy), tolerance(1e-12));
  BOOST_TEST(stress[1] == c * (eyy + m.nu * exx), tolerance(1e-12));
  BOOST_TEST(stress[2] == m.E / (2 * (1 + m.nu)) * gxy, tolerance(1e-12));
  const double volume = kPlate.thickness * element.corner_area();
  BOOST_TEST(u.dot(element.stiffness() * u) ==
                 volume * (stress[0] * exx + stress[1] * eyy + stress[2] * gxy),
             tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(quadratic_displacement_has_its_exact_energy) {
  // The displacement (x^2, 0) has the strain exx = 2 x. Twice its strain energy is t E / (1 - nu^2)
  // integral 4 x^2, with the thickness t.
  const Element<6> element;
  const auto u = element.sample([](const Vector2d& p) { return Vector2d(p.x() * p.x(), 0); });
  double mean = 0;  // mean of x^2 over the triangle, from the middles of the sides
  for (std::size_t i = 3; i < 6; ++i) mean += element.nodes[i].x() * element.nodes[i].x() / 3;
  const Material& m = kPlate.material;
  BOOST_TEST(u.dot(element.stiffness() * u) ==
                 kPlate.thickness * m.E / (1 - m.nu * m.nu) * 4 * mean * element.corner_area(),
             tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(order_of_the_triangle_corners_does_not_matter) {
  const Element<3> element;
  Element<3> clockwise;
  std::swap(clockwise.nodes[1], clockwise.nodes[2]);
  Eigen::PermutationMatrix<6> swap;
  swap.indices() << 0, 1, 4, 5, 2, 3;
  const Matrix6d k = swap * clockwise.stiffness() * swap.transpose();
  BOOST_TEST((k - element.stiffness()).norm() < 1e-14 * k.norm());
  BOOST_TEST(clockwise.corner_area() == -element.corner_area());
}

BOOST_AUTO_TEST_SUITE_END()
