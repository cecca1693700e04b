#include "solver/elements/frame_element.h"

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(frame_element)

using namespace trammel::solver;
using namespace trammel::testing;

namespace {

const Section kSection = rectangle({2e11, 7800, 0.3}, 0.2, 0.1);
constexpr double kLength = 1.3;
const auto kTheories = {BeamTheory::euler_bernoulli, BeamTheory::timoshenko};

/// Returns the stiffness matrix of a frame element in element axes.
Matrix6d frame_stiffness(const Section& section, BeamTheory theory, double length) {
  const FrameDeformation B = frame_deformation_matrix<double>(Eigen::Vector2d::UnitX(), length);
  return B.transpose() * frame_deformation_stiffness(section, theory, length).asDiagonal() * B;
}

double largest_difference(const Matrix6d& a, const Matrix6d& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

Matrix6d world(const Matrix6d& k, double angle) {
  const Matrix6d R = frame_transformation_matrix({std::cos(angle), std::sin(angle)});
  return R.transpose() * k * R;
}

/// Returns the displacements of a rigid motion: translation (a, b) and rotation w about the first
/// node.
Vector6d rigid_motion(double a, double b, double w, double angle) {
  Vector6d u;
  u << a, b, w, a - w * kLength * std::sin(angle), b + w * kLength * std::cos(angle), w;
  return u;
}

}  // namespace

BOOST_AUTO_TEST_CASE(euler_bernoulli_stiffness_is_equation_7) {
  const double L = kLength, EA = kSection.EA, EI = kSection.EI;
  Matrix6d k;
  k << EA / L, 0, 0, -EA / L, 0, 0,                                                               //
      0, 12 * EI / (L * L * L), 6 * EI / (L * L), 0, -12 * EI / (L * L * L), 6 * EI / (L * L),    //
      0, 6 * EI / (L * L), 4 * EI / L, 0, -6 * EI / (L * L), 2 * EI / L,                          //
      -EA / L, 0, 0, EA / L, 0, 0,                                                                //
      0, -12 * EI / (L * L * L), -6 * EI / (L * L), 0, 12 * EI / (L * L * L), -6 * EI / (L * L),  //
      0, 6 * EI / (L * L), 2 * EI / L, 0, -6 * EI / (L * L), 4 * EI / L;
  BOOST_TEST(largest_difference(frame_stiffness(kSection, BeamTheory::euler_bernoulli, L), k) <
             1e-15);
}

BOOST_AUTO_TEST_CASE(rigid_motions_store_no_energy_and_are_the_only_ones) {
  for (const BeamTheory theory : kTheories)
    for (const double angle : {0.0, 0.7, 2.5}) {
      const Matrix6d k = world(frame_stiffness(kSection, theory, kLength), angle);
      for (const Vector6d& u : {rigid_motion(1, 0, 0, angle), rigid_motion(0, 1, 0, angle),
                                rigid_motion(0.3, -0.2, 1, angle)}) {
        BOOST_TEST((k * u).cwiseAbs().maxCoeff() < 1e-14 * k.cwiseAbs().maxCoeff());
      }
      const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(k);
      BOOST_TEST(eigen.eigenvalues()[3] > 1e-6 * eigen.eigenvalues()[5]);
    }
}

BOOST_AUTO_TEST_CASE(deformations_rebuild_the_stiffness_of_equation_10) {
  for (const BeamTheory theory : kTheories) {
    const double angle = 2.1;
    const FrameDeformation B =
        frame_deformation_matrix({std::cos(angle), std::sin(angle)}, kLength);
    const Matrix6d k =
        B.transpose() * frame_deformation_stiffness(kSection, theory, kLength).asDiagonal() * B;
    BOOST_TEST(largest_difference(k, world(frame_stiffness(kSection, theory, kLength), angle)) <
               1e-15);
  }
}

BOOST_AUTO_TEST_CASE(mass_matrices_carry_the_mass_of_the_member) {
  const double mass = kSection.mass_per_length * kLength;
  for (const BeamTheory theory : kTheories)
    for (const MassMatrix kind : {MassMatrix::consistent, MassMatrix::lumped}) {
      const Matrix6d M = frame_mass(kSection, theory, kind, kLength);
      for (const double angle : {0.0, 1.0}) {
        const Vector6d along = rigid_motion(1, 0, 0, angle);
        const Vector6d across = rigid_motion(0, 1, 0, angle);
        const Matrix6d Mw = world(M, angle);
        BOOST_TEST(along.dot(Mw * along) == mass, boost::test_tools::tolerance(1e-14));
        BOOST_TEST(across.dot(Mw * across) == mass, boost::test_tools::tolerance(1e-14));
        BOOST_TEST(std::abs(along.dot(Mw * across)) < 1e-14 * mass);
      }
      BOOST_TEST(largest_difference(M, M.transpose()) == 0);
    }
}

BOOST_AUTO_TEST_CASE(mass_matrices_have_the_inertia_of_a_rod) {
  const double m = kSection.mass_per_length * kLength;
  const Vector6d turn = rigid_motion(0, 0, 1, 0.4);
  for (const BeamTheory theory : kTheories) {
    const double rotary =
        theory == BeamTheory::timoshenko ? kSection.inertia_per_length * kLength : 0;
    const Matrix6d M = world(frame_mass(kSection, theory, MassMatrix::consistent, kLength), 0.4);
    BOOST_TEST(turn.dot(M * turn) == m * kLength * kLength / 3 + rotary,
               boost::test_tools::tolerance(1e-13));
    const Matrix6d lumped = frame_mass(kSection, theory, MassMatrix::lumped, kLength);
    BOOST_TEST(lumped(2, 2) + lumped(5, 5) == rotary);
  }
}

BOOST_AUTO_TEST_CASE(beam_stiff_in_shear_is_an_euler_bernoulli_beam) {
  Section stiff = kSection;
  stiff.kappa_GA = 1e6 * kSection.EA;
  stiff.inertia_per_length = 0;
  for (const MassMatrix kind : {MassMatrix::consistent, MassMatrix::lumped}) {
    BOOST_TEST(largest_difference(frame_mass(stiff, BeamTheory::timoshenko, kind, kLength),
                                  frame_mass(stiff, BeamTheory::euler_bernoulli, kind, kLength)) <
               1e-7);
  }
  BOOST_TEST(largest_difference(frame_stiffness(stiff, BeamTheory::timoshenko, kLength),
                                frame_stiffness(stiff, BeamTheory::euler_bernoulli, kLength)) <
             1e-7);
}

BOOST_AUTO_TEST_SUITE_END()
