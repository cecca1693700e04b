#pragma once

#include <Eigen/Core>
#include <cmath>

#include "solver/assembly/system.h"
#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/linalg/refinement.h"
#include "solver/model/numbers.h"

/// Strain energy, internal forces and their round-off straight from the elements' deformations
/// d = B u, without an assembled stiffness: k = B^T C B with C diagonal and positive, so that what
/// is added up are squares. Bending keeps its digits beside a stiff axial part; a rigid motion
/// stores no energy but that of its own rounding.
namespace trammel::solver {

namespace detail {

template <std::size_t n, class Vector>
auto gather(const std::array<Index, n>& coordinates, const Vector& u) {
  using Scalar = typename Vector::Scalar;
  Eigen::Matrix<Scalar, static_cast<int>(n), 1> local;
  for (std::size_t i = 0; i < n; ++i)
    local[static_cast<Index>(i)] = coordinates[i] < 0 ? Scalar(0) : u[coordinates[i]];
  return local;
}

/// eps |B|^T C |B| |u|: what rounding of an element's u changes in B^T C B u.
template <class Matrix, class Rigidity, class Vector>
auto force_roundoff(const Matrix& B, const Rigidity& c, const Vector& u) {
  const auto size = (B.cwiseAbs() * u.cwiseAbs()).eval();
  return (kEps * (B.cwiseAbs().transpose() * c.cwiseProduct(size))).eval();
}

/// Adds an element's values to those of its coordinates.
template <std::size_t n, class Vector, class Sum>
void scatter(const std::array<Index, n>& coordinates, const Vector& local, Sum&& u) {
  for (std::size_t i = 0; i < n; ++i) {
    if (coordinates[i] >= 0) u[coordinates[i]] += local[static_cast<Index>(i)];
  }
}

}  // namespace detail

/// Calls visit(coordinates, B, c) for every triangle, as `for_each_deformation` does.
template <class Visit>
void for_each_plate_deformation(const System& system, Visit&& visit) {
  for (const Triangle& triangle : system.model.triangles) {
    const Plate& plate = system.model.plates[to_size(triangle.plate)];
    visit_nodes(system.model, triangle, [&]<std::size_t n>(const TriangleNodes<n>& nodes) {
      const TriangleStiffness<n> k = triangle_stiffness(nodes, plate);
      visit(system.coordinates.of_triangle<2 * n>(triangle), k.B, k.c);
    });
  }
}

/// Calls visit(coordinates, B, c) for every element: coordinates (array of n indices into u, -1
/// for none), B (m x n) and the diagonal c (m) of its stiffness B^T diag(c) B.
template <class Visit>
void for_each_deformation(const System& system, Visit&& visit) {
  for (const FrameElement& e : system.mesh.frame) {
    const Member& member = system.model.members[static_cast<std::size_t>(e.member)];
    Vector3d c = frame_rigidity(e.section, member.theory, e.length);
    if (!member.axially_flexible) c[0] = 0;
    visit(e.coordinates, frame_deformation_matrix(e.direction, e.length), c);
  }
  for_each_plate_deformation(system, visit);
  for (const SpringElement& spring : system.springs) {
    visit(spring.coordinates, Eigen::RowVector2d(-1, 1),
          Eigen::Matrix<double, 1, 1>(spring.stiffness));
  }
}

/// Nodal forces in world axes of a uniform load per unit length [N/m, world axes] on an element.
[[nodiscard]] Vector6d element_load(const FrameElement& element, const Vector2d& load);

/// K u on the unconstrained coordinates.
[[nodiscard]] Eigen::VectorXd internal_forces(const System& system, const Eigen::VectorXd& u);

/// What rounding of u changes in that: eps sum over elements of |B|^T C |B| |u|.
[[nodiscard]] Eigen::VectorXd internal_force_roundoff(const System& system,
                                                      const Eigen::VectorXd& u);

/// U^T K U for the columns of U (u x k): twice the strain energies.
[[nodiscard]] Eigen::MatrixXd strain_products(const System& system, const Eigen::MatrixXd& U);

/// What rounding u to doubles can change in u^T K u: 2 eps sum over elements of |d|^T C |B| |u|.
[[nodiscard]] double strain_roundoff(const System& system, const Eigen::VectorXd& u);

/// Rounding level of the deformation energy: sum over elements of (|B| |u|)^T C (|B| |u|). A motion
/// whose u^T K u is below about eps^2 times this does not deform anything.
[[nodiscard]] double strain_magnitude(const System& system, const Eigen::VectorXd& u);

/// (sxx, syy, sxy) of a triangle [Pa] at a point in area coordinates.
/// @param corners  where they are; of a six-node triangle those of the model
[[nodiscard]] Vector3d plate_stress(const System& system, const Triangle& triangle,
                                    const Vector3d& at, const Eigen::VectorXd& u);

/// What rounding of u changes in that, at most [Pa].
[[nodiscard]] double plate_stress_roundoff(const System& system, const Triangle& triangle,
                                           const Vector3d& at, const Eigen::VectorXd& u);

/// K x from the elements' deformations.
[[nodiscard]] Operator stiffness_operator(const System& system);

}  // namespace trammel::solver
