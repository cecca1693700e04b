#include "solver/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/assembly/inertia.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/dense_eigen.h"
#include "solver/model/numbers.h"
#include "solver/sensitivity/seeded_design.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Quantity = DesignParameter::Quantity;

/// Frequencies nearer than this to each other, relatively, are one set. Shapes of modes farther
/// apart are good to the modes' round-off over it.
constexpr double kSameFrequency = 1e-7;

/// Calls visit(number) for each number of the design that the parameter names.
template <class Visit>
void for_each_number(ManipulatorDesign& design, const DesignParameter& parameter, Visit&& visit) {
  const Quantity quantity = parameter.quantity;
  const bool length = quantity == Quantity::length;
  const auto meet = [&visit](double* x) {
    if (x != nullptr) visit(*x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (parameter.proximal[i]) {
      meet(length ? &design.geometry.proximal[i]
                  : detail::link_number(design.proximal[i], quantity));
    }
    if (parameter.distal[i]) {
      meet(length ? &design.geometry.distal[i] : detail::link_number(design.distal[i], quantity));
    }
  }
  if (parameter.platform) meet(detail::number(design.platform, quantity));
}

/// U^T (dK/dp - w^2 dM/dp) U on the unconstrained coordinates, for a set of modes of one w.
class SetDerivative {
 public:
  SetDerivative(const System& system, const MatrixXd& U, double omega_squared)
      : system_(system), U_(U), omega_squared_(omega_squared) {
    for (const Member& member : system.model.members) {
      if (!member.axially_flexible) inextensible_ = true;
    }
    if (!inextensible_) return;
    multipliers_.resize(static_cast<Index>(system.constraints.rows.size()), U.cols());
    for (Index j = 0; j < U.cols(); ++j) {
      const VectorXd u = U.col(j);
      multipliers_.col(j) = system.constraints.multipliers(
          internal_forces(system, u) - omega_squared * inertia_forces(system, u));
    }
  }

  MatrixXd of(const SeededDesign<Dual>& design) const {
    MatrixXd sum = MatrixXd::Zero(U_.cols(), U_.cols());
    for (const FrameElement& e : system_.mesh.frame) add_element(e, design.link(e.member), sum);
    if (inextensible_) add_constraints(design, sum);
    add_platform(design, sum);
    return (sum + sum.transpose()) / 2;
  }

 private:
  template <std::size_t n>
  [[nodiscard]] Eigen::Matrix<double, static_cast<int>(n), Eigen::Dynamic> gather(
      const std::array<Index, n>& coordinates) const {
    Eigen::Matrix<double, static_cast<int>(n), Eigen::Dynamic> local(n, U_.cols());
    for (Index j = 0; j < U_.cols(); ++j) local.col(j) = detail::gather(coordinates, U_.col(j));
    return local;
  }

  void add_element(const FrameElement& e, const SeededLink<Dual>& link, MatrixXd& sum) const {
    const Member& member = system_.model.members[static_cast<std::size_t>(e.member)];
    const Eigen::Matrix<double, 6, Eigen::Dynamic> local = gather(e.coordinates);
    const Dual length = link.length / static_cast<double>(member.elements);
    Eigen::Vector3<Dual> c = frame_rigidity(link.section, member.theory, length);
    if (!member.axially_flexible) c[0] = 0;
    const Matrix36<Dual> B = frame_deformation(link.direction, length);
    const Matrix6<Dual> R = frame_rotation(link.direction);
    const Matrix6<Dual> m = frame_mass(link.section, member.theory, member.mass, length);
    const Index k = U_.cols();
    Eigen::Matrix<Dual, 3, Eigen::Dynamic> d(3, k);
    Eigen::Matrix<Dual, 6, Eigen::Dynamic> v(6, k);
    for (Index j = 0; j < k; ++j) {
      const Eigen::Matrix<Dual, 6, 1> u = local.col(j).cast<Dual>();
      d.col(j) = B * u;
      v.col(j) = R * u;
    }
    for (Index j = 0; j < k; ++j) {
      const Eigen::Vector3<Dual> s = c.cwiseProduct(d.col(j));
      const Eigen::Matrix<Dual, 6, 1> f = m * v.col(j);
      for (Index i = 0; i < k; ++i) {
        Dual strain(0);
        Dual inertia(0);
        for (Index n = 0; n < 3; ++n) strain += d(n, i) * s[n];
        for (Index n = 0; n < 6; ++n) inertia += v(n, i) * f[n];
        sum(i, j) += derivative(strain) - omega_squared_ * derivative(inertia);
      }
    }
  }

  /// With C u = 0 and C depending on p, the eliminated coordinates move: - mu^T dC/dp u, twice.
  void add_constraints(const SeededDesign<Dual>& design, MatrixXd& sum) const {
    for (std::size_t r = 0; r < system_.constraints.rows.size(); ++r) {
      const ConstraintRow& row = system_.constraints.rows[r];
      if (row.source != ConstraintRow::Source::inextensible) continue;
      const FrameElement& e = system_.mesh.frame[static_cast<std::size_t>(row.index)];
      const SeededLink<Dual>& link = design.link(e.member);
      const Vector2d turn(derivative(link.direction.x()), derivative(link.direction.y()));
      const Eigen::Matrix<double, 6, Eigen::Dynamic> u = gather(e.coordinates);
      const Eigen::RowVectorXd gap = turn.transpose() * (u.middleRows<2>(3) - u.topRows<2>());
      const Eigen::RowVectorXd mu = multipliers_.row(static_cast<Index>(r));
      sum -= mu.transpose() * gap + gap.transpose() * mu;
    }
  }

  void add_platform(const SeededDesign<Dual>& design, MatrixXd& sum) const {
    const double stiffness = design.stiffness_rate();
    const double mass = design.mass_rate();
    if (stiffness == 0 && mass == 0) return;
    for (const PointMass& lump : system_.model.masses) {
      const Eigen::Matrix3<Dual> m =
          point_inertia(design.mass().mass, design.mass().inertia, lump.offset);
      Eigen::Matrix3d dm;
      for (Index i = 0; i < 9; ++i) dm(i) = derivative(m(i));
      const auto u = gather(system_.coordinates.node[static_cast<std::size_t>(lump.node)]);
      sum -= omega_squared_ * (u.transpose() * dm * u);
    }
    for (const Triangle& triangle : system_.model.triangles) {
      const TrianglePoints points = corners(system_.model, triangle);
      const Plate& plate = system_.model.plates[static_cast<std::size_t>(triangle.plate)];
      const auto u = gather(system_.coordinates.of_triangle<6>(triangle));
      // From the strains, which stay small beside the rigid motion of a stiff plate.
      const double volume = plate.thickness * std::abs(signed_area(points));
      const Eigen::Vector3d c = membrane_rigidity(plate.material, volume);
      const Eigen::Matrix<double, 3, Eigen::Dynamic> strain = triangle_deformation(points) * u;
      sum += stiffness * (strain.transpose() * c.asDiagonal() * strain) -
             mass * omega_squared_ * (u.transpose() * triangle_mass(points, plate) * u);
    }
  }

  const System& system_;
  const MatrixXd& U_;
  double omega_squared_;
  bool inextensible_ = false;
  MatrixXd multipliers_;  // constraint row x mode
};

/// Modes enough that the last set wanted is whole.
ModalSolution whole_sets(const System& system, Index count) {
  constexpr Index kSpareModes = 3;
  const Index all = system.K.rows();
  Index wanted = std::min(all, count + kSpareModes);
  for (;;) {
    ModalSolution modes = solve_modes(system, {.count = wanted});
    if (!modes.outcome.solved() || wanted == all || modes.frequency.size() <= count) return modes;
    if (equal_frequencies(modes.frequency).back().first >= count) return modes;
    wanted = std::min(all, 2 * wanted);
  }
}

}  // namespace

