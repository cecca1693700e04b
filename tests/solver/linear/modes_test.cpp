#include "solver/linear/modes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/linear/row_balance.h"
#include "tests/support/solver/frames.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(modes)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCantilever[] = {1.87510406871196117, 4.69409113297417458, 7.85475743823761256,
                                  10.995540734875467};
const auto kPaths = {EigenMethod::dense, EigenMethod::sparse};

ModalSolution solve(const Model& model, Index count, EigenMethod path = EigenMethod::automatic) {
  return solve_modes(assemble(model), {count, path});
}

double cantilever_error(Index elements, std::size_t mode, MassMatrix mass) {
  Model model = cantilever(unit_section(1e7), 1, elements, 0.3);
  model.members[0].mass = mass;
  const double exact = kCantilever[mode] * kCantilever[mode] / (2 * kPi);
  return solve(model, 4).frequency[static_cast<Index>(mode)] / exact - 1;
}

/// The manipulator's pair of modes at its centred pose, one corner of the base moved by so much.
struct Pair {
  System system;
  ModalSolution modes;
};
Pair centred_pair(double moved, EigenMethod path) {
  ManipulatorDesign design = table_1_design();
  design.geometry.base[1] += Vector2d(moved, 0.3 * moved);
  Pair pair{assemble(build_manipulator(design, centred_pose())), {}};
  pair.modes = solve_modes(pair.system, {3, path});
  return pair;
}

/// Sine of the largest angle between the spans of the first two modes, in the metric of the mass.
double angle_between(const Pair& a, const Pair& b) {
  const MatrixXd A = a.modes.shape.leftCols<2>(), B = b.modes.shape.leftCols<2>();
  const SparseMatrix& M = a.system.M;
  const MatrixXd AA = A.transpose() * (M * A), AB = A.transpose() * (M * B);
  const MatrixXd rest = B - A * AA.llt().solve(AB);
  const MatrixXd rr = rest.transpose() * (M * rest), BB = B.transpose() * (M * B);
  return std::sqrt(
      Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(rr, BB).eigenvalues().maxCoeff());
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_span_of_a_repeated_pair_moves_by_no_more_than_a_perturbation_is_due) {
  // The pair stands apart from the third mode by three tenths of its eigenvalue, so that a relative
  // change d of a length turns its span by some 10 d, whatever becomes of the single vectors.
  for (const EigenMethod path : kPaths) {
    const Pair as_is = centred_pair(0, path);
    const double d = 1e-10 / 0.5;
    const Pair moved = centred_pair(1e-10, path);
    BOOST_TEST(angle_between(as_is, moved) < 20 * d);
    BOOST_TEST(std::abs(moved.modes.frequency[0] / as_is.modes.frequency[0] - 1) < 4 * d);
    BOOST_TEST(std::abs(moved.modes.frequency[1] / as_is.modes.frequency[1] - 1) < 4 * d);
  }
  // Dense and sparse find the same span, and not the same vectors.
  const Pair dense = centred_pair(0, EigenMethod::dense),
             sparse = centred_pair(0, EigenMethod::sparse);
  BOOST_TEST(angle_between(dense, sparse) < 1e-13);
}

BOOST_AUTO_TEST_CASE(consistent_euler_bernoulli_errs_by_the_fourth_power_over_1440) {
  for (std::size_t mode = 0; mode < 4; ++mode) {
    for (const Index elements : {16, 64, 128}) {
      const double bh = kCantilever[mode] / static_cast<double>(elements);
      if (bh > 0.5) continue;
      BOOST_TEST(cantilever_error(elements, mode, MassMatrix::consistent) == std::pow(bh, 4) / 1440,
                 tolerance(0.03));
    }
  }
}

BOOST_AUTO_TEST_CASE(round_off_stays_far_below_a_condition_number_of_a_thousand_millions) {
  // 512 elements: the plain double solution would be off by 1e-6; theory says 1.25e-13 here.
  const double error = cantilever_error(512, 0, MassMatrix::consistent);
  BOOST_TEST(std::abs(error - std::pow(kCantilever[0] / 512, 4) / 1440) < 3e-13);
}

