// ObservedQuantity orders of convergence against manufactured solutions, and patch tests.
#include "harness/statics_modes/manufactured.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

BOOST_AUTO_TEST_SUITE(manufactured)

using namespace trammel;
using namespace trammel::harness;
using namespace trammel::solver;
using namespace trammel::references;
namespace m = trammel::references::manufactured;

namespace {

constexpr double kE = 7e10, kNu = 0.33, kRho = 2700;

MembraneTest membrane(m::MembraneField field, bool six_nodes, double distortion, double omega = 0) {
  return {{field, kE, kNu, kRho, 0.8, 0.5, 1e-3, omega}, 0.01, 1, six_nodes, distortion};
}

/// A deep beam, so that shear is in its asymptotic range on few elements.
BeamTest beam(m::BeamField field, m::ShearStrain shear, double distortion, double omega = 0) {
  const double depth = 0.4, width = 0.05;
  const double EA = kE * width * depth, mass = kRho * width * depth;
  return {{field, shear, EA, EA * depth * depth / 12, 5.0 / 6 * EA / (2 * (1 + kNu)), mass,
           mass * depth * depth / 12, 1, 1e-3, omega},
          1,
          distortion};
}

/// Orders between neighbouring meshes; all errors must fall.
template <class Run>
std::vector<double> orders(const std::vector<Index>& cells, const Run& error) {
  std::vector<double> found;
  double before = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double here = error(cells[i]);
    BOOST_REQUIRE(std::isfinite(here));
    if (i > 0) {
      found.push_back(std::log(before / here) / std::log(double(cells[i]) / double(cells[i - 1])));
    }
    before = here;
  }
  return found;
}

/// The last `count` orders are within 0.1 of theory.
void check_orders(const std::string& what, const std::vector<double>& found, double theory,
                  std::size_t count) {
  for (std::size_t i = found.size() - count; i < found.size(); ++i) {
    BOOST_TEST(std::abs(found[i] - theory) < 0.1,
               what << ": order " << found[i] << ", theory " << theory);
  }
}

struct MembraneTheory {
  double displacement, gradient;
};

void check_membrane(MembraneTest test, const std::vector<Index>& cells,
                    const MembraneTheory& theory) {
  std::vector<MembraneErrors> errors;
  const auto errors_of = [&](Index n) {
    test.cells = n;
    const auto result = run_membrane_test(test);
    BOOST_REQUIRE(result.solution.outcome.solved());
    errors.push_back(result.errors);
    return result.errors.displacement;
  };
  check_orders("displacement", orders(cells, errors_of), theory.displacement, 2);
  const auto stored = [&](double MembraneErrors::*which) {
    std::size_t next = 0;
    return orders(cells, [&](Index) { return errors[next++].*which; });
  };
  check_orders("rotation", stored(&MembraneErrors::rotation), theory.gradient, 2);
  check_orders("stress", stored(&MembraneErrors::stress), theory.gradient, 2);
  check_orders("energy", stored(&MembraneErrors::energy), theory.gradient, 2);
}

struct BeamTheoryOrders {
  double deflection, rotation, shear_force, bending_moment, energy;
};

void check_beam(BeamTest test, const BeamTheoryOrders& theory) {
  const std::vector<Index> cells = {4, 8, 16, 32, 64, 128};
  std::vector<BeamErrors> errors;
  for (const Index n : cells) {
    test.cells = n;
    const auto result = run_beam_test(test);
    BOOST_REQUIRE(result.solution.outcome.solved());
    errors.push_back(result.errors);
  }
  const auto stored = [&](double BeamErrors::*which) {
    std::size_t next = 0;
    return orders(cells, [&](Index) { return errors[next++].*which; });
  };
  check_orders("axial displacement", stored(&BeamErrors::axial_displacement), 2, 3);
  check_orders("axial force", stored(&BeamErrors::axial_force), 1, 3);
  check_orders("deflection", stored(&BeamErrors::deflection), theory.deflection, 3);
  check_orders("rotation", stored(&BeamErrors::rotation), theory.rotation, 2);
  check_orders("shear force", stored(&BeamErrors::shear_force), theory.shear_force, 2);
  check_orders("moment", stored(&BeamErrors::bending_moment), theory.bending_moment, 2);
  check_orders("energy", stored(&BeamErrors::energy), theory.energy, 3);
}

const std::vector<double> kDistortions = {0.0, 0.25};
constexpr double kMembraneOmega = 4000;  // rad/s
constexpr double kBeamOmega = 3000;      // rad/s, above the first frequency

}  // namespace

BOOST_AUTO_TEST_CASE(three_node_triangles_converge_with_order_two_and_their_stress_with_one) {
  for (const double distortion : kDistortions) {
    for (const double omega : {0.0, kMembraneOmega}) {
      check_membrane(membrane(m::MembraneField::clamped, false, distortion, omega),
                     {4, 8, 16, 32, 64}, {2, 1});
      check_membrane(membrane(m::MembraneField::cantilever, false, distortion, omega),
                     {8, 16, 32, 64, 128}, {2, 1});
    }
  }
}

