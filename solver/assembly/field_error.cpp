#include "solver/assembly/field_error.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/strain.h"
#include "solver/elements/triangle_element.h"
#include "solver/model/quadrature.h"

namespace trammel::solver {
namespace {

/// Squares of an error and of the exact field, summed up over quadrature points.
class Norm {
 public:
  void add(double weight, double error, double exact) {
    error_ += weight * error * error;
    exact_ += weight * exact * exact;
  }
  void add_squares(double weight, double error, double exact) {
    error_ += weight * error;
    exact_ += weight * exact;
  }
  /// NaN where the exact field is zero: there is nothing to be relative to.
  [[nodiscard]] double relative() const { return std::sqrt(error_ / exact_); }

 private:
  double error_ = 0;
  double exact_ = 0;
};

/// Largest error over largest exact value; a NaN stays.
class Largest {
 public:
  void add(double error, double exact) {
    if (!(std::abs(error) <= error_)) error_ = std::isnan(error_) ? error_ : std::abs(error);
    exact_ = std::max(exact_, std::abs(exact));
  }
  [[nodiscard]] double relative() const { return error_ / exact_; }

 private:
  double error_ = 0;
  double exact_ = 0;
};

MembraneFieldPoint membrane_point(const System& system, const Triangle& triangle,
                                  const TriangleInterpolation& at, const Eigen::VectorXd& u) {
  MembraneFieldPoint point;
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();  // rows u, v; columns d/dx, d/dy
  for (Index i = 0; i < at.nodes; ++i) {
    const auto node = static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(i)]);
    const auto& coordinates = system.coordinates.node[node];
    const Vector2d d(u[coordinates[0]], u[coordinates[1]]);
    point.displacement += at.N[i] * d;
    gradient += d * at.gradient.col(i).transpose();
  }
  const Material& material = system.model.plates[static_cast<std::size_t>(triangle.plate)].material;
  point.rotation = (gradient(1, 0) - gradient(0, 1)) / 2;
  point.stress =
      membrane_stress(material, {gradient(0, 0) + gradient(1, 1), gradient(0, 0) - gradient(1, 1),
                                 gradient(0, 1) + gradient(1, 0)});
  return point;
}

/// sigma : epsilon [Pa].
double energy_density(const Material& material, const Vector3d& s) {
  return (s[0] * s[0] + s[1] * s[1] - 2 * material.nu * s[0] * s[1] +
          2 * (1 + material.nu) * s[2] * s[2]) /
         material.E;
}

/// N, V, M of the interpolation, from the element's deformations; V and N are uniform.
class FrameField {
 public:
  FrameField(const System& system, const FrameElement& element, const Eigen::VectorXd& u)
      : theory_(system.model.members[static_cast<std::size_t>(element.member)].theory),
        length_(element.length),
        phi_(shear_ratio(element.section, theory_, element.length)) {
    const Vector6d world = detail::gather(element.coordinates, u);
    local_ = frame_rotation(element.direction) * world;
    forces_ = frame_rigidity(element.section, theory_, length_)
                  .cwiseProduct(frame_deformation_matrix(element.direction, length_) * world);
  }

  [[nodiscard]] BeamFieldPoint at(double xi) const {
    const Vector3d motion = frame_interpolation(phi_, length_, xi) * local_;
    return {motion[0],
            motion[1],
            motion[2],
            forces_[0],
            -2 * forces_[2] / length_,
            forces_[1] + (2 * xi - 1) * forces_[2]};
  }
  /// Shear compliance [1/N]; 0 for a theory without shear.
  [[nodiscard]] double shear_compliance(const Section& section) const {
    return has_shear_deformation(theory_) ? 1 / section.kappa_GA : 0;
  }

 private:
  BeamTheory theory_;
  double length_;
  double phi_;
  Vector6d local_;
  Vector3d forces_;
};

struct BeamNorms {
  Norm axial, deflection, rotation, axial_force, shear_force, bending_moment, energy;
  Largest nodal_deflection, nodal_rotation;

  void add(double weight, const BeamFieldPoint& h, const BeamFieldPoint& x,
           double bending_compliance, double shear_compliance) {
    axial.add(weight, h.axial - x.axial, x.axial);
    deflection.add(weight, h.deflection - x.deflection, x.deflection);
    rotation.add(weight, h.rotation - x.rotation, x.rotation);
    axial_force.add(weight, h.axial_force - x.axial_force, x.axial_force);
    shear_force.add(weight, h.shear_force - x.shear_force, x.shear_force);
    bending_moment.add(weight, h.bending_moment - x.bending_moment, x.bending_moment);
    energy.add(weight * bending_compliance, h.bending_moment - x.bending_moment, x.bending_moment);
    energy.add(weight * shear_compliance, h.shear_force - x.shear_force, x.shear_force);
  }
  void add_node(const BeamFieldPoint& h, const BeamFieldPoint& x) {
    nodal_deflection.add(h.deflection - x.deflection, x.deflection);
    nodal_rotation.add(h.rotation - x.rotation, x.rotation);
  }
  [[nodiscard]] BeamErrors errors() const {
    return {axial.relative(),       deflection.relative(),       rotation.relative(),
            axial_force.relative(), shear_force.relative(),      bending_moment.relative(),
            energy.relative(),      nodal_deflection.relative(), nodal_rotation.relative()};
  }
};

}  // namespace

MembraneErrors membrane_errors(const System& system, const Eigen::VectorXd& q,
                               const MembraneField& exact) {
  const Eigen::VectorXd u = system.T * q;
  Norm displacement, rotation, stress, energy;
  for (const Triangle& triangle : system.model.triangles) {
    const Plate& plate = system.model.plates[static_cast<std::size_t>(triangle.plate)];
    for (const TriangleQuadraturePoint& point : triangle_quadrature()) {
      const TriangleInterpolation at = interpolate(system.model, triangle, point.area_coordinates);
      const MembraneFieldPoint h = membrane_point(system, triangle, at, u);
      const MembraneFieldPoint x = exact(at.position);
      const double weight = point.weight * at.area * plate.thickness;
      const Vector3d difference = h.stress - x.stress;
      displacement.add_squares(weight, (h.displacement - x.displacement).squaredNorm(),
                               x.displacement.squaredNorm());
      rotation.add(weight, h.rotation - x.rotation, x.rotation);
      stress.add_squares(weight, difference.squaredNorm(), x.stress.squaredNorm());
      energy.add_squares(weight, energy_density(plate.material, difference),
                         energy_density(plate.material, x.stress));
    }
  }
  return {displacement.relative(), rotation.relative(), stress.relative(), energy.relative()};
}

BeamErrors beam_errors(const System& system, const Eigen::VectorXd& q, const BeamField& exact) {
  const Eigen::VectorXd u = system.T * q;
  BeamNorms norms;
  for (const FrameElement& e : system.mesh.frame) {
    const FrameField field(system, e, u);
    const Vector2d& start = system.mesh.positions[static_cast<std::size_t>(e.nodes[0])];
    const auto position = [&](double xi) -> Vector2d {
      return start + xi * e.length * e.direction;
    };
    for (const LineQuadraturePoint& point : line_quadrature()) {
      norms.add(point.weight * e.length, field.at(point.xi), exact(position(point.xi)),
                1 / e.section.EI, field.shear_compliance(e.section));
    }
    for (const double end : {0.0, 1.0}) norms.add_node(field.at(end), exact(position(end)));
  }
  return norms.errors();
}

}  // namespace trammel::solver
