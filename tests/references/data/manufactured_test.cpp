// The manufactured fields against their own derivatives, by complex step: f'(x) = Im f(x + ih) / h
// has no cancellation, so that h = 1e-30 leaves round-off alone.
#include "references/data/manufactured.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>
#include <vector>

BOOST_AUTO_TEST_SUITE(manufactured)

namespace m = trammel::references::manufactured;

namespace {

using Complex = std::complex<double>;
constexpr double kStep = 1e-30;
constexpr double kRoundoff = 1e-13;

double slope(const Complex& value) {
  return value.imag() / kStep;
}

std::vector<m::MembraneProblem> membranes() {
  std::vector<m::MembraneProblem> all;
  for (const auto field : {m::MembraneField::clamped, m::MembraneField::cantilever,
                           m::MembraneField::uniform_strain, m::MembraneField::linear_strain}) {
    for (const double omega : {0.0, 900.0}) {
      all.push_back({field, 7e10, 0.33, 2700, 0.8, 0.5, 1e-3, omega});
    }
  }
  return all;
}

std::vector<m::BeamProblem> beams() {
  std::vector<m::BeamProblem> all;
  for (const auto field : {m::BeamField::smooth, m::BeamField::cubic}) {
    for (const auto shear :
         {m::ShearStrain::none, m::ShearStrain::from_bending, m::ShearStrain::independent}) {
      for (const double omega : {0.0, 300.0}) {
        all.push_back({field, shear, 5e8, 4e5, 9e7, 20, 0.03, 2.0, 1e-3, omega});
      }
    }
  }
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(membrane_strains_are_the_derivatives_of_the_displacements) {
  for (const auto& problem : membranes()) {
    for (const auto& [x, y] : {std::pair{0.13, 0.41}, std::pair{0.77, 0.08}}) {
      const auto state = m::evaluate<double>(problem, x, y);
      const auto dx = m::evaluate<Complex>(problem, {x, kStep}, {y, 0}).displacement;
      const auto dy = m::evaluate<Complex>(problem, {x, 0}, {y, kStep}).displacement;
      const double scale = problem.amplitude / problem.height;
      BOOST_TEST(std::abs(state.strain[0] - slope(dx[0])) < kRoundoff * scale);
      BOOST_TEST(std::abs(state.strain[1] - slope(dy[1])) < kRoundoff * scale);
      BOOST_TEST(std::abs(state.strain[2] - slope(dy[0]) - slope(dx[1])) < kRoundoff * scale);
      BOOST_TEST(std::abs(state.rotation - (slope(dx[1]) - slope(dy[0])) / 2) < kRoundoff * scale);
    }
  }
}

BOOST_AUTO_TEST_CASE(membrane_stress_is_plane_stress_of_the_strain) {
  for (const auto& problem : membranes()) {
    const auto s = m::evaluate<double>(problem, 0.31, 0.22);
    const double E = problem.E;
    const double nu = problem.nu;
    const double tolerance = kRoundoff * E * problem.amplitude / problem.height;
    BOOST_TEST(std::abs(E * s.strain[0] - (s.stress[0] - nu * s.stress[1])) < tolerance);
    BOOST_TEST(std::abs(E * s.strain[1] - (s.stress[1] - nu * s.stress[0])) < tolerance);
    BOOST_TEST(std::abs(E * s.strain[2] - 2 * (1 + nu) * s.stress[2]) < tolerance);
  }
}

BOOST_AUTO_TEST_CASE(body_force_balances_the_stress_and_the_inertia_of_a_membrane) {
  for (const auto& problem : membranes()) {
    for (const auto& [x, y] : {std::pair{0.13, 0.41}, std::pair{0.77, 0.08}}) {
      const auto s = m::evaluate<double>(problem, x, y);
      const auto dx = m::evaluate<Complex>(problem, {x, kStep}, {y, 0}).stress;
      const auto dy = m::evaluate<Complex>(problem, {x, 0}, {y, kStep}).stress;
      const double inertia = problem.rho * problem.omega * problem.omega;
      const double scale = problem.E * problem.amplitude / (problem.height * problem.height);
      BOOST_TEST(std::abs(slope(dx[0]) + slope(dy[2]) + s.body_force[0] +
                          inertia * s.displacement[0]) < 10 * kRoundoff * scale);
      BOOST_TEST(std::abs(slope(dx[2]) + slope(dy[1]) + s.body_force[1] +
                          inertia * s.displacement[1]) < 10 * kRoundoff * scale);
    }
  }
}

BOOST_AUTO_TEST_CASE(membranes_do_not_move_where_the_ground_holds_them) {
  for (const auto& problem : membranes()) {
    int held = 0;
    for (int i = 0; i <= 12; ++i) {
      const double t = i / 12.0;
      const double l = problem.length;
      const double h = problem.height;
      for (const auto& [x, y] : {std::pair{0.0, t * h}, std::pair{l, t * h}, std::pair{t * l, 0.0},
                                 std::pair{t * l, h}}) {
        const auto fixed = m::fixed_displacements(problem, x, y);
        const auto state = m::evaluate<double>(problem, x, y);
        for (const std::size_t k : {0U, 1U}) {
          if (!fixed[k]) continue;
          ++held;
          BOOST_TEST(std::abs(state.displacement[k]) < 1e-15 * problem.amplitude);
        }
      }
    }
    BOOST_TEST(held >= 3);  // otherwise a rigid motion is free
    BOOST_TEST(!m::fixed_displacements(problem, 0.5 * problem.length, 0.5 * problem.height)[0]);
  }
}

BOOST_AUTO_TEST_CASE(beam_resultants_follow_from_the_derivatives_of_the_displacements) {
  for (const auto& problem : beams()) {
    for (const double x : {0.21, 1.37}) {
      const auto s = m::evaluate<double>(problem, x);
      const auto d = m::evaluate<Complex>(problem, {x, kStep});
      const double strain = problem.amplitude / problem.length;
      BOOST_TEST(std::abs(s.axial_force - problem.EA * slope(d.axial)) <
                 kRoundoff * problem.EA * strain);
      BOOST_TEST(std::abs(s.bending_moment - problem.EI * slope(d.rotation)) <
                 kRoundoff * problem.EI * strain);
      if (problem.shear == m::ShearStrain::none) {
        BOOST_TEST(std::abs(s.rotation - slope(d.deflection)) < kRoundoff * strain);
        BOOST_TEST(std::abs(s.shear_force + slope(d.bending_moment)) <
                   10 * kRoundoff * problem.EI * strain);
      } else {
        BOOST_TEST(std::abs(s.shear_force - problem.kappa_GA * (slope(d.deflection) - s.rotation)) <
                   10 * kRoundoff * problem.kappa_GA * strain);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(beam_loads_balance_the_resultants_and_the_inertia) {
  for (const auto& problem : beams()) {
    for (const double x : {0.21, 1.37}) {
      const auto s = m::evaluate<double>(problem, x);
      const auto d = m::evaluate<Complex>(problem, {x, kStep});
      const double square = problem.omega * problem.omega;
      const double rho_A = problem.mass_per_length;
      const double rho_I = problem.shear == m::ShearStrain::none ? 0.0 : problem.inertia_per_length;
      const double axial = std::abs(s.axial_force) + std::abs(s.axial_load);
      const double across = std::abs(s.transverse_load) + problem.kappa_GA * problem.amplitude;
      const double turn = std::abs(s.moment_load) + problem.kappa_GA * problem.amplitude;
      BOOST_TEST(std::abs(slope(d.axial_force) + s.axial_load + rho_A * square * s.axial) <
                 10 * kRoundoff * axial);
      BOOST_TEST(std::abs(slope(d.shear_force) + s.transverse_load +
                          rho_A * square * s.deflection) < 10 * kRoundoff * across);
      BOOST_TEST(std::abs(slope(d.bending_moment) + s.shear_force + s.moment_load +
                          rho_I * square * s.rotation) < 10 * kRoundoff * turn);
    }
  }
}

BOOST_AUTO_TEST_CASE(beams_are_clamped_where_they_start) {
  for (const auto& problem : beams()) {
    const auto s = m::evaluate<double>(problem, 0.0);
    BOOST_TEST(s.axial == 0.0);
    BOOST_TEST(s.deflection == 0.0);
    BOOST_TEST(s.rotation == 0.0);
    BOOST_TEST(s.bending_moment != 0.0);
  }
}

BOOST_AUTO_TEST_CASE(transverse_load_alone_bends_a_shear_flexible_beam_without_distributed_moment) {
  for (const auto& problem : beams()) {
    if (problem.omega != 0) continue;
    const bool own_shear = problem.shear == m::ShearStrain::independent;
    BOOST_TEST((m::evaluate<double>(problem, 0.9).moment_load != 0.0) == own_shear);
  }
}

BOOST_AUTO_TEST_SUITE_END()
