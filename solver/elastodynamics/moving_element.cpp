#include "solver/elastodynamics/moving_element.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/element_mass.h"
#include "solver/assembly/inertia.h"
#include "solver/assembly/strain.h"
#include "solver/model/quadrature.h"

namespace trammel::solver {

namespace {

/// d/dangle of a rotation, times its inverse.
const Eigen::Matrix3d& generator() {
  static const Eigen::Matrix3d J = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 0).finished();
  return J;
}

/// The same on the coordinates of a frame element or, top left, of a node.
Matrix6d generator6() {
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = J.bottomRightCorner<3, 3>() = generator();
  return J;
}

struct RotationDerivatives {
  Matrix6d first = Matrix6d::Zero(), second = Matrix6d::Zero();

  /// Adds int rho N^T X and int rho N^T (J X - X J6), with X = J N - N J6 the derivative of
  /// W = R N R6^T; weights are rho times (1, 1, radius of gyration squared).
  void add(const Eigen::Matrix<double, 3, 6>& N, const Vector3d& weights) {
    const Matrix6d J6 = generator6();
    const Eigen::Matrix<double, 3, 6> X = generator() * N - N * J6;
    const Eigen::Matrix<double, 3, 6> Y = generator() * X - X * J6;
    first += N.transpose() * weights.asDiagonal() * X;
    second += N.transpose() * weights.asDiagonal() * Y;
  }
};

RotationDerivatives rotation_derivatives(const FrameElement& e, const Member& member) {
  RotationDerivatives result;
  if (e.is_bar() || member.mass == MassMatrix::lumped) return result;  // W does not turn
  const double phi = shear_ratio(e.section, member.theory, e.length);
  const double rotary = has_rotary_inertia(member.theory) ? e.section.inertia_per_length : 0.0;
  const Matrix6d T = frame_rotation(e.direction);
  for (const LineQuadraturePoint& point : line_quadrature()) {
    const double w = point.weight * e.length;
    const Eigen::Matrix<double, 3, 6> N =
        T.topLeftCorner<3, 3>().transpose() * frame_interpolation(phi, e.length, point.xi) * T;
    result.add(N, w * Vector3d(e.section.mass_per_length, e.section.mass_per_length, rotary));
  }
  return result;
}

void add_frames(const System& system, std::vector<MovingElement>& elements) {
  for (const FrameElement& e : system.mesh.frame) {
    const Member& member = system.model.members[static_cast<std::size_t>(e.member)];
    MovingElement element;
    element.coordinates = e.coordinates;
    element.part = &NominalMotion::member;
    element.part_index = static_cast<std::size_t>(e.member);
    Vector3d c = frame_rigidity(e.section, member.theory, e.length);
    if (!member.axially_flexible) c[0] = 0;
    const FrameDeformation B = frame_deformation_matrix(e.direction, e.length);
    element.k = B.transpose() * c.asDiagonal() * B;
    element.m = world_mass(e, member);
    const RotationDerivatives derivatives = rotation_derivatives(e, member);
    element.first_derivative = derivatives.first;
    element.second_derivative = derivatives.second;
    elements.push_back(element);
  }
}

void add_triangles(const System& system, std::vector<MovingElement>& elements) {
  for (const Triangle& triangle : system.model.triangles) {
    MovingElement element;
    element.layout = MovingElement::Layout::triangle;
    element.part = &NominalMotion::plate;
    element.part_index = static_cast<std::size_t>(triangle.plate);
    if (triangle.quadratic()) throw ModelError("triangles of six nodes do not move yet");
    const TrianglePoints points = corners(system.model, triangle);
    element.coordinates = system.coordinates.of_triangle<6>(triangle);
    const Plate& plate = system.model.plates[element.part_index];
    const TriangleStiffness<3> k = triangle_stiffness(points, plate);
    element.k = k.B.transpose() * k.c.asDiagonal() * k.B;
    element.m = triangle_mass(points, plate);  // the interpolation is isotropic: W does not turn
    elements.push_back(element);
  }
}

bool holds(const RigidBody& body, Index node) {
  return body.reference == node || std::count(body.attached.begin(), body.attached.end(), node) > 0;
}

void add_point_masses(const System& system, std::vector<MovingElement>& elements) {
  const Model& model = system.model;
  for (const PointMass& point_mass : model.masses) {
    MovingElement element;
    element.layout = MovingElement::Layout::point_mass;
    const auto& node = system.coordinates.node[static_cast<std::size_t>(point_mass.node)];
    std::copy(node.begin(), node.end(), element.coordinates.begin());
    for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
      if (!holds(model.rigid_bodies[b], point_mass.node)) continue;
      element.part = &NominalMotion::rigid_body;
      element.part_index = b;
    }
    element.m.topLeftCorner<3, 3>() =
        point_inertia(point_mass.mass, point_mass.inertia, point_mass.offset);
    element.first_moment = point_mass.mass * point_mass.offset;
    Eigen::Matrix<double, 3, 6> N = Eigen::Matrix<double, 3, 6>::Zero();
    N(0, 0) = N(1, 1) = N(2, 2) = 1;
    N(0, 2) = -point_mass.offset.y();
    N(1, 2) = point_mass.offset.x();
    RotationDerivatives derivatives;
    derivatives.add(N, {point_mass.mass, point_mass.mass, point_mass.inertia});
    element.first_derivative = derivatives.first;
    element.second_derivative = derivatives.second;
    elements.push_back(element);
  }
}

void add_springs(const System& system, std::vector<MovingElement>& elements) {
  const Model& model = system.model;
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double inertia = model.members[i].ends[end].inertia;
      if (inertia == 0) continue;
      MovingElement element;
      element.layout = MovingElement::Layout::scalar;
      element.coordinates[0] = system.coordinates.member_end[i][end];
      element.part = &NominalMotion::member;
      element.part_index = i;
      element.m(0, 0) = inertia;
      elements.push_back(element);
    }
  }
  for (const SpringElement& spring : system.springs) {
    MovingElement element;
    element.layout = MovingElement::Layout::scalar;
    element.coordinates[0] = spring.coordinates[0];
    element.coordinates[1] = spring.coordinates[1];
    element.k(0, 0) = element.k(1, 1) = spring.stiffness;
    element.k(0, 1) = element.k(1, 0) = -spring.stiffness;
    elements.push_back(element);
  }
}

}  // namespace

Matrix6d MovingElement::rotated(const Matrix6d& A, double angle) const {
  if (angle == 0 || layout == Layout::scalar) return A;
  Matrix6d B = A;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (Index i = 0; i + 1 < 6; i += stride()) {
    const Eigen::Matrix<double, 1, 6> x = c * B.row(i) - s * B.row(i + 1);
    B.row(i + 1) = s * B.row(i) + c * B.row(i + 1);
    B.row(i) = x;
  }
  for (Index i = 0; i + 1 < 6; i += stride()) {
    const Vector6d x = c * B.col(i) - s * B.col(i + 1);
    B.col(i + 1) = s * B.col(i) + c * B.col(i + 1);
    B.col(i) = x;
  }
  return B;
}

std::vector<MovingElement> moving_elements(const System& system) {
  std::vector<MovingElement> elements;
  add_frames(system, elements);
  add_triangles(system, elements);
  add_point_masses(system, elements);
  add_springs(system, elements);
  return elements;
}

}  // namespace trammel::solver
