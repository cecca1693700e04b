#include "references/frames/dynamic_stiffness.h"

#include <cmath>

/// Exact dynamic stiffness of one uniform member at circular frequency w, and the number of its
/// natural frequencies below w with both ends clamped. Sources: Wittrick and Williams 1971; for
/// shear and rotary inertia, Howson and Williams 1973.
///
/// Let g = w^2 rho A / (kappa G A) and r = w^2 rho I / EI; both are zero for Euler-Bernoulli. The
/// wave numbers of deflection v and rotation psi follow from
///
///   k^4 + (g + r - T/EI) k^2 + g r - w^2 rho A / EI = 0.
///
/// A prestressed Euler-Bernoulli member has the tension T, which adds T v' to the force V below.
/// Even and odd motions about mid-span decouple. C is cos(k x) or cosh(k x), and S is sin(k x) / k
/// or sinh(k x) / k, with x from mid-span. Even motions:
///
///   v = C,      psi = (k^2 + g) S,  M = EI (k^2 + g) C.
///   V = -(k^2 + g)(EI k^2 + w^2 rho I) S.
///
/// Odd motions:
///
///   v = k^2 S,  psi = (k^2 + g) C,  M = EI (k^2 + g) k^2 S.
///   V = -(k^2 + g)(EI k^2 + w^2 rho I) C.
///
/// Hyperbolic C and S are divided by cosh(k L/2), which avoids overflow.
namespace trammel::references {

namespace {

/// Dynamic stiffness of a member for motions even and odd about mid-span. It relates the forces (N,
/// V, M) at the right end to the displacements (u, v, psi) of this end.
template <class T>
struct MemberStiffness {
  Eigen::Matrix<T, 3, 3> even = Eigen::Matrix<T, 3, 3>::Zero(), odd = even;
  int clamped_below = 0;  ///< number of frequencies below w with clamped ends
};

/// Returns the number of integers n >= 1 with n pi / L < k, for the wave number k and the member
/// length L.
template <class T>
int waves_below(const T& k, const T& length) {
  using std::ceil;
  const T n = ceil(k * length / pi<T>()) - 1;
  return n > 0 ? static_cast<int>(n) : 0;
}

/// Returns the bending part of a member's dynamic stiffness at w^2, for motions even and odd about
/// mid-span, and the number of its frequencies below w with both ends clamped.
template <class T>
MemberStiffness<T> bending_stiffness(const MemberData<T>& m, const T& w2, const T& load_factor) {
  using std::sqrt;
  const T h = m.length / 2;
  const T g = w2 * m.mass * m.shear_compliance;
  const T r = w2 * m.rotary_inertia / m.EI;
  const T tension = load_factor * m.tension;
  const T p = (g + r - tension / m.EI) / 2;
  const T q = g * r - w2 * m.mass / m.EI;
  const T root = sqrt(p * p - q);
  // `below` and `above` are the two roots k^2 of the wave number equation. The root `below` is
  // negative, so that its solution oscillates along the beam. The root `above` is negative only
  // beyond the cut-on frequency of shear waves. The formulas avoid cancellation errors.
  const T below = p >= 0 ? T(-p - root) : T(q / (root - p));
  const T above = p >= 0 ? T(q / below) : T(root - p);
  // Displacements (v, psi) and forces (V, M) at the member's right end, for motions even and odd
  // about mid-span. The columns are the solutions with k^2 = `above` and k^2 = `below`.
  Eigen::Matrix<T, 2, 2> even_motion, even_force, odd_motion, odd_force;
  for (int i = 0; i < 2; ++i) {
    const T k2 = i == 0 ? above : below;
    const auto [C, S] = scaled_cosine_and_integral(k2, h);
    const T slope = k2 + g;
    const T shear = -slope * (m.EI * k2 + w2 * m.rotary_inertia) + tension * k2;
    even_motion(0, i) = C;
    even_motion(1, i) = slope * S;
    even_force(0, i) = shear * S;
    even_force(1, i) = m.EI * slope * C;
    odd_motion(0, i) = k2 * S;
    odd_motion(1, i) = slope * C;
    odd_force(0, i) = shear * C;
    odd_force(1, i) = m.EI * slope * k2 * S;
  }
  MemberStiffness<T> result;
  result.even.template bottomRightCorner<2, 2>() = even_force * even_motion.inverse();
  result.odd.template bottomRightCorner<2, 2>() = odd_force * odd_motion.inverse();
  // The number of frequencies below w with pinned ends follows from the wave numbers. Clamping the
  // rotations reduces it by the number of negative eigenvalues of the rotational stiffness.
  int pinned = waves_below(T(sqrt(-below)), m.length);
  if (above < 0) pinned += 1 + waves_below(T(sqrt(-above)), m.length);
  result.clamped_below = pinned - (result.even(2, 2) < 0 ? 1 : 0) - (result.odd(2, 2) < 0 ? 1 : 0);
  return result;
}

/// Returns the dynamic stiffness of a member for axial and bending motions.
/// @param w2  square of the circular frequency, > 0 [1/s^2].
/// @param load_factor  factor of the member's tension.
template <class T>
MemberStiffness<T> member_stiffness(const MemberData<T>& m, const T& w2, const T& load_factor) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T h = m.length / 2;
  MemberStiffness<T> result = bending_stiffness(m, w2, load_factor);
  if (m.axial_compliance == 0) {
    result.even(0, 0) = -w2 * m.mass * h;
    return result;
  }
  const T k = sqrt(w2 * m.mass * m.axial_compliance);
  const T c = cos(k * h);
  const T s = sin(k * h);
  result.odd(0, 0) = k * c / (s * m.axial_compliance);
  result.even(0, 0) = -k * s / (c * m.axial_compliance);
  result.clamped_below += waves_below(k, m.length);
  return result;
}

/// Returns the 6 x 6 dynamic stiffness of a member for (u1, v1, psi1, u2, v2, psi2) in its axes. In
/// an even motion u and v are equal at both ends, and psi has opposite signs.
template <class T>
Eigen::Matrix<T, 6, 6> member_matrix(const MemberStiffness<T>& s) {
  Eigen::Matrix<T, 6, 6> K;
  K << s.even + s.odd, s.even - s.odd, s.even - s.odd, s.even + s.odd;
  K.row(2) = -K.row(2);
  K.col(2) = -K.col(2);
  return K / T(2);
}

/// Returns the number of negative pivots and log |det| of a symmetric matrix, by L D L^T without
/// interchanges. Fifty digits tolerate the growth of round-off that a small pivot causes.
template <class T>
std::pair<int, T> matrix_inertia(Matrix<T>& D) {
  using std::abs;
  using std::log;
  const Eigen::Index n = D.rows();
  int negative = 0;
  T log_determinant = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const T pivot = D(k, k);
    negative += pivot < 0 ? 1 : 0;
    log_determinant += log(abs(pivot));
    for (Eigen::Index i = k + 1; i < n; ++i) {
      if (D(i, k) == 0) continue;
      const T factor = D(i, k) / pivot;
      for (Eigen::Index j = k + 1; j <= i; ++j) D(i, j) -= factor * D(j, k);
    }
  }
  return {negative, log_determinant};
}

}  // namespace