std::vector<FrequencySet> equal_frequencies(const VectorXd& frequency) {
  std::vector<FrequencySet> sets;
  for (Index i = 0; i < frequency.size(); ++i) {
    const bool repeated =
        !sets.empty() && frequency[i] - frequency[i - 1] <= kSameFrequency * frequency[i];
    if (repeated) {
      ++sets.back().count;
    } else {
      sets.push_back({i, 1});
    }
  }
  return sets;
}

const char* unit(Quantity quantity) {
  switch (quantity) {
    case Quantity::E:
      return "Pa";
    case Quantity::density:
      return "kg/m^3";
    case Quantity::length:
    case Quantity::thickness:
    case Quantity::width:
      break;
  }
  return "m";
}

ManipulatorDesign perturbed(const ManipulatorDesign& design, const DesignParameter& parameter,
                            double change) {
  ManipulatorDesign result = design;
  for_each_number(result, parameter, [change](double& x) { x += change; });
  return result;
}

double parameter_value(const ManipulatorDesign& design, const DesignParameter& parameter) {
  ManipulatorDesign copy = design;
  double largest = 0;
  for_each_number(copy, parameter, [&largest](double& x) { largest = std::max(largest, x); });
  return largest;
}

FrequencySensitivity frequency_sensitivity(const ManipulatorDesign& design, const Pose& pose,
                                           const std::vector<DesignParameter>& parameters,
                                           Index count) {
  const System system = assemble(build_manipulator(design, pose));
  const Posture posture = inverse_kinematics(design.geometry, pose);
  const ModalSolution modes = whole_sets(system, count);
  FrequencySensitivity result;
  result.outcome = modes.outcome;
  result.counters = modes.counters;
  const Index kept = std::min(count, modes.frequency.size());
  const auto columns = static_cast<Index>(parameters.size());
  result.frequency = modes.frequency.head(kept);
  result.derivative = MatrixXd::Constant(kept, columns, kNaN);
  result.gap = VectorXd::Constant(kept, std::numeric_limits<double>::infinity());
  if (!modes.outcome.solved()) return result;

  std::vector<SeededDesign<Dual>> designs;
  designs.reserve(parameters.size());
  for (const DesignParameter& parameter : parameters) {
    designs.emplace_back(design, posture, parameter);
  }
  for (const FrequencySet& set : equal_frequencies(modes.frequency)) {
    if (set.first >= kept) break;
    const Index shown = std::min(set.count, kept - set.first);
    result.sets.push_back({set.first, shown});
    const double f = modes.frequency[set.first];
    const Index end = set.first + set.count;
    double gap = result.gap[set.first];
    if (set.first > 0) gap = f - modes.frequency[set.first - 1];
    if (end < modes.frequency.size()) gap = std::min(gap, modes.frequency[end] - f);
    result.gap.segment(set.first, shown).setConstant(f > 0 ? gap / f : gap);
    if (f == 0) {
      result.derivative.middleRows(set.first, shown).setZero();
      continue;
    }
    const double omega = 2 * std::numbers::pi * f;
    const MatrixXd U = system.T * modes.shape.middleCols(set.first, set.count);
    const SetDerivative derivative(system, U, omega * omega);
    for (Index p = 0; p < columns; ++p) {
      const MatrixXd small = derivative.of(designs[static_cast<std::size_t>(p)]);
      result.counters.element_evaluations += 2 * std::ssize(system.mesh.frame);
      if (!small.allFinite()) {
        result.outcome = {Status::singular,
                          "a limb is straight or folded: its angles, and with them the "
                          "frequencies, change infinitely fast with the link lengths"};
        result.derivative.setConstant(kNaN);
        return result;
      }
      const SymmetricEigenpairs<MatrixXd> rates = symmetric_eigenpairs(small);
      if (!rates.converged) {
        result.outcome = {Status::not_converged,
                          "the rates of repeated frequencies did not converge"};
        result.derivative.setConstant(kNaN);
        return result;
      }
      result.derivative.col(p).segment(set.first, shown) =
          rates.value.head(shown) / (4 * std::numbers::pi * omega);
    }
  }
  return result;
}

