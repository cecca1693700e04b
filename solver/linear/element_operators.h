#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <vector>

#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/linalg/factorization.h"
#include "solver/linalg/forward_error.h"
#include "solver/linear/constraints.h"
#include "solver/linear/system.h"
#include "solver/model/numbers.h"

/// Strain energy, internal forces and their round-off errors. They are computed from the
/// deformations d = B u of the elements, without an assembled stiffness matrix. The stiffness
/// matrix of an element is
///
///   k = B^T C B, C diagonal and positive.
///
/// All terms of the strain energy are squares. The energy of bending is therefore accurate even if
/// the axial stiffness is much larger. A rigid motion has no strain energy beyond its round-off
/// error.
namespace trammel::solver {

namespace detail {

/// Returns the entries of u at the coordinates of an element, or 0 for a missing coordinate (-1).
template <std::size_t n, class Vector>
auto gather(const std::array<Index, n>& coordinates, const Vector& u) {
  using Scalar = typename Vector::Scalar;
  Eigen::Matrix<Scalar, static_cast<int>(n), 1> local;
  for (std::size_t i = 0; i < n; ++i)
    local[static_cast<Index>(i)] = coordinates[i] < 0 ? Scalar(0) : u[coordinates[i]];
  return local;
}

/// Returns the change of the nodal forces B^T C B u of an element caused by rounding its
/// displacements u: eps |B|^T C |B| |u|. B is the deformation matrix, and C contains the
/// rigidities.
template <class Matrix, class Rigidity, class Vector>
auto force_roundoff(const Matrix& B, const Rigidity& c, const Vector& u) {
  const auto size = (B.cwiseAbs() * u.cwiseAbs()).eval();
  return (kEps * (B.cwiseAbs().transpose() * c.cwiseProduct(size))).eval();
}

/// Adds the values `local` of an element to the components of u at the coordinates of the element.
/// Missing coordinates (-1) are skipped.
template <std::size_t n, class Vector, class Sum>
void scatter(const std::array<Index, n>& coordinates, const Vector& local, Sum&& u) {
  for (std::size_t i = 0; i < n; ++i) {
    if (coordinates[i] >= 0) u[coordinates[i]] += local[static_cast<Index>(i)];
  }
}

}  // namespace detail

/// Calls visit(coordinates, B, c) for every triangle. The arguments are those of
/// `for_each_deformation`.
template <class Visit>
void for_each_plate_deformation(const System& system, Visit&& visit) {
  for (const Triangle& triangle : system.model.triangles) {
    const Plate& plate = system.model.plates[to_size(triangle.plate)];
    visit_nodes(system.model, triangle, [&]<std::size_t n>(const TriangleNodes<n>& nodes) {
      const TriangleStiffness<n> k = triangle_stiffness(nodes, plate);
      visit(system.coordinates.triangle_dofs<2 * n>(triangle), k.B, k.c);
    });
  }
}

/// Calls visit(coordinates, B, c) for every frame element, triangle and spring. `coordinates` is an
/// array of n indices in u, or -1 for missing coordinates. B (m x n) and the rigidities c (m)
/// define the stiffness matrix B^T diag(c) B of the element.
template <class Visit>
void for_each_deformation(const System& system, Visit&& visit) {
  for (const FrameElement& e : system.mesh.frame) {
    const Member& member = system.model.members[to_size(e.member)];
    Vector3d c = frame_deformation_stiffness(e.section, member.theory, e.length);
    if (!member.axially_flexible) c[0] = 0;
    visit(e.coordinates, frame_deformation_matrix(e.direction, e.length), c);
  }
  for_each_plate_deformation(system, visit);
  for (const SpringElement& spring : system.springs)
    visit(spring.coordinates, Eigen::RowVector2d(-1, 1),
          Eigen::Matrix<double, 1, 1>(spring.stiffness));
}

/// Returns the nodal forces in world axes [N, N m] of a uniform load on an element.
/// @param element  frame element.
/// @param line_load  load per unit length in world axes [N/m].
[[nodiscard]] Vector6d element_load(const FrameElement& element, const Vector2d& line_load);

/// Returns the elastic forces K u on the unconstrained coordinates [N, N m].
[[nodiscard]] Eigen::VectorXd internal_forces(const System& system, const Eigen::VectorXd& u);

/// Returns the change of the elastic forces K u caused by rounding u [N, N m]. The change is eps
/// times the sum of |B|^T C |B| |u| over all elements with deformation matrices B and rigidities C.
[[nodiscard]] Eigen::VectorXd internal_force_roundoff(const System& system,
                                                      const Eigen::VectorXd& u);

/// Returns U^T K U [J] with the stiffness matrix K. Each column of U contains displacements of all
/// unconstrained coordinates. The diagonal contains twice the strain energy of each column.
[[nodiscard]] Eigen::MatrixXd projected_stiffness(const System& system, const Eigen::MatrixXd& U);

/// Returns a bound of the change of u^T K u caused by rounding u [J]: 2 eps times the sum of |d|^T
/// C |B| |u| over all elements. The deformations are d = B u, and C contains their rigidities.
[[nodiscard]] double strain_energy_roundoff(const System& system, const Eigen::VectorXd& u);

/// Returns the scale of the round-off error of the strain energy [J]. The scale is the sum of (|B|
/// |u|)^T C (|B| |u|) over all elements with deformation matrices B and rigidities C. A motion with
/// u^T K u below about eps^2 times this scale causes no deformation.
[[nodiscard]] double strain_energy_roundoff_scale(const System& system, const Eigen::VectorXd& u);

/// Returns the stress (sxx, syy, sxy) [Pa] of a triangle at a point for displacements u.
/// @param system  assembled model.
/// @param triangle  triangle of the model.
/// @param at  area coordinates of the point [-].
/// @param u  displacements of the unconstrained coordinates [m].
[[nodiscard]] Vector3d plate_stress(const System& system, const Triangle& triangle,
                                    const Vector3d& at, const Eigen::VectorXd& u);

/// Returns a bound of the change of the stress [Pa] of a triangle at a point, caused by rounding
/// the displacements u.
[[nodiscard]] double plate_stress_roundoff(const System& system, const Triangle& triangle,
                                           const Vector3d& at, const Eigen::VectorXd& u);

/// Returns an operator that computes the elastic forces K q from the deformations of the elements,
/// for free coordinates q.
[[nodiscard]] Operator stiffness_operator(const System& system);

/// Returns the mass matrix of a frame element in world axes.
[[nodiscard]] inline Matrix6d world_mass_matrix(const FrameElement& e, const Member& member) {
  if (e.is_bar()) return bar_mass(e.section, member.mass, e.length);
  const Matrix6d R = frame_transformation_matrix(e.direction);
  return R.transpose() * frame_mass(e.section, member.theory, member.mass, e.length) * R;
}

/// Calls visit(coordinates, m) for every triangle, where m is the mass matrix of the triangle.
template <class Visit>
void for_each_plate_mass(const System& system, Visit&& visit) {
  for (const Triangle& triangle : system.model.triangles) {
    const Plate& plate = system.model.plates[to_size(triangle.plate)];
    visit_nodes(system.model, triangle, [&]<std::size_t n>(const TriangleNodes<n>& nodes) {
      visit(system.coordinates.triangle_dofs<2 * n>(triangle), triangle_mass(nodes, plate));
    });
  }
}

// Inertia forces on all coordinates u before constraints are applied, without an assembled mass
// matrix.

/// Returns the mass matrix of a point mass for the coordinates (x, y, rotation) of its node.
/// @param mass  mass [kg].
/// @param inertia  moment of inertia about the center of mass [kg m^2].
/// @param offset  vector from the node to the center of mass in world axes [m].
template <Real T>
[[nodiscard]] Eigen::Matrix3<T> point_mass_matrix(const T& mass, const T& inertia,
                                                  const Vector2d& offset) {
  Eigen::Matrix3<T> m = Eigen::Matrix3<T>::Zero();
  m(0, 0) = m(1, 1) = mass;
  m(0, 2) = m(2, 0) = -mass * offset.y();
  m(1, 2) = m(2, 1) = mass * offset.x();
  m(2, 2) = mass * offset.squaredNorm() + inertia;
  return m;
}

/// Calls visit(coordinates, m) for every frame element, triangle, point mass and member end with
/// inertia. `coordinates` is an array of n indices in u, or -1 for missing coordinates. The mass
/// matrix m is n x n, in world axes.
template <class Visit>
void for_each_mass_matrix(const System& system, Visit&& visit) {
  for (const FrameElement& e : system.mesh.frame)
    if (e.section.mass_per_length != 0 || e.section.inertia_per_length != 0)
      visit(e.coordinates, e.mass);
  for_each_plate_mass(system, visit);
  for (const PointMass& point_mass : system.model.masses)
    visit(system.coordinates.node[to_size(point_mass.node)],
          point_mass_matrix(point_mass.mass, point_mass.inertia, point_mass.offset));
  for (std::size_t i = 0; i < system.model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double inertia = system.model.members[i].ends[end].inertia;
      if (inertia == 0) continue;
      visit(std::array<Index, 1>{system.coordinates.member_end[i][end]},
            Eigen::Matrix<double, 1, 1>(inertia));
    }
  }
}