BOOST_AUTO_TEST_CASE(six_node_triangles_converge_with_order_three_and_their_stress_with_two) {
  for (const double distortion : kDistortions) {
    for (const double omega : {0.0, kMembraneOmega}) {
      check_membrane(membrane(m::MembraneField::clamped, true, distortion, omega),
                     {3, 6, 12, 24, 48}, {3, 2});
    }
    check_membrane(membrane(m::MembraneField::cantilever, true, distortion), {3, 6, 12, 24, 48},
                   {3, 2});
  }
}

BOOST_AUTO_TEST_CASE(euler_bernoulli_beams_converge_with_orders_four_three_two_one) {
  // Deflection, rotation, moment and shear force are the interpolation's derivatives of order 0
  // to 3.
  for (const double distortion : kDistortions) {
    for (const double omega : {0.0, kBeamOmega}) {
      check_beam(beam(m::BeamField::smooth, m::ShearStrain::none, distortion, omega),
                 {4, 3, 1, 2, 2});
    }
  }
}

BOOST_AUTO_TEST_CASE(timoshenko_beams_converge_with_order_two_once_elements_are_shorter_than_deep) {
  // The shear force is uniform in an element: order 1, which in the end leads in energy; by duality
  // the deflection has order 2. Under transverse load alone the rotation, 3, and the moment, 2,
  // keep the orders of the cubic.
  for (const double distortion : kDistortions) {
    check_beam(beam(m::BeamField::smooth, m::ShearStrain::from_bending, distortion),
               {2, 3, 1, 2, 1});
  }
}

BOOST_AUTO_TEST_CASE(
    a_distributed_moment_costs_a_timoshenko_beam_one_order_in_rotation_and_moment) {
  // An element's own bending answers to its ends alone: a moment in between is left to the mesh.
  for (const double distortion : kDistortions) {
    for (const double omega : {0.0, kBeamOmega}) {
      check_beam(beam(m::BeamField::smooth, m::ShearStrain::independent, distortion, omega),
                 {2, 2, 1, 1, 1});
    }
  }
}

BOOST_AUTO_TEST_CASE(beams_are_exact_at_their_nodes_in_statics) {
  // The Green's functions of end forces lie in the interpolation, whatever is loaded in between.
  for (const auto shear :
       {m::ShearStrain::none, m::ShearStrain::from_bending, m::ShearStrain::independent}) {
    for (const double distortion : kDistortions) {
      for (const Index cells : {8, 32, 128}) {
        BeamTest test = beam(m::BeamField::smooth, shear, distortion);
        test.cells = cells;
        const auto errors = run_beam_test(test).errors;
        BOOST_TEST(errors.nodal_deflection < 1e-12);
        BOOST_TEST(errors.nodal_rotation < 1e-12);
        BOOST_TEST(errors.deflection > 100 * errors.nodal_deflection);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(nodes_of_a_vibrating_euler_bernoulli_beam_converge_with_order_four) {
  BeamTest test = beam(m::BeamField::smooth, m::ShearStrain::none, 0.25, kBeamOmega);
  const auto nodal = [&](Index cells) {
    test.cells = cells;
    return run_beam_test(test).errors.nodal_deflection;
  };
  check_orders("nodes", orders({4, 8, 16, 32, 64}, nodal), 4, 2);
}

BOOST_AUTO_TEST_CASE(distorted_triangles_pass_the_patch_test_to_round_off) {
  const auto check = [](m::MembraneField field, bool six_nodes, Index cells) {
    MembraneTest test = membrane(field, six_nodes, 0.29);
    test.cells = cells;
    const auto errors = run_membrane_test(test).errors;
    const double roundoff = 1e-15 * static_cast<double>(cells);  // gradients divide by the cell
    BOOST_TEST(errors.displacement < 10 * roundoff);
    BOOST_TEST(errors.rotation < 10 * roundoff);
    BOOST_TEST(errors.stress < 10 * roundoff);
    BOOST_TEST(errors.energy < 10 * roundoff);
  };
  for (const Index cells : {2, 5, 16}) {
    check(m::MembraneField::uniform_strain, false, cells);
    check(m::MembraneField::uniform_strain, true, cells);
    check(m::MembraneField::linear_strain, true, cells);
  }
}

BOOST_AUTO_TEST_CASE(three_node_triangles_fail_the_patch_test_of_a_higher_order) {
  // Otherwise the tests above would pass whatever the element.
  MembraneTest test = membrane(m::MembraneField::linear_strain, false, 0.25);
  test.cells = 8;
  BOOST_TEST(run_membrane_test(test).errors.stress > 1e-3);
}

BOOST_AUTO_TEST_CASE(distorted_beams_pass_the_patch_test_of_linear_moment_to_round_off) {
  for (const auto shear : {m::ShearStrain::none, m::ShearStrain::from_bending}) {
    BeamTest test = beam(m::BeamField::cubic, shear, 0.5);
    test.cells = 5;
    const auto errors = run_beam_test(test).errors;
    BOOST_TEST(errors.axial_displacement < 1e-14);
    BOOST_TEST(errors.deflection < 1e-13);
    BOOST_TEST(errors.rotation < 1e-13);
    BOOST_TEST(errors.axial_force < 1e-14);
    BOOST_TEST(errors.bending_moment < 1e-12);
    BOOST_TEST(errors.shear_force < 1e-11);
  }
}

BOOST_AUTO_TEST_SUITE_END()