BOOST_AUTO_TEST_CASE(the_round_off_estimate_bounds_the_error_where_theory_is_known) {
  for (const Index elements : {256, 512, 1024}) {
    const ModalSolution m = solve(cantilever(unit_section(1e7), 1, elements, 0.3), 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const double bh = kCantilever[k] / static_cast<double>(elements);
      const double exact =
          kCantilever[k] * kCantilever[k] / (2 * kPi) * (1 + std::pow(bh, 4) / 1440);
      const double off = std::abs(m.frequency[static_cast<Index>(k)] / exact - 1);
      BOOST_TEST(off < 10 * m.roundoff[static_cast<Index>(k)] + std::pow(bh, 6));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_lumped_mass_errs_by_the_second_power) {
  for (std::size_t mode = 0; mode < 3; ++mode) {
    const double coarse = cantilever_error(16, mode, MassMatrix::lumped);
    const double fine = cantilever_error(32, mode, MassMatrix::lumped);
    BOOST_TEST(coarse < 0);  // half an element of mass stands at the tip
    BOOST_TEST(std::log2(coarse / fine) == 2, tolerance(0.05));
  }
}

BOOST_AUTO_TEST_CASE(both_paths_find_every_copy_in_the_pinned_double_cross) {
  const System system = assemble(pinned_double_cross(4));
  for (const EigenMethod path : kPaths) {
    const ModalSolution m = solve_modes(system, {16, path});
    BOOST_REQUIRE(m.outcome.solved());
    const double expected[] = {11.3392, 17.6919, 17.6919, 17.7206, 17.7206, 17.7206,
                               17.7206, 17.7206, 45.5240, 57.4271, 57.4271, 57.7477,
                               57.7477, 57.7477, 57.7477, 57.7477};
    for (Index i = 0; i < 16; ++i) BOOST_TEST(m.frequency[i] == expected[i], tolerance(5e-6));
    const MatrixXd gram = m.shape.transpose() * system.M * m.shape;
    BOOST_TEST((gram - MatrixXd::Identity(16, 16)).cwiseAbs().maxCoeff() < 1e-12);
    for (Index i = 0; i < 16; ++i) {
      const VectorXd x = m.shape.col(i);
      const double w2 = std::pow(2 * kPi * m.frequency[i], 2);
      BOOST_TEST((system.K * x - w2 * (system.M * x)).norm() < 1e-10 * (system.K * x).norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(the_paths_agree_on_a_cut_through_a_cluster) {
  const System system = assemble(pinned_double_cross(8));
  for (const Index count : {1, 4, 6, 13}) {  // 4, 6, 13: inside a cluster
    const ModalSolution dense = solve_modes(system, {count, EigenMethod::dense});
    const ModalSolution sparse = solve_modes(system, {count, EigenMethod::sparse});
    BOOST_REQUIRE(dense.frequency.size() == count);
    BOOST_REQUIRE(sparse.frequency.size() == count);
    BOOST_TEST((dense.frequency - sparse.frequency).cwiseAbs().maxCoeff() <
               1e-12 * dense.frequency.maxCoeff());
  }
}

BOOST_AUTO_TEST_CASE(the_ansys_free_rod_vm61_is_free_and_stretches) {
  Model model = beam({3e7, 1e4, 0, 73e-5, 0, 1, 1}, 800, 80);
  // Kept from bending: a rod.
  const Index tip = 1;
  model.supports = {{"", 0, {false, true, true}}, {"", tip, {false, true, true}}};
  for (const EigenMethod path : kPaths) {
    const ModalSolution m = solve(model, 3, path);
    BOOST_TEST(m.zero_energy_mode_count == 1);
    BOOST_TEST(m.frequency[0] == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_free_beam_has_three_zeros_and_the_clamped_beams_frequencies) {
  const double expected = 4.73004074486270403 * 4.73004074486270403 / (2 * kPi);
  for (const EigenMethod path : kPaths) {
    const ModalSolution m = solve(beam(unit_section(1e7), 1, 40, 1.1), 5, path);
    BOOST_REQUIRE(m.outcome.solved());
    BOOST_TEST(m.zero_energy_mode_count == 3);
    BOOST_TEST(m.frequency.head(3).isZero(0));
    BOOST_TEST(m.frequency[3] == expected, tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(as_many_modes_as_rigid_motions_or_fewer_are_zeros) {
  const Model model = beam(unit_section(1e7), 1, 8);
  for (const EigenMethod path : kPaths) {
    for (const Index count : {1, 3}) {
      const ModalSolution m = solve(model, count, path);
      BOOST_REQUIRE(m.outcome.solved());
      BOOST_TEST(m.frequency.size() == count);
      BOOST_TEST(m.frequency.isZero(0));
      BOOST_TEST(m.zero_energy_mode_count == 3);
    }
  }
}

BOOST_AUTO_TEST_CASE(frequencies_scale_with_the_square_root_of_E_and_shapes_do_not) {
  const ModalSolution soft = solve(pinned_double_cross(2), 3);
  Model stiff_model = pinned_double_cross(2);
  for (Member& m : stiff_model.members) {
    m.section.EA *= 4;
    m.section.EI *= 4;
    m.end_section = m.section;
  }
  const ModalSolution stiff = solve(stiff_model, 3);
  for (Index i = 0; i < 3; ++i) {
    BOOST_TEST(stiff.frequency[i] == 2 * soft.frequency[i], tolerance(1e-13));
  }
  BOOST_TEST(std::abs(std::abs(stiff.shape.col(0).dot(soft.shape.col(0))) /
                          soft.shape.col(0).squaredNorm() -
                      1) < 1e-10);
}

BOOST_AUTO_TEST_CASE(frequencies_do_not_change_when_the_model_is_turned_or_the_unit_of_length) {
  const Section s = rectangle({6.9e10, 2700, 0.33}, 0.0015, 0.03);
  const auto bent = [&](double angle, double unit) {
    Section section = s;
    section.EA *= unit;
    section.EI *= unit * unit * unit;
    section.mass_per_length /= unit;
    const double c = std::cos(angle);
    const double d = std::sin(angle);
    Model model;
    for (const Vector2d& p : {Vector2d(0, 0), Vector2d(0.2, 0), Vector2d(0.3, 0.17)}) {
      model.nodes.push_back({"", unit * Vector2d(c * p.x() - d * p.y(), d * p.x() + c * p.y())});
    }
    model.members = {member("", 0, 1, section, 4), member("", 1, 2, section, 4)};
    model.members[0].axially_flexible = false;
    model.supports = {clamp(0)};
    return solve(model, 6).frequency;
  };
  const VectorXd reference = bent(0, 1);
  for (const double angle : {0.4, 1.7, 3.0}) {
    BOOST_TEST((bent(angle, 1) - reference).cwiseQuotient(reference).cwiseAbs().maxCoeff() < 1e-12);
  }
  // In millimetres, with force in mN so that mass stays in kg: E A in 1e3 mN, E I in 1e9 mN mm^2.
  BOOST_TEST((bent(0.4, 1e3) - reference).cwiseQuotient(reference).cwiseAbs().maxCoeff() < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_massless_beam_with_a_tip_mass_is_an_oscillator) {
  Section section = unit_section();
  section.mass_per_length = 0;
  Model model = cantilever(section, 1, 5);
  model.masses = {{1, 2, 0, {0, 0}}};
  model.supports.push_back({"", 1, {true, false, false}});
  for (const EigenMethod path : kPaths) {
    const ModalSolution m = solve(model, 6, path);
    BOOST_TEST(m.outcome.solved(), m.outcome.reason);
    BOOST_REQUIRE(m.frequency.size() == 1);  // the rest has no mass
    BOOST_TEST(m.frequency[0] == std::sqrt(3.0 / 2) / (2 * kPi), tolerance(1e-12));
  }
}

/// A body on a massless beam that floats: its three motions carry all the mass there is.
BOOST_AUTO_TEST_CASE(where_free_motions_carry_all_the_mass_nothing_swings) {
  Section section = unit_section();
  section.mass_per_length = 0;
  for (const Index elements : {2, 16, 64}) {
    Model model = beam(section, 1, elements);
    model.masses = {{1, 2, 0.5, {0, 0}}};
    for (const EigenMethod path : kPaths) {
      const ModalSolution m = solve(model, 6, path);
      BOOST_TEST(m.outcome.solved(), m.outcome.reason);
      BOOST_TEST(m.zero_energy_mode_count == 3);
      BOOST_TEST(m.frequency.size() == 3);
      BOOST_TEST(m.frequency.isZero(0));
    }
  }
}

BOOST_AUTO_TEST_CASE(condensing_massless_coordinates_changes_no_frequency) {
  Model model = cantilever(unit_section(), 1, 6);
  model.members[0].mass = MassMatrix::lumped;
  const System system = assemble(model);
  const ModalSolution m = solve_modes(system, {3, EigenMethod::dense});
  std::vector<Index> kept;
  std::vector<Index> gone;
  const VectorXd mass = system.M.diagonal();
  for (Index i = 0; i < mass.size(); ++i) (mass[i] > 0 ? kept : gone).push_back(i);
  BOOST_TEST(gone.size() == 6u);
  const MatrixXd K = system.K;
  const MatrixXd inner = K(gone, gone);
  const MatrixXd across = K(gone, kept);
  const MatrixXd condensed = K(kept, kept) - across.transpose() * inner.llt().solve(across);
  const VectorXd half = mass(kept).cwiseSqrt().cwiseInverse();
  const MatrixXd A = half.asDiagonal() * condensed * half.asDiagonal();
  const VectorXd w2 = A.selfadjointView<Eigen::Lower>().eigenvalues();
  for (Index i = 0; i < 3; ++i) {
    BOOST_TEST(m.frequency[i] == std::sqrt(w2[i]) / (2 * kPi), tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(a_deep_beam_fv5_needs_shear_and_rotary_inertia) {
  Section section = rectangle({200e9, 8000, 0.3}, 2, 2, 0.849673);
  for (const EigenMethod path : kPaths) {
    Model model = beam(section, 10, 60);
    model.members[0].theory = BeamTheory::timoshenko;
    model.supports = {pin(0), roller(1)};
    const ModalSolution m = solve(model, 4, path);
    const double expected[] = {42.644909, 125.000, 148.14934, 283.46839};
    for (Index i = 0; i < 4; ++i) BOOST_TEST(m.frequency[i] == expected[i], tolerance(2e-3));
  }
}

BOOST_AUTO_TEST_CASE(four_thousand_coordinates_by_lanczos_match_theory) {
  const ModalSolution m = solve(cantilever(unit_section(1e7), 1, 1400, 0.2), 4);
  BOOST_TEST(m.outcome.solved(), m.outcome.reason);
  for (Index i = 0; i < 4; ++i) {
    const double exact = kCantilever[i] * kCantilever[i] / (2 * kPi);
    BOOST_TEST(m.frequency[i] == exact, tolerance(1e-10));
  }
}

BOOST_AUTO_TEST_CASE(two_solutions_of_the_same_system_are_the_same_bit_for_bit) {
  const System system = assemble(pinned_double_cross(8));
  for (const EigenMethod path : kPaths) {
    const ModalSolution a = solve_modes(system, {10, path});
    const ModalSolution b = solve_modes(system, {10, path});
    BOOST_TEST((a.frequency.array() == b.frequency.array()).all());
    BOOST_TEST((a.shape.array() == b.shape.array()).all());
  }
}

BOOST_AUTO_TEST_CASE(asking_for_more_modes_than_there_are_gives_what_there_is) {
  const Model model = cantilever(unit_section(), 1, 1);
  for (const EigenMethod path : kPaths) {
    const ModalSolution m = solve(model, 50, path);
    BOOST_TEST(m.outcome.solved(), m.outcome.reason);
    BOOST_TEST(m.frequency.size() == 3);
  }
}

BOOST_AUTO_TEST_CASE(
    the_backward_error_of_many_modes_is_the_largest_of_each_and_finds_a_wrong_one) {
  const System system = assemble(build_manipulator(table_1_design(), centred_pose()));
  const ModalSolution modes = solve_modes(system, {4});
  VectorXd w2 = (2 * kPi * modes.frequency).cwiseAbs2();
  const auto error_of = [&](Index first, Index count) {
    const Eigen::MatrixXd u = system.T * modes.shape.middleCols(first, count);
    RowBalance<double> rows(system, count);
    rows.add_stiffness(u);
    rows.add_inertia(u * (-w2.segment(first, count)).asDiagonal());
    return rows.backward_error();
  };
  double largest = 0;
  for (Index mode = 0; mode < 4; ++mode) largest = std::max(largest, error_of(mode, 1));
  BOOST_TEST(largest < 1e-12);
  BOOST_TEST(error_of(0, 4) == largest);
  for (Index wrong = 0; wrong < 4; ++wrong) {
    const double right = w2[wrong];
    w2[wrong] *= 1 + 1e-3;
    BOOST_TEST(error_of(0, 4) > 1e-9);
    w2[wrong] = right;
  }
}

BOOST_AUTO_TEST_SUITE_END()