/// Returns the inertia forces M a of accelerations a of the unconstrained coordinates [N, N m].
[[nodiscard]] Eigen::VectorXd inertia_forces(const System& system, const Eigen::VectorXd& a);

/// Sum of symmetric element matrices in the free coordinates. The element matrices are projected
/// with the rows of T, which maps free to unconstrained coordinates. Values of the same matrix
/// entry are added in the order of the calls of `add`.
class Projection {
 public:
  explicit Projection(const Constraints& constraints) : T_(constraints.T) {}

  void reserve(std::size_t entries) { entries_.reserve(entries); }

  template <std::size_t n, class Matrix>
  void add(const std::array<Index, n>& coordinates, const Matrix& k) {
    using Row = RowMajorMatrix::InnerIterator;
    for (std::size_t i = 0; i < n; ++i) {
      // The matrix is symmetric, so that only its lower triangle is computed.
      for (std::size_t j = 0; j <= i; ++j) {
        const double value = k(static_cast<Index>(i), static_cast<Index>(j));
        if (coordinates[i] < 0 || coordinates[j] < 0 || value == 0) continue;
        for (Row a(T_, coordinates[i]); a; ++a) {
          for (Row b(T_, coordinates[j]); b; ++b) {
            const double product = a.value() * value * b.value();
            const Index row = std::max(a.col(), b.col()), column = std::min(a.col(), b.col());
            if (i != j) add(row, column, row == column ? 2 * product : product);
            if (i == j && b.col() <= a.col()) add(row, column, product);
          }
        }
      }
    }
  }
  /// Adds a value to the entry (i, j) of the sum of matrices, with i >= j (lower triangle).
  void add(Index i, Index j, double value) {
    entries_.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  }

  /// Returns the symmetric sum of matrices. Both triangles are stored.
  [[nodiscard]] SparseMatrix build() const {
    SparseMatrix triangle(T_.cols(), T_.cols());
    triangle.setFromTriplets(entries_.begin(), entries_.end());
    return triangle.selfadjointView<Eigen::Lower>();
  }

 private:
  const RowMajorMatrix& T_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Returns the stiffness matrix of the free coordinates in factored form, K = (B T)^T C (B T). B
/// and C contain the deformation matrices and rigidities of all elements (`for_each_deformation`).
/// Deformations without rigidity are omitted.
[[nodiscard]] FactoredStiffness factor_stiffness(const System& system);

}  // namespace trammel::solver