template <class T>
DynamicStiffness<T>::DynamicStiffness(const Frame& frame) {
  const FrameCoordinates coordinates(frame, true);
  transform_members(frame, coordinates);
  add_springs(frame, coordinates);
  add_inertia(frame, coordinates);
}

template <class T>
void DynamicStiffness<T>::transform_members(const Frame& frame,
                                            const FrameCoordinates& coordinates) {
  for (std::size_t e = 0; e < frame.members.size(); ++e) {
    const MemberAxis axis = member_axis(frame, frame.members[e]);
    RealMatrix world(6, coordinates.free_count()), axes = RealMatrix::Identity(6, 6);
    const auto u = coordinates.member_indices(static_cast<int>(e));
    for (int row = 0; row < 6; ++row) world.row(row) = coordinates.N().row(u[row]);
    for (const int end : {0, 3})
      axes.block<2, 2>(end, end) << axis.cosine, axis.sine, -axis.sine, axis.cosine;
    members_.push_back({MemberData<T>(frame.members[e].section, axis.length),
                        RealMatrix(axes * world).sparseView().template cast<T>()});
  }
}

template <class T>
void DynamicStiffness<T>::add_springs(const Frame& frame, const FrameCoordinates& coordinates) {
  RealMatrix K = RealMatrix::Zero(coordinates.coordinate_count(), coordinates.coordinate_count());
  for (const auto& [a, b, stiffness] : coordinates.springs(frame)) {
    K(b, b) += stiffness;
    if (a < 0) continue;
    K(a, a) += stiffness;
    K(a, b) -= stiffness;
    K(b, a) -= stiffness;
  }
  stiffness_ = (coordinates.N().transpose() * K * coordinates.N()).cast<T>();
}

template <class T>
void DynamicStiffness<T>::add_inertia(const Frame& frame, const FrameCoordinates& coordinates) {
  RealMatrix M = RealMatrix::Zero(coordinates.coordinate_count(), coordinates.coordinate_count());
  for (const FrameMass& mass : frame.masses) {
    const int x = coordinates.node_coordinate_index(mass.node, 0),
              y = coordinates.node_coordinate_index(mass.node, 1);
    const int r = coordinates.node_coordinate_index(mass.node, 2);
    M(x, x) += mass.mass;
    M(y, y) += mass.mass;
    if (r < 0) continue;
    const Real& dx = mass.offset[0];
    const Real& dy = mass.offset[1];
    M(r, r) += mass.inertia + mass.mass * (dx * dx + dy * dy);
    M(x, r) -= mass.mass * dy;
    M(r, x) -= mass.mass * dy;
    M(y, r) += mass.mass * dx;
    M(r, y) += mass.mass * dx;
  }
  for (std::size_t e = 0; e < frame.members.size(); ++e) {
    for (int end = 0; end < 2; ++end) {
      const int r = coordinates.end_rotation_index(static_cast<int>(e), end);
      M(r, r) += frame.members[e].ends[end].inertia;
    }
  }
  inertia_ = (coordinates.N().transpose() * M * coordinates.N()).cast<T>();
}

template <class T>
typename DynamicStiffness<T>::Count DynamicStiffness<T>::wittrick_williams(
    const T& w, const T& load_factor) const {
  const T w2 = w * w;
  Matrix<T> D = stiffness_ - w2 * inertia_;
  Count count;
  for (const TransformedMember& member : members_) {
    const MemberStiffness<T> stiffness = member_stiffness(member.data, w2, load_factor);
    count.clamped_below += stiffness.clamped_below;
    const Matrix<T> force = member_matrix(stiffness) * member.transformation;
    D += member.transformation.transpose() * force;
  }
  const auto [negative, log_determinant] = matrix_inertia(D);
  count.below = count.clamped_below + negative;
  count.log_determinant = log_determinant;
  return count;
}

template class DynamicStiffness<double>;
template class DynamicStiffness<Real>;
template class DynamicStiffness<Ball>;

}  // namespace trammel::references
