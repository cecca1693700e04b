#include "solver/manipulator/moving_element.h"

#include <algorithm>
#include <cmath>

#include "solver/linear/element_operators.h"
#include "solver/model/model.h"
#include "solver/model/quadrature.h"

namespace trammel::solver {

Vector2d PartMotion::rotated_derivative(const Vector2d& at_start, int order) const {
  const Vector2d now = rotated(at_start, angle);
  if (order == 0) return now;
  if (order == 1) return rate * perpendicular(now);
  return acceleration * perpendicular(now) - rate * rate * now;
}

NominalMotion nominal_motion(const Model& model, const InverseDynamics& dynamics,
                             const Vector9d& from, const TrajectoryPoint& point,
                             const Vector2d& gravity) {
  const auto part = [&](Index i) {
    return PartMotion{dynamics.q[i] - from[i], dynamics.q_dot[i], dynamics.q_ddot[i]};
  };
  NominalMotion motion;
  motion.gravity = gravity;
  for (Index limb = 0; limb < 3; ++limb) {
    motion.part.push_back(part(limb));
    motion.part.push_back(part(3 + limb));
  }
  motion.part.resize(to_size(body_part_index(model, std::ssize(model.rigid_bodies))), part(8));
  for (Eigen::MatrixX2d& values : motion.node) values.resize(std::ssize(model.nodes), 2);
  using Carrier = std::array<Vector2d, 3>;
  const auto place = [&](Index node, const Vector2d& start, const Carrier& carrier,
                         const PartMotion& turns) {
    const Vector2d arm = model.nodes[to_size(node)].position - start;
    for (int order = 0; order < 3; ++order)
      motion.node[to_size(order)].row(node) =
          carrier[to_size(order)] + turns.rotated_derivative(arm, order);
  };
  for (Index limb = 0; limb < 3; ++limb) {
    const Vector2d& A = model.nodes[to_size(limb)].position;
    for (const Index node : {limb, 3 + limb})
      place(node, A, {A, Vector2d::Zero(), Vector2d::Zero()}, motion.part[to_size(2 * limb)]);
  }
  // The nodes C1 C2 C3, P and the nodes of the plate rotate with the platform.
  const Carrier P = {point.pose.position(), point.velocity.head<2>(), point.acceleration.head<2>()};
  for (Index node = 6; node < std::ssize(model.nodes); ++node)
    place(node, from.segment<2>(6), P, motion.part.back());
  return motion;
}

double largest_angular_velocity(const NominalMotion& motion) {
  double largest = 0;
  for (const PartMotion& part : motion.part) largest = std::max(largest, std::abs(part.rate));
  return largest;
}

namespace {

/// Returns J = dR/dangle R^-1 of the rotation matrix R about the z axis.
const Eigen::Matrix3d& rotation_generator() {
  static const Eigen::Matrix3d J = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 0).finished();
  return J;
}

/// Adds one integration point of int rho N^T X and int rho N^T (J X - X J6), in element axes. N is
/// the interpolation of an element and W = R N R6^T the interpolation in world axes. R rotates a
/// vector (x, y, rotation) by the angle of the element, and R6 contains R for both nodes. J is
/// dR/dangle R^-1, and J6 contains J for both nodes. X = J N - N J6 is the derivative of W with
/// respect to the angle at R = I. The weights are rho times (1, 1, radius of gyration squared),
/// times the length of the integration point.
void add_derivatives(const Eigen::Matrix<double, 3, 6>& N, const Vector3d& weights,
                     MovingElement& element) {
  Matrix6d J6 = Matrix6d::Zero();
  J6.topLeftCorner<3, 3>() = J6.bottomRightCorner<3, 3>() = rotation_generator();
  const Eigen::Matrix<double, 3, 6> X = rotation_generator() * N - N * J6;
  const Eigen::Matrix<double, 3, 6> Y = rotation_generator() * X - X * J6;
  element.first_derivative += N.transpose() * weights.asDiagonal() * X;
  element.second_derivative += N.transpose() * weights.asDiagonal() * Y;
}

MovingElement frame_element(const FrameElement& e, const Member& member) {
  MovingElement element;
  element.coordinates = e.coordinates;
  element.part = e.member;
  element.axis = e.direction;
  element.B = frame_deformation_matrix(Vector2d(Vector2d::UnitX()), e.length);
  element.c = frame_deformation_stiffness(e.section, member.theory, e.length);
  if (!member.axially_flexible) element.c[0] = 0;
  element.m = e.is_bar() ? bar_mass(e.section, member.mass, e.length)
                         : frame_mass(e.section, member.theory, member.mass, e.length);
  // Bars and lumped masses have an isotropic interpolation, which is equal in element axes and
  // world axes.
  if (e.is_bar() || member.mass == MassMatrix::lumped) return element;
  const double phi = shear_ratio(e.section, member.theory, e.length);
  const double rotary = has_rotary_inertia(member.theory) ? e.section.inertia_per_length : 0.0;
  for (const LineQuadraturePoint& point : line_quadrature()) {
    const double w = point.weight * e.length;
    add_derivatives(frame_interpolation(phi, e.length, point.xi),
                    w * Vector3d(e.section.mass_per_length, e.section.mass_per_length, rotary),
                    element);
  }
  return element;
}

void add_triangles(const System& system, std::vector<MovingElement>& elements) {
  for (const Triangle& triangle : system.model.triangles) {
    MovingElement element;
    element.layout = MovingElement::Layout::triangle;
    element.part = plate_part_index(system.model, triangle.plate);
    if (triangle.quadratic())
      throw ModelError("six-node triangles are not supported in a moving manipulator");
    const TrianglePoints points = triangle_nodes<3>(system.model, triangle);
    element.coordinates = system.coordinates.triangle_dofs<6>(triangle);
    const Plate& plate = system.model.plates[to_size(triangle.plate)];
    const TriangleStiffness<3> k = triangle_stiffness(points, plate);
    element.B = k.B;
    element.c = k.c;
    // The interpolation of triangles is isotropic: W does not depend on the rotation.
    element.m = triangle_mass(points, plate);
    elements.push_back(element);
  }
}

void add_point_masses(const System& system, std::vector<MovingElement>& elements) {
  const Model& model = system.model;
  for (const PointMass& point_mass : model.masses) {
    MovingElement element;
    element.layout = MovingElement::Layout::point_mass;
    const auto& node = system.coordinates.node[to_size(point_mass.node)];
    std::copy(node.begin(), node.end(), element.coordinates.begin());
    for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
      const RigidBody& body = model.rigid_bodies[b];
      if (body.reference == point_mass.node ||
          std::ranges::count(body.attached, point_mass.node) > 0)
        element.part = body_part_index(model, static_cast<Index>(b));
    }
    element.m.topLeftCorner<3, 3>() =
        point_mass_matrix(point_mass.mass, point_mass.inertia, point_mass.offset);
    element.first_moment = point_mass.mass * point_mass.offset;
    Eigen::Matrix<double, 3, 6> N = Eigen::Matrix<double, 3, 6>::Zero();
    N(0, 0) = N(1, 1) = N(2, 2) = 1;
    N(0, 2) = -point_mass.offset.y();
    N(1, 2) = point_mass.offset.x();
    add_derivatives(N, {point_mass.mass, point_mass.mass, point_mass.inertia}, element);
    elements.push_back(element);
  }
}

