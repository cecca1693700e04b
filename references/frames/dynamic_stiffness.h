#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "references/frames/frame.h"
#include "references/frames/frame_coordinates.h"
#include "references/numerics/ball.h"
#include "references/numerics/dense.h"

/// Dynamic stiffness matrix D(w) of a frame in its free coordinates, and the Wittrick-Williams
/// count J(w) of its natural frequencies below w (W. H. Wittrick, F. W. Williams, Q. J. Mech. Appl.
/// Math. 24, 1971, 263-284). J0(w) is the number of frequencies below w of the members with clamped
/// ends, and s is the number of negative pivots of D:
///
///   J(w) = J0(w) + s(D(w)).
namespace trammel::references {

/// Properties of a member as numbers of type T (double, Real or Ball), for the Wittrick-Williams
/// count in this number type.
template <class T>
struct MemberData {
  explicit MemberData(const FrameSection& s, const Real& L)
      : length(static_cast<T>(L)),
        axial_compliance(static_cast<T>(s.axial_compliance)),
        EI(static_cast<T>(s.EI)),
        shear_compliance(static_cast<T>(s.shear_compliance)),
        mass(static_cast<T>(s.mass)),
        rotary_inertia(static_cast<T>(s.rotary_inertia)),
        tension(static_cast<T>(s.tension)) {}
  T length, axial_compliance, EI, shear_compliance, mass, rotary_inertia, tension;
};

template <class T>
class DynamicStiffness {
 public:
  /// Prepares the dynamic stiffness matrix of a frame for any frequency.
  /// @throws DerivationError  if a member has the length 0.
  explicit DynamicStiffness(const Frame& frame);

  struct Count {
    int below = 0;          ///< J, number of natural frequencies below w
    int clamped_below = 0;  ///< J0
    T log_determinant = 0;  ///< log |det D|
  };
  /// Returns the Wittrick-Williams counts J and J0 at a frequency, and log |det D|.
  /// @param w  circular frequency > 0 [rad/s]
  /// @param load_factor  factor of the tension of every member
  [[nodiscard]] Count wittrick_williams(const T& w, const T& load_factor = T(1)) const;

 private:
  struct TransformedMember {
    MemberData<T> data;
    Eigen::SparseMatrix<T> transformation;  ///< free coordinates to member-axis displacements
  };

  void transform_members(const Frame& frame, const FrameCoordinates& coordinates);
  void add_inertia(const Frame& frame, const FrameCoordinates& coordinates);
  void add_springs(const Frame& frame, const FrameCoordinates& coordinates);

  std::vector<TransformedMember> members_;
  Matrix<T> stiffness_;  ///< stiffness of springs
  Matrix<T> inertia_;    ///< inertia of point masses and member ends
};

extern template class DynamicStiffness<double>;
extern template class DynamicStiffness<Real>;
extern template class DynamicStiffness<Ball>;

}  // namespace trammel::references
