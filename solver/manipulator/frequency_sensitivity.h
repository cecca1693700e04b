#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/linear/modes.h"
#include "solver/manipulator/manipulator.h"

namespace trammel::solver {

/// A number of the design or its pose, or several that change together by the same amount.
struct DesignParameter {
  enum class Kind {
    length,
    thickness,
    width,
    E,
    density,
    poisson_ratio,             ///< of links and platform
    base_side,                 ///< A1-A2; the base grows about A1
    platform_side,             ///< C1-C2; the platform grows about P
    platform_mass,             ///< as if printed; a printed inertia stays
    platform_inertia,          ///< about P, as if printed; of a rigid platform
    active_stiffness,          ///< of the springs at A
    elbow_stiffness,           ///< at B
    platform_joint_stiffness,  ///< at C
    orientation                ///< phi of the pose
  };
  Kind kind = Kind::length;
  std::array<bool, 3> proximal{true, true, true};
  std::array<bool, 3> distal{true, true, true};
  bool platform = false;  ///< its thickness, E, density or Poisson's ratio too
};

/// Returns true for parameters of which sections and links have exact derivatives: lengths,
/// thickness, width, E and density.
[[nodiscard]] inline bool is_seeded(DesignParameter::Kind kind) {
  return kind <= DesignParameter::Kind::density;
}

namespace detail {

/// The number of a part that the parameter names, or null.
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

template <class T>
[[nodiscard]] T* link_number(LinkDesignOf<T>& link, DesignParameter::Kind kind) {
  return kind == DesignParameter::Kind::width ? &link.width : number(link, kind);
}

}  // namespace detail

// How the natural frequencies of the manipulator change with its design (paper Eq. 30-35):
//   d f / dp = (1 / 8 pi^2 f) x^T (dK/dp - (2 pi f)^2 dM/dp) x,   x^T M x = 1,
// with the pose held, so that the joint angles move with the link lengths. dK/dp and dM/dp are
// exact: dual numbers (numbers.h) through the functions that the builder and the elements are made
// of; for other parameters than those of sections and links (`is_seeded`) they are NaN. Whether a
// link's mass is held as a total or follows from its density is the design's choice.

/// Modes whose frequencies are equal but for round-off. Their shapes are an arbitrary basis of
/// their subspace; what has a meaning are the derivatives of the set.
struct FrequencySet {
  Index first = 0;
  Index count = 1;
};

/// @param frequency  ascending [Hz].
[[nodiscard]] std::vector<FrequencySet> equal_frequencies(const Eigen::VectorXd& frequency);

struct FrequencySensitivity {
  /// singular: a limb is straight or folded and the derivative infinite; not_converged: as the
  /// modes.
  Outcome outcome;
  Evidence evidence;          ///< of the modes
  Eigen::VectorXd frequency;  ///< ascending [Hz]
  /// mode x parameter [Hz / unit of the parameter]. Within a set of repeated frequencies: the
  /// directional derivatives, eigenvalues of X^T (dK/dp - w^2 dM/dp) X over the set, ascending, as
  /// the frequencies order themselves when p grows. 0 for rigid motions.
  Eigen::MatrixXd derivative;
  std::vector<FrequencySet> sets;
  /// Distance of each mode's frequency from the nearest one outside its set, over its own: the
  /// derivative loses about as many digits as this is small.
  Eigen::VectorXd gap;
  Counters counters;
};

/// @param count  modes; of a set that goes on beyond, the lowest derivatives are returned.
/// @throws ModelError  as `build_manipulator`.
[[nodiscard]] FrequencySensitivity frequency_sensitivity(
    const ManipulatorDesign& design, const Pose& pose,
    const std::vector<DesignParameter>& parameters, Index count);

}  // namespace trammel::solver