void add_scalar_elements(const System& system, std::vector<MovingElement>& elements) {
  const Model& model = system.model;
  MovingElement scalar;
  scalar.layout = MovingElement::Layout::scalar;
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double inertia = model.members[i].ends[end].inertia;
      if (inertia == 0) continue;
      MovingElement& element = elements.emplace_back(scalar);
      element.coordinates[0] = system.coordinates.member_end[i][end];
      element.part = static_cast<Index>(i);
      element.m(0, 0) = inertia;
    }
  }
  for (const SpringElement& spring : system.springs) {
    MovingElement& element = elements.emplace_back(scalar);
    std::copy(spring.coordinates.begin(), spring.coordinates.end(), element.coordinates.begin());
    element.B.topLeftCorner<1, 2>() << -1, 1;
    element.c[0] = spring.stiffness;
  }
}

}  // namespace

Vector2d MovingElement::axis_direction(const NominalMotion& nominal) const {
  const double angle = part_motion(nominal).angle;
  return angle == 0 ? axis : rotated(axis, angle);
}

Matrix6d MovingElement::matrix_in_world_axes(const Matrix6d& A, const Vector2d& direction) const {
  Matrix6d turned = A;
  to_world(turned, direction);
  turned.transposeInPlace();
  to_world(turned, direction);
  return turned.transpose();
}

std::vector<MovingElement> moving_elements(const System& system,
                                           const std::vector<LinkSuperelement>& links) {
  std::vector<MovingElement> elements;
  for (const FrameElement& e : system.mesh.frame) {
    elements.push_back(frame_element(e, system.model.members[to_size(e.member)]));
    if (!links.empty()) elements.back().m = links[to_size(e.member)].m;
  }
  add_triangles(system, elements);
  add_point_masses(system, elements);
  add_scalar_elements(system, elements);
  for (MovingElement& element : elements)
    element.k = element.B.transpose() * element.c.asDiagonal() * element.B;
  return elements;
}

}  // namespace trammel::solver
