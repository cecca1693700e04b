#include "solver/manipulator/frequency_sensitivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "solver/linalg/dense_eigen.h"
#include "solver/linear/element_operators.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MaterialOf<Dual> lifted(const Material& m) {
  return {.E = Dual(m.E), .rho = Dual(m.rho), .nu = Dual(m.nu)};
}

/// Converts the dimensions and material of a link to dual numbers with zero derivatives.
LinkDesignOf<Dual> lifted(const LinkDesign& link) {
  return {.thickness = Dual(link.thickness),
          .width = Dual(link.width),
          .material = lifted(link.material),
          .shear_coefficient = link.shear_coefficient,
          .mass = link.mass,
          .inertia = link.inertia};
}

void seed(Dual* x) {
  if (x != nullptr) *x = with_derivative(value(*x), 1);
}

/// Section, direction and length of a link, including their derivatives by one parameter.
struct SeededLink {
  SectionOf<Dual> section;
  Eigen::Vector2<Dual> direction;
  Dual length;
};

/// Links and platform of a design, including derivatives by one parameter p at a fixed pose. The
/// properties to which p refers have the derivative 1.
struct SeededDesign {
  std::array<SeededLink, 6> links;  ///< in the order of the members of the built model
  PlatformMassOf<Dual> platform_mass;
  Dual plate_rigidity;  ///< Young's modulus times thickness; scales the triangle stiffness
};

SeededLink make_link(const LinkDesignOf<Dual>& link, const Dual& nominal,
                     const Eigen::Vector2<Dual>& from, const Eigen::Vector2<Dual>& to) {
  const Eigen::Vector2<Dual> span = to - from;
  using std::sqrt;
  const Dual length = sqrt(Dual(span.x() * span.x() + span.y() * span.y()));
  return {link_section(link, nominal), {span.x() / length, span.y() / length}, length};
}

SeededDesign seed_design_derivatives(const ManipulatorDesign& design, const Posture& posture,
                                     const DesignParameter& parameter) {
  SeededDesign seeded;
  PlatformDesignOf<Dual> platform{.thickness = Dual(design.platform.thickness),
                                  .material = lifted(design.platform.material),
                                  .mass = design.platform.mass,
                                  .inertia = design.platform.inertia};
  const ManipulatorGeometry& g = design.geometry;
  if (parameter.platform) seed(detail::property(platform, parameter.kind));
  seeded.platform_mass = platform_mass(platform, g.platform);
  seeded.plate_rigidity = platform.material.E * platform.thickness;
  const bool length = parameter.kind == DesignParameter::Kind::length;
  for (std::size_t i = 0; i < 3; ++i) {
    LinkDesignOf<Dual> proximal = lifted(design.proximal[i]);
    LinkDesignOf<Dual> distal = lifted(design.distal[i]);
    if (parameter.proximal[i]) seed(detail::link_property(proximal, parameter.kind));
    if (parameter.distal[i]) seed(detail::link_property(distal, parameter.kind));
    const Dual a = with_derivative(g.proximal[i], length && parameter.proximal[i] ? 1 : 0);
    const Dual b = with_derivative(g.distal[i], length && parameter.distal[i] ? 1 : 0);
    const Eigen::Vector2<Dual> A = g.base[i].cast<Dual>();
    const Eigen::Vector2<Dual> C = posture.C[i].cast<Dual>();
    // The angles of a straight limb change infinitely fast with its link lengths. All other
    // parameters do not change the angles.
    const Eigen::Vector2<Dual> B =
        derivative(a) == 0 && derivative(b) == 0
            ? Eigen::Vector2<Dual>(posture.B[i].cast<Dual>())
            : elbow_position(g.base[i], posture.C[i], a, b, g.working_mode[i]);
    seeded.links[2 * i] = make_link(proximal, a, A, B);
    seeded.links[2 * i + 1] = make_link(distal, b, B, C);
  }
  return seeded;
}

/// Returns the rows of the modes U for the coordinates of an element. Rows of missing coordinates
/// (-1) are zero.
template <std::size_t n>
Eigen::Matrix<double, static_cast<int>(n), Eigen::Dynamic> gather_modes(
    const std::array<Index, n>& coordinates, const MatrixXd& U) {
  Eigen::Matrix<double, static_cast<int>(n), Eigen::Dynamic> local(n, U.cols());
  for (Index j = 0; j < U.cols(); ++j) local.col(j) = detail::gather(coordinates, U.col(j));
  return local;
}