FirstFrequency first_frequency(const ManipulatorDesign& design, const DesignParameter& parameter,
                               const Pose& pose) {
  FirstFrequency first{.outcome = {}, .frequency = kNaN, .derivative = kNaN, .counters = {}};
  for (Index count = 1;; count *= 2) {
    const FrequencySensitivity s = frequency_sensitivity(design, pose, {parameter}, count);
    first.counters += s.counters;
    first.outcome = s.outcome;
    const auto rigid = (s.frequency.array() == 0).count();
    if (rigid < s.frequency.size()) {
      first.frequency = s.frequency[rigid];
      first.derivative = s.derivative(rigid, 0);
      return first;
    }
    if (rigid < count) break;
  }
  if (first.outcome.solved()) first.outcome = {Status::singular, "every motion is rigid"};
  return first;
}

PoseGrid reachable_grid(const ManipulatorGeometry& geometry, double phi, Index columns) {
  check_geometry(geometry);
  if (columns < 2) throw ModelError("a grid of poses has at least two columns");
  Vector2d low = Vector2d::Constant(-std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  const Eigen::Rotation2Dd turn(phi);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d center = geometry.base[i] - turn * geometry.platform[i];
    const double reach = geometry.proximal[i] + geometry.distal[i];
    low = low.cwiseMax((center.array() - reach).matrix());
    high = high.cwiseMin((center.array() + reach).matrix());
  }
  const Vector2d size = high - low;
  if (!(size.minCoeff() > 0)) {
    throw ModelError("no pose of this orientation is within reach of the three limbs");
  }
  const double step = size.x() / static_cast<double>(columns - 1);
  const auto rows = static_cast<Index>(std::floor(size.y() / step * (1 + 1e-12))) + 1;
  return {low.x(), low.y(), step, step, columns, rows, phi};
}

SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                   const DesignParameter& parameter, const PoseGrid& grid) {
  SensitivityMap map;
  map.grid = grid;
  for (MatrixXd* m :
       {&map.frequency, &map.derivative, &map.parallel_distance, &map.serial_distance}) {
    m->setConstant(grid.rows, grid.columns, kNaN);
  }
  map.reachable.setConstant(grid.rows, grid.columns, false);
  for (Index j = 0; j < grid.rows; ++j) {
    for (Index i = 0; i < grid.columns; ++i) {
      const Pose pose{grid.x0 + static_cast<double>(i) * grid.dx,
                      grid.y0 + static_cast<double>(j) * grid.dy, grid.phi};
      const Posture posture = inverse_kinematics(design.geometry, pose);
      if (!posture.outcome.solved()) continue;
      map.reachable(j, i) = true;
      const Jacobians distances = jacobians(design.geometry, pose, posture);
      map.parallel_distance(j, i) = distances.parallel_distance;
      map.serial_distance(j, i) = distances.serial_distance;
      const FirstFrequency first = first_frequency(design, parameter, pose);
      map.frequency(j, i) = first.frequency;
      map.derivative(j, i) = first.derivative;
      map.counters += first.counters;
    }
  }
  return map;
}

}  // namespace trammel::solver
