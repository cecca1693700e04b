#include "solver/large/triangle.h"

#include "solver/elements/triangle_element.h"

namespace trammel::solver::large_motion {

template <int Nodes>
Triangle2d<Nodes>::Triangle2d(const Model& model, const Triangle& triangle) {
  const Plate& plate = model.plates[static_cast<std::size_t>(triangle.plate)];
  const double E = plate.material.E, nu = plate.material.nu;
  D_ << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  D_ *= E / (1 - nu * nu);
  // With three nodes, one integration point at the center is exact for polynomials of degree 1.
  // With six nodes, three integration points are exact for degree 2.
  const auto count = static_cast<double>(points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Vector3d area_coordinates = Vector3d::Constant(Nodes == 3 ? 1.0 / 3 : 1.0 / 6);
    if (Nodes == 6) area_coordinates[static_cast<Index>(p)] = 2.0 / 3;
    const TriangleInterpolation at = evaluate_shape_functions(model, triangle, area_coordinates);
    if (!(at.area > 0)) throw ModelError("a triangle has no area");
    points_[p] = {at.gradient.template leftCols<Nodes>(), plate.thickness * at.area / count};
  }
  mass_ = triangle_mass(triangle_nodes<Nodes>(model, triangle), plate);
}

template <int Nodes>
Eigen::Matrix2d Triangle2d<Nodes>::Point::displacement_gradient(const Coordinates& q) const {
  return Eigen::Map<const Gradients>(q.data()) * gradients.transpose();
}

template <int Nodes>
typename Triangle2d<Nodes>::Strain Triangle2d<Nodes>::strain(const Eigen::Matrix2d& H) {
  return {H(0, 0) + H.col(0).squaredNorm() / 2, H(1, 1) + H.col(1).squaredNorm() / 2,
          H(0, 1) + H(1, 0) + H.col(0).dot(H.col(1))};
}

template <int Nodes>
typename Triangle2d<Nodes>::Operator Triangle2d<Nodes>::Point::strain_displacement_matrix(
    const Eigen::Matrix2d& H) const {
  const Eigen::Matrix2d F = Eigen::Matrix2d::Identity() + H;
  Operator B;
  for (int a = 0; a < Nodes; ++a) {
    B.template block<1, 2>(0, 2 * a) = gradients(0, a) * F.col(0).transpose();
    B.template block<1, 2>(1, 2 * a) = gradients(1, a) * F.col(1).transpose();
    B.template block<1, 2>(2, 2 * a) =
        gradients(1, a) * F.col(0).transpose() + gradients(0, a) * F.col(1).transpose();
  }
  return B;
}

template <int Nodes>
double Triangle2d<Nodes>::energy(const Coordinates& q) const {
  double sum = 0;
  for (const Point& point : points_) {
    const Strain e = strain(point.displacement_gradient(q));
    sum += point.volume / 2 * e.dot(D_ * e);
  }
  return sum;
}

template <int Nodes>
typename Triangle2d<Nodes>::Coordinates Triangle2d<Nodes>::forces(const Coordinates& q,
                                                                  const Coordinates& v,
                                                                  double tau) const {
  Coordinates f = Coordinates::Zero();
  for (const Point& point : points_) {
    const Eigen::Matrix2d H = point.displacement_gradient(q);
    const Operator B = point.strain_displacement_matrix(H);
    Strain e = strain(H);
    if (tau != 0) e += tau * (B * v);
    f += point.volume * B.transpose() * (D_ * e);
  }
  return f;
}

template <int Nodes>
typename Triangle2d<Nodes>::Square Triangle2d<Nodes>::tangent(const Coordinates& q,
                                                              double stiffness_factor,
                                                              double damping) const {
  Square K = Square::Zero();
  for (const Point& point : points_) {
    const Eigen::Matrix2d H = point.displacement_gradient(q);
    const Operator B = point.strain_displacement_matrix(H);
    const Strain s = D_ * strain(H);
    K += (stiffness_factor + damping) * point.volume * B.transpose() * D_ * B;
    Eigen::Matrix2d S;
    S << s[0], s[2], s[2], s[1];
    const Eigen::Matrix<double, Nodes, Nodes> geometric =
        stiffness_factor * point.volume * point.gradients.transpose() * S * point.gradients;
    for (const int k : {0, 1}) {
      const auto along = Eigen::seqN(k, Eigen::fix<Nodes>, Eigen::fix<2>);
      K(along, along) += geometric;
    }
  }
  return K;
}

template <int Nodes>
typename Triangle2d<Nodes>::Coordinates Triangle2d<Nodes>::discrete_gradient_forces(
    const Coordinates& q0, const Coordinates& q1, double damping_over_step) const {
  Coordinates f = Coordinates::Zero();
  for (const Point& point : points_) {
    const Eigen::Matrix2d H0 = point.displacement_gradient(q0);
    const Eigen::Matrix2d H1 = point.displacement_gradient(q1);
    const Strain e0 = strain(H0), e1 = strain(H1);
    const Operator B = point.strain_displacement_matrix((H0 + H1) / 2);
    f += point.volume * B.transpose() * (D_ * ((e0 + e1) / 2 + damping_over_step * (e1 - e0)));
  }
  return f;
}

template class Triangle2d<3>;
template class Triangle2d<6>;

}  // namespace trammel::solver::large_motion
