#include "solver/linear/fields.h"

#include <algorithm>
#include <map>
#include <utility>

#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/linear/element_operators.h"
#include "solver/model/quadrature.h"

namespace trammel::solver {

namespace {

void project(System& system) {
  system.f = system.T.transpose() * system.load;
}

using Side = std::pair<Index, Index>;

Side side_of(const Triangle& triangle, std::size_t k) {
  return std::minmax(triangle.nodes[k], triangle.nodes[(k + 1) % 3]);
}

std::map<Side, int> count_triangles_of_sides(const Model& model) {
  std::map<Side, int> count;
  for (const Triangle& triangle : model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++count[side_of(triangle, k)];
  }
  return count;
}

}  // namespace

void add_body_force(System& system, const BodyForce& force) {
  for (const Triangle& triangle : system.model.triangles) {
    const double thickness = system.model.plates[to_size(triangle.plate)].thickness;
    Eigen::Matrix<double, 2, 6> forces = Eigen::Matrix<double, 2, 6>::Zero();
    for (const TriangleQuadraturePoint& point : triangle_quadrature()) {
      const auto at = evaluate_shape_functions(system.model, triangle, point.area_coordinates);
      forces += point.weight * at.area * thickness * force(at.position) * at.N.transpose();
    }
    detail::scatter(system.coordinates.triangle_dofs<12>(triangle), forces.reshaped(), system.load);
  }
  project(system);
}

void add_edge_traction(System& system, const Traction& traction) {
  const std::map<Side, int> count = count_triangles_of_sides(system.model);
  const SideLoad load = [&traction](const Vector2d& position, const Vector2d& tangent) -> Vector2d {
    const double length = tangent.norm();
    return length * traction(position, Vector2d(tangent.y(), -tangent.x()) / length);
  };
  for (const Triangle& triangle : system.model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (count.at(side_of(triangle, k)) != 1) continue;
      const std::array nodes{triangle.nodes[k], triangle.nodes[(k + 1) % 3], triangle.nodes[k + 3]};
      const auto forces = side_forces(system.model, triangle.plate, nodes, load);
      for (std::size_t i = 0; i < 3; ++i) {
        if (nodes[i] < 0) continue;
        const auto& [x, y, rotation] = system.coordinates.node[to_size(nodes[i])];
        detail::scatter(std::array{x, y}, forces[i], system.load);
      }
    }
  }
  project(system);
}

void add_line_load(System& system, const LineLoad& load) {
  for (const FrameElement& e : system.mesh.frame) {
    if (e.is_bar()) continue;
    const Member& member = system.model.members[to_size(e.member)];
    const double phi = shear_ratio(e.section, member.theory, e.length);
    const Matrix6d R = frame_transformation_matrix(e.direction);
    const Vector2d& start = system.mesh.positions[to_size(e.nodes[0])];
    Vector6d force = Vector6d::Zero();
    for (const LineQuadraturePoint& point : line_quadrature()) {
      Vector3d q = load(start + point.xi * e.length * e.direction);
      q.head<2>() = R.topLeftCorner<2, 2>() * q.head<2>();
      force +=
          point.weight * e.length * frame_interpolation(phi, e.length, point.xi).transpose() * q;
    }
    detail::scatter(e.coordinates, (R.transpose() * force).eval(), system.load);
  }
  project(system);
}

namespace {

/// Weighted sums of squared errors and of squared exact values of n quantities.
template <int n>
struct Squares {
  using Values = Eigen::Array<double, n, 1>;
  Values error = Values::Zero(), exact = Values::Zero();

