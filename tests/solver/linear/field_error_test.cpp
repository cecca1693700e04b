#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "solver/elements/block_mesh.h"
#include "solver/linear/fields.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(field_error)

namespace t = trammel::solver;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

const t::Material kMaterial{7e10, 2700, 0.3};

t::System membrane() {
  return t::assemble(t::mesh_rectangle({0.8, 0.5, 4, false, 0.25}, {"p", kMaterial, 0.02}));
}

/// Field u = a x, v = 0 with sxx = E a / (1 - nu^2), syy = nu sxx.
t::MembraneFieldPoint stretched_membrane_point(double a, const Vector2d& p) {
  const double sxx = kMaterial.E * a / (1 - kMaterial.nu * kMaterial.nu);
  return {{a * p.x(), 0}, 0.5 * a, {sxx, kMaterial.nu * sxx, 0}};
}

VectorXd nodal_values(const t::System& system, double a) {
  VectorXd q = VectorXd::Zero(system.K.rows());
  for (std::size_t i = 0; i < system.model.nodes.size(); ++i)
    q[system.coordinates.node[i][0]] = a * system.model.nodes[i].position.x();
  return q;
}

t::System beam(t::BeamTheory theory) {
  return t::assemble(trammel::testing::inclined_line(theory));
}

/// Pure bending: v = c s^2 / 2, θ = c s along the beam.
t::BeamFieldPoint bent(double c, const Vector2d& p) {
  const double s = p.norm();
  return {0, c * s * s / 2, c * s, 0, 0, 1e3 * c};
}

VectorXd nodal_bending_values(const t::System& system, double c) {
  VectorXd q(system.K.rows());
  for (std::size_t i = 0; i < system.model.nodes.size(); ++i) {
    const auto x = bent(c, system.model.nodes[i].position);
    q[system.coordinates.node[i][0]] = -0.6 * x.deflection;
    q[system.coordinates.node[i][1]] = 0.8 * x.deflection;
    q[system.coordinates.node[i][2]] = x.rotation;
  }
  return q;
}

}  // namespace

BOOST_AUTO_TEST_CASE(stretch_error_of_1_percent_is_1_percent_in_norms) {
  const t::System system = membrane();
  const auto exact = [](const Vector2d& p) { return stretched_membrane_point(1e-3, p); };
  const t::MembraneErrors e = t::membrane_errors(system, nodal_values(system, 1.01e-3), exact);
  BOOST_TEST(e.displacement == 0.01, boost::test_tools::tolerance(1e-10));
  BOOST_TEST(e.stress == 0.01, boost::test_tools::tolerance(1e-10));
  BOOST_TEST(e.energy == 0.01, boost::test_tools::tolerance(1e-10));
  BOOST_TEST(e.rotation == 1.0, boost::test_tools::tolerance(1e-10));  // 0.5e-3 exact; 0 computed
}

BOOST_AUTO_TEST_CASE(energy_of_an_error_is_that_of_its_stresses) {
  const t::System system = membrane();
  const Eigen::Vector3d found = stretched_membrane_point(1e-3, {}).stress, exact(3e7, -5e7, 8e7);
  const auto energy = [](const Eigen::Vector3d& s) {  // s^T C^-1 s, stress s
    const double nu = kMaterial.nu;
    Eigen::Matrix3d compliance;
    compliance << 1, -nu, 0, -nu, 1, 0, 0, 0, 2 * (1 + nu);
    return s.dot(compliance * s);
  };
  const t::MembraneErrors e =
      t::membrane_errors(system, nodal_values(system, 1e-3), [&](const Vector2d& p) {
        return t::MembraneFieldPoint{p, 1, exact};
      });
  BOOST_TEST(e.energy == std::sqrt(energy(found - exact) / energy(exact)),
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(bending_error_of_1_percent_is_1_percent_in_norms) {
  for (const auto theory : {t::BeamTheory::euler_bernoulli, t::BeamTheory::timoshenko}) {
    const t::System system = beam(theory);
    const auto exact = [](const Vector2d& p) { return bent(1e-3, p); };
    const t::BeamErrors e = t::beam_errors(system, nodal_bending_values(system, 1.01e-3), exact);
    for (const double error : {e.deflection, e.rotation, e.bending_moment, e.energy,
                               e.nodal_deflection, e.nodal_rotation}) {
      BOOST_TEST(error == 0.01, boost::test_tools::tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(error_relative_to_zero_is_not_finite) {
  const t::System system = beam(t::BeamTheory::euler_bernoulli);
  const auto exact = [](const Vector2d& p) { return bent(1e-3, p); };
  const t::BeamErrors e = t::beam_errors(system, nodal_bending_values(system, 1e-3), exact);
  BOOST_TEST(!std::isfinite(e.axial_force));  // the exact axial force is 0
}

BOOST_AUTO_TEST_CASE(missing_value_spoils_every_norm) {
  const t::System system = membrane();
  VectorXd q = nodal_values(system, 1e-3);
  q[3] = std::numeric_limits<double>::quiet_NaN();
  const auto exact = [](const Vector2d& p) { return stretched_membrane_point(1e-3, p); };
  const t::MembraneErrors e = t::membrane_errors(system, q, exact);
  BOOST_TEST(std::isnan(e.displacement));
  BOOST_TEST(std::isnan(e.energy));

  const t::System bar = beam(t::BeamTheory::timoshenko);
  VectorXd bending = nodal_bending_values(bar, 1e-3);
  bending[4] = std::numeric_limits<double>::quiet_NaN();
  const t::BeamErrors b =
      t::beam_errors(bar, bending, [](const Vector2d& p) { return bent(1e-3, p); });
  BOOST_TEST(std::isnan(b.deflection));
  BOOST_TEST(std::isnan(b.energy));
  BOOST_TEST(std::isnan(b.nodal_deflection));
}

BOOST_AUTO_TEST_SUITE_END()