/// Computes U^T (dK/dp - w^2 dM/dp) U on the unconstrained coordinates. U contains all modes with
/// the same angular frequency w.
class SetDerivative {
 public:
  SetDerivative(const System& system, const MatrixXd& U, double omega_squared)
      : system_(system), U_(U), omega_squared_(omega_squared) {
    inextensible_ = std::ranges::any_of(system.model.members,
                                        [](const Member& m) { return !m.axially_flexible; });
    if (!inextensible_) return;
    multipliers_.resize(std::ssize(system.constraints.rows), U.cols());
    for (Index j = 0; j < U.cols(); ++j) {
      const VectorXd u = U.col(j);
      multipliers_.col(j) = system.constraints.lagrange_multipliers(
          internal_forces(system, u) - omega_squared * inertia_forces(system, u));
    }
  }

  /// Returns U^T (dK/dp - w^2 dM/dp) U, a matrix mode x mode. The matrix is not finite if p is a
  /// link length and a limb is straight or folded.
  [[nodiscard]] MatrixXd evaluate(const SeededDesign& design) const {
    MatrixXd sum = MatrixXd::Zero(U_.cols(), U_.cols());
    for (const FrameElement& e : system_.mesh.frame)
      add_element(e, design.links[to_size(e.member)], sum);
    if (inextensible_) add_constraints(design, sum);
    add_platform(design, sum);
    return (sum + sum.transpose()) / 2;
  }

 private:
  void add_element(const FrameElement& e, const SeededLink& link, MatrixXd& sum) const {
    using Duals = Eigen::Matrix<Dual, Eigen::Dynamic, Eigen::Dynamic>;
    const Member& member = system_.model.members[to_size(e.member)];
    const Duals u = gather_modes(e.coordinates, U_).cast<Dual>();
    const Dual length = link.length / static_cast<double>(member.elements);
    Eigen::Vector3<Dual> c = frame_deformation_stiffness(link.section, member.theory, length);
    if (!member.axially_flexible) c[0] = 0;
    const Duals d = frame_deformation_matrix(link.direction, length) * u;
    const Duals v = frame_transformation_matrix(link.direction) * u;
    const Matrix6<Dual> m = frame_mass(link.section, member.theory, member.mass, length);
    const Duals strain = d.transpose() * c.asDiagonal() * d, inertia = v.transpose() * m * v;
    sum += rates_of(strain) - omega_squared_ * rates_of(inertia);
  }

  /// Adds the effect of inextensible elements. Their constraints C u = 0 with multipliers mu depend
  /// on p, which adds - mu^T dC/dp u and the transposed matrix.
  void add_constraints(const SeededDesign& design, MatrixXd& sum) const {
    for (std::size_t r = 0; r < system_.constraints.rows.size(); ++r) {
      const ConstraintRow& row = system_.constraints.rows[r];
      if (row.source != ConstraintRow::Source::inextensible) continue;
      const FrameElement& e = system_.mesh.frame[static_cast<std::size_t>(row.index)];
      const SeededLink& link = design.links[to_size(e.member)];
      const Vector2d turn(derivative(link.direction.x()), derivative(link.direction.y()));
      const Eigen::Matrix<double, 6, Eigen::Dynamic> u = gather_modes(e.coordinates, U_);
      const Eigen::RowVectorXd gap = turn.transpose() * (u.middleRows<2>(3) - u.topRows<2>());
      const Eigen::RowVectorXd mu = multipliers_.row(static_cast<Index>(r));
      sum -= mu.transpose() * gap + gap.transpose() * mu;
    }
  }

  static double log_derivative(const Dual& x) {
    return derivative(x) == 0 ? 0 : derivative(x) / value(x);
  }

  void add_platform(const SeededDesign& design, MatrixXd& sum) const {
    const double stiffness = log_derivative(design.plate_rigidity);
    const double mass = log_derivative(design.platform_mass.mass);
    if (stiffness == 0 && mass == 0) return;
    for (const PointMass& lump : system_.model.masses) {
      const Eigen::Matrix3d dm = rates_of(
          point_mass_matrix(design.platform_mass.mass, design.platform_mass.inertia, lump.offset));
      const auto u = gather_modes(system_.coordinates.node[to_size(lump.node)], U_);
      sum -= omega_squared_ * (u.transpose() * dm * u);
    }
    // Element deformations are accurate even if they are small compared with the rigid motion of a
    // stiff plate.
    for_each_plate_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
      const Eigen::MatrixXd strain = B * gather_modes(coordinates, U_);
      sum += stiffness * (strain.transpose() * c.asDiagonal() * strain);
    });
    for_each_plate_mass(system_, [&](const auto& coordinates, const auto& m) {
      const auto u = gather_modes(coordinates, U_);
      sum -= mass * omega_squared_ * (u.transpose() * m * u);
    });
  }

  const System& system_;
  const MatrixXd& U_;
  double omega_squared_;
  bool inextensible_ = false;
  // Lagrange multipliers of the constraints, constraint row x mode.
  MatrixXd multipliers_;
};

