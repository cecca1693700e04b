#include "references/frames/dynamic_stiffness.h"

#include <cmath>

namespace trammel::references {

namespace {

/// Negative pivots and log |det| of a symmetric matrix, by L D L^T without interchanges: fifty
/// digits leave room for the growth that a small pivot brings.
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
    RealMatrix world(6, coordinates.free()), axes = RealMatrix::Identity(6, 6);
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
  RealMatrix K = RealMatrix::Zero(coordinates.size(), coordinates.size());
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
  RealMatrix M = RealMatrix::Zero(coordinates.size(), coordinates.size());
  for (const FrameMass& mass : frame.masses) {
    const int x = coordinates.node_index(mass.node, 0);
    const int y = coordinates.node_index(mass.node, 1);
    const int r = coordinates.node_index(mass.node, 2);
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
      const int r = coordinates.end_index(static_cast<int>(e), end);
      M(r, r) += frame.members[e].ends[end].inertia;
    }
  }
  inertia_ = (coordinates.N().transpose() * M * coordinates.N()).cast<T>();
}

template <class T>
typename DynamicStiffness<T>::Count DynamicStiffness<T>::count(const T& w,
                                                               const T& load_factor) const {
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
