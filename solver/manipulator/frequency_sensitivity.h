#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/linear/modes.h"
#include "solver/manipulator/manipulator.h"

namespace trammel::solver {

/// Parameter of the design or the pose. It may refer to several lengths or properties, which change
/// by the same amount.
struct DesignParameter {
  enum class Kind {
    length,
    thickness,
    width,
    E,
    density,
    poisson_ratio,             ///< of links and platform
    base_side,                 ///< A1-A2; the base is scaled about A1
    platform_side,             ///< C1-C2; the platform is scaled about P
    platform_mass,             ///< changed like a printed mass; a printed inertia is unchanged
    platform_inertia,          ///< about P, changed like a printed inertia; rigid platform only
    active_stiffness,          ///< of the springs at A
    elbow_stiffness,           ///< of the springs at B
    platform_joint_stiffness,  ///< of the springs at C
    orientation                ///< phi of the pose
  };
  Kind kind = Kind::length;
  std::array<bool, 3> proximal{true, true, true};
  std::array<bool, 3> distal{true, true, true};
  bool platform = false;  ///< true: also thickness, E, density or Poisson's ratio of the platform
};

/// Returns true for parameters with exact derivatives of sections and links: lengths, thickness,
/// width, E and density.
[[nodiscard]] inline bool is_seeded(DesignParameter::Kind kind) {
  return kind <= DesignParameter::Kind::density;
}

namespace detail {

/// Returns the property of a link or platform to which the parameter refers, or null.
template <class Part>
[[nodiscard]] auto number(Part& part, DesignParameter::Kind kind) -> decltype(&part.thickness) {
  switch (kind) {
    case DesignParameter::Kind::thickness:
      return &part.thickness;
    case DesignParameter::Kind::E:
      return &part.material.E;
    case DesignParameter::Kind::density:
      return &part.material.rho;
    case DesignParameter::Kind::poisson_ratio:
      return &part.material.nu;
    default:
      return nullptr;
  }
}

/// Returns the property of a link to which the parameter refers, or null.
template <class T>
[[nodiscard]] T* link_number(LinkDesignOf<T>& link, DesignParameter::Kind kind) {
  return kind == DesignParameter::Kind::width ? &link.width : number(link, kind);
}

}  // namespace detail

// Derivatives of the natural frequencies of the manipulator with respect to its design (paper Eq.
// 30-35): //
//   d f / dp = (1 / 8 pi^2 f) x^T (dK/dp - (2 pi f)^2 dM/dp) x,   x^T M x = 1.
//
// The pose is fixed, so that the joint angles change with the link lengths. dK/dp and dM/dp are
// exact: dual numbers (numbers.h) pass through the functions of the builder and the elements. They
// are NaN for parameters other than those of sections and links (`is_seeded`). The design
// determines whether the mass of a link is a fixed total or follows from its density.

/// Set of modes whose frequencies are equal up to round-off. Their shapes are an arbitrary basis of
/// a subspace. Only the derivatives of all modes of the set together are meaningful.
struct FrequencySet {
  Index first = 0;
  Index count = 1;
};

/// Groups equal frequencies.
/// @param frequency  ascending [Hz].
[[nodiscard]] std::vector<FrequencySet> equal_frequencies(const Eigen::VectorXd& frequency);

/// Frequencies and their derivatives.
struct FrequencySensitivity {
  /// singular: a limb is straight or folded, and the derivative is infinite; not_converged: as the
  /// modes.
  Outcome outcome;
  Evidence evidence;          ///< residuals of the modes
  Eigen::VectorXd frequency;  ///< ascending [Hz]
  /// Derivatives, mode x parameter [Hz / unit of the parameter]. For a set of repeated frequencies
  /// they are directional derivatives: the eigenvalues of X^T (dK/dp - w^2 dM/dp) X over the set,
  /// ascending. This is the order of the frequencies if p increases. Rigid modes have 0.
  Eigen::MatrixXd derivative;
  std::vector<FrequencySet> sets;
  /// Distance of each frequency from the nearest one outside its set, relative to the frequency
  /// [-]. A small gap g costs about -log10(g) digits of the derivative.
  Eigen::VectorXd gap;
  Counters counters;
};

/// Computes the lowest frequencies and their derivatives.
/// @param design  manipulator.
/// @param pose  pose of the platform.
/// @param parameters  parameters of the design.
/// @param count  number of modes; if a set continues beyond, its lowest derivatives are returned.
/// @throws ModelError  as `build_manipulator`.
[[nodiscard]] FrequencySensitivity frequency_sensitivity(
    const ManipulatorDesign& design, const Pose& pose,
    const std::vector<DesignParameter>& parameters, Index count);

}  // namespace trammel::solver
