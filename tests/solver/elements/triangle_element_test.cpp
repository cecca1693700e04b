#include "solver/elements/triangle_element.h"

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(triangle_element)

using namespace trammel::solver;

namespace {

const TrianglePoints kPoints = {Vector2d(0.2, -0.1), Vector2d(1.4, 0.3), Vector2d(0.5, 1.1)};
const Plate kPlate = {"plate", {6.9e10, 2700, 0.33}, 0.0015};

Vector6d sample(const TrianglePoints& points, const Vector2d& shift, const Eigen::Matrix2d& F) {
  Vector6d u;
  for (std::size_t i = 0; i < 3; ++i) {
    u.segment<2>(static_cast<Index>(2 * i)) = shift + F * points[i];
  }
  return u;
}

Matrix6d stiffness(const TrianglePoints& points, const Plate& plate) {
  const TriangleStiffness<3> k = triangle_stiffness(points, plate);
  return k.B.transpose() * k.c.asDiagonal() * k.B;
}

}  // namespace

BOOST_AUTO_TEST_CASE(rigid_motions_store_no_energy_and_are_the_only_ones) {
  const Matrix6d k = stiffness(kPoints, kPlate);
  Eigen::Matrix2d turn;
  turn << 0, -1, 1, 0;
  for (const Vector6d& u :
       {sample(kPoints, {1, 0}, Eigen::Matrix2d::Zero()),
        sample(kPoints, {0, 1}, Eigen::Matrix2d::Zero()), sample(kPoints, {0, 0}, turn)}) {
    BOOST_TEST((k * u).norm() < 1e-14 * k.norm());
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(k);
  BOOST_TEST(eigen.eigenvalues()[3] > 1e-3 * eigen.eigenvalues()[5]);
  BOOST_TEST((k - k.transpose()).norm() < 1e-15 * k.norm());
}

BOOST_AUTO_TEST_CASE(a_uniform_strain_is_reproduced_with_its_stress_and_energy) {
  Eigen::Matrix2d F;
  F << 1e-3, 2e-3, -5e-4, -7e-4;
  const Vector6d u = sample(kPoints, {0.1, 0.2}, F);
  const Vector3d d = triangle_deformation(kPoints) * u;
  const double exx = F(0, 0);
  const double eyy = F(1, 1);
  const double gxy = F(0, 1) + F(1, 0);
  BOOST_TEST(d[0] == exx + eyy, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(d[1] == exx - eyy, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(d[2] == gxy, boost::test_tools::tolerance(1e-12));
  const Material& m = kPlate.material;
  const double c = m.E / (1 - m.nu * m.nu);
  const Vector3d stress = membrane_stress(m, d);
  BOOST_TEST(stress[0] == c * (exx + m.nu * eyy), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(stress[1] == c * (eyy + m.nu * exx), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(stress[2] == m.E / (2 * (1 + m.nu)) * gxy, boost::test_tools::tolerance(1e-12));
  const double energy = u.dot(stiffness(kPoints, kPlate) * u);
  const double volume = kPlate.thickness * signed_area(kPoints);
  BOOST_TEST(energy == volume * (stress[0] * exx + stress[1] * eyy + stress[2] * gxy),
             boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(the_order_of_the_corners_does_not_matter) {
  const TrianglePoints clockwise = {kPoints[0], kPoints[2], kPoints[1]};
  Eigen::PermutationMatrix<6> swap;
  swap.indices() << 0, 1, 4, 5, 2, 3;
  const Matrix6d k = swap * stiffness(clockwise, kPlate) * swap.transpose();
  BOOST_TEST((k - stiffness(kPoints, kPlate)).norm() < 1e-14 * k.norm());
  BOOST_TEST(signed_area(clockwise) == -signed_area(kPoints));
}

BOOST_AUTO_TEST_CASE(the_mass_is_the_plates_and_turns_about_its_centroid) {
  const Matrix6d M = triangle_mass(kPoints, kPlate);
  const double mass = kPlate.material.rho * kPlate.thickness * signed_area(kPoints);
  const Vector6d x = sample(kPoints, {1, 0}, Eigen::Matrix2d::Zero());
  BOOST_TEST(x.dot(M * x) == mass, boost::test_tools::tolerance(1e-14));
  const Vector2d centroid = (kPoints[0] + kPoints[1] + kPoints[2]) / 3;
  Eigen::Matrix2d turn;
  turn << 0, -1, 1, 0;
  const Vector6d spin = sample(kPoints, -turn * centroid, turn);
  double sides = 0;
  for (std::size_t i = 0; i < 3; ++i) sides += (kPoints[i] - kPoints[(i + 1) % 3]).squaredNorm();
  BOOST_TEST(spin.dot(M * spin) == mass * sides / 36, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_SUITE_END()