  void add(double weight, const Values& error_squared, const Values& exact_squared) {
    error += weight * error_squared;
    exact += weight * exact_squared;
  }
  /// Returns the relative error of each quantity, which is not finite if the exact field is zero.
  [[nodiscard]] Values relative() const { return (error / exact).sqrt(); }
};

MembraneFieldPoint membrane_field_point(const System& system, const Triangle& triangle,
                                        const TriangleInterpolation& at, const Eigen::VectorXd& u) {
  const Eigen::Matrix<double, 2, 6> d =
      detail::gather(system.coordinates.triangle_dofs<12>(triangle), u).reshaped(2, 6);
  const Eigen::Matrix2d gradient = d * at.gradient.transpose();  // rows u, v; columns d/dx, d/dy
  MembraneFieldPoint point;
  point.displacement = d * at.N;
  point.rotation = (gradient(1, 0) - gradient(0, 1)) / 2;
  point.stress = membrane_stress(
      system.model.plates[to_size(triangle.plate)].material,
      {gradient.trace(), gradient(0, 0) - gradient(1, 1), gradient(0, 1) + gradient(1, 0)});
  return point;
}

/// Returns sigma : epsilon, which is twice the strain energy density of the stress s [Pa].
double energy_density(const Material& material, const Vector3d& s) {
  return (s[0] * s[0] + s[1] * s[1] - 2 * material.nu * s[0] * s[1] +
          2 * (1 + material.nu) * s[2] * s[2]) /
         material.E;
}

/// Returns displacements and section forces at the fraction xi of the length of a frame element.
/// `world` contains its end displacements in world axes. Axial force and shear force are uniform in
/// the element.
BeamFieldPoint frame_fields_at_point(const FrameElement& e, BeamTheory theory,
                                     const Vector6d& world, double xi) {
  const double L = e.length, phi = shear_ratio(e.section, theory, L);
  const Vector3d motion =
      frame_interpolation(phi, L, xi) * (frame_transformation_matrix(e.direction) * world);
  const Vector3d force = frame_deformation_stiffness(e.section, theory, L)
                             .cwiseProduct(frame_deformation_matrix(e.direction, L) * world);
  return {motion[0], motion[1],         motion[2],
          force[0],  -2 * force[2] / L, force[1] + (2 * xi - 1) * force[2]};
}

Eigen::Array<double, 6, 1> values_of(const BeamFieldPoint& p) {
  return {{p.axial, p.deflection, p.rotation, p.axial_force, p.shear_force, p.bending_moment}};
}

}  // namespace

MembraneErrors membrane_errors(const System& system, const Eigen::VectorXd& q,
                               const MembraneField& exact) {
  const Eigen::VectorXd u = system.T * q;
  Squares<4> sum;
  for (const Triangle& triangle : system.model.triangles) {
    const Plate& plate = system.model.plates[to_size(triangle.plate)];
    const auto squares = [&plate](const MembraneFieldPoint& p) {
      return Eigen::Array4d(p.displacement.squaredNorm(), p.rotation * p.rotation,
                            p.stress.squaredNorm(), energy_density(plate.material, p.stress));
    };
    for (const TriangleQuadraturePoint& point : triangle_quadrature()) {
      const auto at = evaluate_shape_functions(system.model, triangle, point.area_coordinates);
      const MembraneFieldPoint h = membrane_field_point(system, triangle, at, u);
      const MembraneFieldPoint x = exact(at.position);
      const MembraneFieldPoint error{h.displacement - x.displacement, h.rotation - x.rotation,
                                     h.stress - x.stress};
      sum.add(point.weight * at.area * plate.thickness, squares(error), squares(x));
    }
  }
  const Eigen::Array4d relative = sum.relative();
  return {relative[0], relative[1], relative[2], relative[3]};
}

BeamErrors beam_errors(const System& system, const Eigen::VectorXd& q, const BeamField& exact) {
  using Values = Eigen::Array<double, 6, 1>;
  const Eigen::VectorXd u = system.T * q;
  Squares<6> sum;
  Squares<1> energy;
  Values nodal_error = Values::Zero(), nodal_size = Values::Zero();
  for (const FrameElement& e : system.mesh.frame) {
    const BeamTheory theory = system.model.members[to_size(e.member)].theory;
    const Vector6d world = detail::gather(e.coordinates, u);
    const Vector2d& start = system.mesh.positions[to_size(e.nodes[0])];
    const auto exact_at = [&](double xi) {
      return values_of(exact(start + xi * e.length * e.direction));
    };
    Values compliance = Values::Zero();
    compliance[5] = 1 / e.section.EI;
    if (has_shear_deformation(theory)) compliance[4] = 1 / e.section.kappa_GA;
    for (const LineQuadraturePoint& point : line_quadrature()) {
      const Values x = exact_at(point.xi);
      const Values error = values_of(frame_fields_at_point(e, theory, world, point.xi)) - x;
      const double weight = point.weight * e.length;
      sum.add(weight, error.square(), x.square());
      energy.add(weight, Squares<1>::Values((compliance * error.square()).sum()),
                 Squares<1>::Values((compliance * x.square()).sum()));
    }
    for (const double end : {0.0, 1.0}) {
      const Values x = exact_at(end);
      const Values error = values_of(frame_fields_at_point(e, theory, world, end)) - x;
      nodal_error = nodal_error.binaryExpr(error.abs(), &nan_max);
      nodal_size = nodal_size.max(x.abs());
    }
  }
  const Values relative = sum.relative(), nodal = nodal_error / nodal_size;
  return {relative[0], relative[1],          relative[2], relative[3], relative[4],
          relative[5], energy.relative()[0], nodal[1],    nodal[2]};
}

}  // namespace trammel::solver