/// Relative difference up to which frequencies are treated as repeated. For a larger difference,
/// the error of the mode shapes is about the round-off error of the frequencies divided by this
/// difference.
constexpr double kSameFrequency = 1e-7;

/// Computes at least `count` modes, including all modes of the last set of repeated frequencies.
ModalSolution modes_in_complete_sets(const System& system, Index count) {
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

/// Returns the difference between the frequencies of a set and the nearest frequency outside the
/// set. The difference is divided by the frequency of the set unless this frequency is zero.
double relative_gap(const VectorXd& frequency, const FrequencySet& set) {
  const double f = frequency[set.first];
  const Index end = set.first + set.count;
  double gap = std::numeric_limits<double>::infinity();
  if (set.first > 0) gap = f - frequency[set.first - 1];
  if (end < frequency.size()) gap = std::min(gap, frequency[end] - f);
  return f > 0 ? gap / f : gap;
}

/// Computes the derivatives of one set of repeated frequencies by every parameter p for which
/// designs[p] is not empty. Stores the lowest `shown` derivatives of the set in `result`.
Outcome differentiate_set(const System& system, const ModalSolution& modes, const FrequencySet& set,
                          Index shown, const std::vector<std::optional<SeededDesign>>& designs,
                          FrequencySensitivity& result) {
  const double omega = 2 * std::numbers::pi * modes.frequency[set.first];
  const MatrixXd U = system.T * modes.shape.middleCols(set.first, set.count);
  const SetDerivative derivative(system, U, omega * omega);
  for (Index p = 0; p < std::ssize(designs); ++p) {
    const auto& design = designs[to_size(p)];
    if (!design) continue;
    const MatrixXd small = derivative.evaluate(*design);
    result.counters.element_evaluations += 2 * std::ssize(system.mesh.frame);
    if (!small.allFinite())
      return {Status::singular,
              "a limb is straight or folded: the limb angles and the frequencies change "
              "infinitely fast with the link lengths"};
    const SymmetricEigenpairs rates = symmetric_eigenpairs(small);
    if (!rates.converged)
      return {Status::not_converged, "the derivatives of repeated frequencies did not converge"};
    result.derivative.col(p).segment(set.first, shown) =
        rates.value.head(shown) / (4 * std::numbers::pi * omega);
  }
  return {};
}

}  // namespace

std::vector<FrequencySet> equal_frequencies(const Eigen::VectorXd& frequency) {
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

FrequencySensitivity frequency_sensitivity(const ManipulatorDesign& design, const Pose& pose,
                                           const std::vector<DesignParameter>& parameters,
                                           Index count) {
  const System system = assemble(build_manipulator(design, pose));
  const Posture posture = inverse_kinematics(design.geometry, pose);
  const ModalSolution modes = modes_in_complete_sets(system, count);
  FrequencySensitivity result;
  result.outcome = modes.outcome;
  result.evidence = modes.evidence;
  result.counters = modes.counters;
  const Index kept = std::min(count, modes.frequency.size());
  result.frequency = modes.frequency.head(kept);
  result.derivative = MatrixXd::Constant(kept, std::ssize(parameters), kNaN);
  result.gap = VectorXd::Constant(kept, std::numeric_limits<double>::infinity());
  if (!modes.outcome.solved()) return result;

  std::vector<std::optional<SeededDesign>> designs(parameters.size());
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (has_exact_derivative(parameters[p].kind))
      designs[p] = seed_design_derivatives(design, posture, parameters[p]);
  }
  for (const FrequencySet& set : equal_frequencies(modes.frequency)) {
    if (set.first >= kept) break;
    const Index shown = std::min(set.count, kept - set.first);
    result.sets.push_back({set.first, shown});
    result.gap.segment(set.first, shown).setConstant(relative_gap(modes.frequency, set));
    if (modes.frequency[set.first] == 0) {
      result.derivative.middleRows(set.first, shown).setZero();
      continue;
    }
    result.outcome = differentiate_set(system, modes, set, shown, designs, result);
    if (!result.outcome.solved()) {
      result.derivative.setConstant(kNaN);
      return result;
    }
  }
  return result;
}

}  // namespace trammel::solver
