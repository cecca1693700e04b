#include "solver/sensitivity/frequency_complex_step.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/assembly/inertia.h"
#include "solver/assembly/projection.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/sparse_lu.h"
#include "solver/model/numbers.h"
#include "solver/sensitivity/seeded_design.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXcd;
using Eigen::VectorXd;
using ComplexMatrix = Eigen::SparseMatrix<Complex>;

constexpr int kIterations = 2;  // the first mends the mode's round-off, the second its slope

/// d/dp of an element matrix, whose numbers carry a complex step.
template <class Matrix>
auto derivatives(const Matrix& matrix) {
  return (matrix.imag() / kComplexStep).eval();
}

/// K and M at p + ih.
struct SteppedSystem {
  ComplexMatrix K, M;
};

SteppedSystem stepped(const System& system, const SeededDesign<Complex>& design,
                      Counters& counters) {
  SymmetricBuilder K(system.K.rows()), M(system.K.rows());
  Projection into_K(system.constraints, K), into_M(system.constraints, M);
  for (const FrameElement& e : system.mesh.frame) {
    const Member& member = system.model.members[static_cast<std::size_t>(e.member)];
    const SeededLink<Complex>& link = design.link(e.member);
    const Complex length = link.length / static_cast<double>(member.elements);
    const Eigen::Vector3cd c = frame_rigidity(link.section, member.theory, length);
    const Matrix36<Complex> B = frame_deformation_matrix(link.direction, length);
    const Matrix6<Complex> R = frame_rotation(link.direction);
    const Matrix6<Complex> m = frame_mass(link.section, member.theory, member.mass, length);
    const Matrix6<Complex> k = B.transpose() * c.asDiagonal() * B;
    const Matrix6<Complex> rotated = R.transpose() * m * R;
    into_K.add(e.coordinates, derivatives(k));
    into_M.add(e.coordinates, derivatives(rotated));
    counters.element_evaluations += 2;
  }
  for (const PointMass& lump : system.model.masses) {
    const Eigen::Matrix3cd m =
        point_inertia(design.platform_mass().mass, design.platform_mass().inertia, lump.offset);
    into_M.add(system.coordinates.node[static_cast<std::size_t>(lump.node)], derivatives(m));
  }
  for_each_plate_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    const auto k = (B.transpose() * c.asDiagonal() * B).eval();
    into_K.add(coordinates, (design.log_stiffness_derivative() * k).eval());
  });
  for_each_plate_mass(system, [&](const auto& coordinates, const auto& m) {
    into_M.add(coordinates, (design.log_mass_derivative() * m).eval());
  });
  const Complex step(0, kComplexStep);
  return {system.K.cast<Complex>() + step * K.build().cast<Complex>(),
          system.M.cast<Complex>() + step * M.build().cast<Complex>()};
}

/// [K - lambda M, -M x_0; (M x_0)^T, 0]
ComplexMatrix bordered(const SteppedSystem& at, const Complex& lambda, const VectorXcd& Mx) {
  const ComplexMatrix A = at.K - lambda * at.M;
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(static_cast<std::size_t>(A.nonZeros() + 2 * Mx.size()));
  for (Index j = 0; j < A.outerSize(); ++j) {
    for (ComplexMatrix::InnerIterator it(A, j); it; ++it) {
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), it.value());
    }
  }
  const auto last = static_cast<int>(Mx.size());
  for (int i = 0; i < last; ++i) {
    entries.emplace_back(i, last, -Mx[i]);
    entries.emplace_back(last, i, Mx[i]);
  }
  ComplexMatrix J(last + 1, last + 1);
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

/// d lambda / dp of one mode; NaN where it cannot be told from its neighbours.
double eigenvalue_derivative(const SteppedSystem& at, const VectorXd& shape, double lambda,
                             Counters& counters) {
  VectorXcd x = shape.cast<Complex>();
  Complex root = lambda;
  // Scaled so that the border weighs what the matrix does.
  const VectorXcd Mx = at.M * x;
  SparseLu<Complex> lu;
  ++counters.factorizations;
  if (!lu.factorize(bordered(at, root, Mx))) return kNaN;
  VectorXcd residual(x.size() + 1);
  for (int i = 0; i < kIterations; ++i) {
    residual.head(x.size()) = at.K * x - root * (at.M * x);
    residual[x.size()] = 0;
    const VectorXcd change = lu.solve(residual);
    ++counters.solves;
    x -= change.head(x.size());
    root -= change[x.size()];
  }
  return derivative(root);
}

}  // namespace

FrequencyComplexStep differentiate_by_complex_step(const ManipulatorDesign& design,
                                                   const Pose& pose,
                                                   const std::vector<DesignParameter>& parameters,
                                                   Index count) {
  const System system = assemble(build_manipulator(design, pose));
  const bool stretch = std::all_of(system.model.members.begin(), system.model.members.end(),
                                   [](const Member& member) { return member.axially_flexible; });
  if (!stretch) {
    throw ModelError(
        "complex steps need links that stretch: the constraints of inextensible ones move");
  }
  const Posture posture = inverse_kinematics(design.geometry, pose);
  const ModalSolution modes = solve_modes(system, {.count = count + 1});
  FrequencyComplexStep result;
  result.outcome = modes.outcome;
  result.evidence = modes.evidence;
  result.counters = modes.counters;
  if (!modes.outcome.solved()) return result;
  const Index kept = std::min(count, modes.frequency.size());
  result.frequency = modes.frequency.head(kept);
  result.derivative.setZero(kept, static_cast<Index>(parameters.size()));
  for (const FrequencySet& set : equal_frequencies(modes.frequency)) {
    if (set.first >= kept || set.count == 1 || modes.frequency[set.first] == 0) continue;
    result.outcome = {Status::singular,
                      "frequencies repeat, and a complex step does not tell them apart"};
    return result;
  }
  for (Index p = 0; p < result.derivative.cols(); ++p) {
    const SeededDesign<Complex> seeded(design, posture, parameters[static_cast<std::size_t>(p)]);
    const SteppedSystem at = stepped(system, seeded, result.counters);
    for (Index n = 0; n < kept; ++n) {
      if (modes.frequency[n] == 0) continue;
      const double omega = 2 * std::numbers::pi * modes.frequency[n];
      result.derivative(n, p) =
          eigenvalue_derivative(at, modes.shape.col(n), omega * omega, result.counters) /
          (4 * std::numbers::pi * omega);
    }
  }
  if (!result.derivative.allFinite()) {
    result.outcome = {Status::singular,
                      "a limb is straight or folded: its angles, and with them the frequencies, "
                      "change infinitely fast with the link lengths"};
  }
  return result;
}

}  // namespace trammel::solver
