#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/linear/modes.h"
#include "solver/manipulator/manipulator.h"

namespace trammel::solver {

/// Parameter of the design or the pose, by which frequencies are differentiated. A parameter may
/// refer to a property of several links. This property then changes by the same amount in all these
/// links.
struct DesignParameter {
  enum class Kind {
    length,
    thickness,
    width,
    E,
    density,
    poisson_ratio,  ///< Poisson's ratio of links and platform
    base_side,      ///< length of the base side A1-A2; the base is scaled about A1
    platform_side,  ///< length of the platform side C1-C2; the platform is scaled about P
    /// Mass of the platform; an inertia of the platform that the design contains is not changed.
    platform_mass,
    /// Moment of inertia of a rigid platform about its reference point P.
    platform_inertia,
    active_stiffness,          ///< stiffness of the torsion springs at the active joints A
    elbow_stiffness,           ///< stiffness of the torsion springs at the elbow joints B
    platform_joint_stiffness,  ///< stiffness of the torsion springs at the platform joints C
    orientation                ///< orientation phi of the platform
  };
  Kind kind = Kind::length;
  std::array<bool, 3> proximal{true, true, true};
  std::array<bool, 3> distal{true, true, true};
  /// true: a parameter thickness, E, density or poisson_ratio also refers to the platform.
  bool platform = false;
};

/// Returns true for parameters with exact derivatives by dual numbers: lengths, thickness, width, E
/// and density.
[[nodiscard]] inline bool has_exact_derivative(DesignParameter::Kind kind) {
  return kind <= DesignParameter::Kind::density;
}

namespace detail {

/// Returns the property of a link or platform to which the parameter refers, or null if `part` has
/// no such property.
template <class Part>
[[nodiscard]] auto property(Part& part, DesignParameter::Kind kind) -> decltype(&part.thickness) {
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

/// Returns the property of a link to which the parameter refers, or null if a link has no such
/// property.
template <class T>
[[nodiscard]] T* link_property(LinkDesignOf<T>& link, DesignParameter::Kind kind) {
  return kind == DesignParameter::Kind::width ? &link.width : property(link, kind);
}

}  // namespace detail

// Derivatives of natural frequencies f (mode shapes x) by design parameters p (Varalakshmi &
// Srinivas 2017, Eq. 30-35):
//
//   d f / dp = (1 / 8 pi^2 f) x^T (dK/dp - (2 pi f)^2 dM/dp) x,   x^T M x = 1.
//
// The pose is fixed, so that the joint angles change with the link lengths. dK/dp and dM/dp are
// exact, because sections and elements are computed with dual numbers (numbers.h). Derivatives by
// parameters without dual numbers (`has_exact_derivative`) are NaN. The mass of a link follows from
// its density unless the design contains the mass of the link.

/// Set of modes whose frequencies are equal up to round-off errors. The mode shapes are an
/// arbitrary basis of a subspace. Only the derivatives of all modes of the set together are
/// meaningful.
struct FrequencySet {
  Index first = 0;
  Index count = 1;
};

/// Groups modes into sets of equal frequencies.
/// @param frequency  natural frequencies, ascending [Hz].
[[nodiscard]] std::vector<FrequencySet> equal_frequencies(const Eigen::VectorXd& frequency);

/// Natural frequencies of a manipulator and their derivatives by design parameters.
struct FrequencySensitivity {
  /// singular: a limb is straight or folded, and the derivative is infinite; not_converged: the
  /// modes or their derivatives did not converge.
  Outcome outcome;
  Evidence evidence;          ///< residuals of the modes
  Eigen::VectorXd frequency;  ///< natural frequencies, ascending [Hz]
  /// Derivatives of the frequencies, one row per mode and one column per parameter [Hz / unit of
  /// the parameter]. For a set of repeated frequencies, the rows contain directional derivatives:
  /// the ascending eigenvalues of X^T (dK/dp - w^2 dM/dp) X, over 8 pi^2 f, with the modes X of the
  /// set. This is the order of the frequencies for increasing p. Rigid modes have derivative 0.
  Eigen::MatrixXd derivative;
  std::vector<FrequencySet> sets;
  /// Relative gap of each frequency [-]: its difference from the nearest frequency outside its set,
  /// divided by the frequency. A small gap g reduces the accuracy of the derivative by about
  /// -log10(g) digits.
  Eigen::VectorXd gap;
  Counters counters;
};

/// Computes the `count` lowest frequencies and their derivatives. If a set of equal frequencies
/// continues beyond the mode number `count`, the lowest derivatives of the set are returned.
/// @throws ModelError  as `build_manipulator`.
[[nodiscard]] FrequencySensitivity frequency_sensitivity(
    const ManipulatorDesign& design, const Pose& pose,
    const std::vector<DesignParameter>& parameters, Index count);

}  // namespace trammel::solver
