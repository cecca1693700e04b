#include "solver/linear/element_operators.h"

#include <limits>
#include <vector>

namespace trammel::solver {

namespace {

/// Returns the sum of the nodal forces `forces(B, c, u_e)` of all elements. B is the deformation
/// matrix of an element, c contains its rigidities, and u_e its nodal displacements.
template <class Forces>
Eigen::VectorXd element_force_sum(const System& system, const Eigen::VectorXd& u, Forces&& forces) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(u.size());
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    detail::scatter(coordinates, forces(B, c, detail::gather(coordinates, u)), sum);
  });
  return sum;
}

/// Returns the stress [Pa] of a triangle at a point for the deformation `apply(B, u_e)`. B is the
/// deformation matrix at the point, and u_e are the nodal displacements.
template <class Apply>
Vector3d stress_by_deformation(const System& system, const Triangle& triangle, const Vector3d& at,
                               const Eigen::VectorXd& u, Apply&& apply) {
  const auto deform = [&]<std::size_t n>(const TriangleNodes<n>& nodes) -> Vector3d {
    return apply(triangle_deformation_matrix<n>(evaluate_shape_functions(nodes, at)),
                 detail::gather(system.coordinates.triangle_dofs<2 * n>(triangle), u));
  };
  return membrane_stress(system.model.plates[to_size(triangle.plate)].material,
                         visit_nodes(system.model, triangle, deform));
}

}  // namespace

Eigen::VectorXd internal_forces(const System& system, const Eigen::VectorXd& u) {
  return element_force_sum(system, u, [](const auto& B, const auto& c, const auto& local) {
    return (B.transpose() * c.cwiseProduct(B * local)).eval();
  });
}

Eigen::VectorXd internal_force_roundoff(const System& system, const Eigen::VectorXd& u) {
  return element_force_sum(system, u, [](const auto& B, const auto& c, const auto& local) {
    return detail::force_roundoff(B, c, local);
  });
}

Eigen::MatrixXd projected_stiffness(const System& system, const Eigen::MatrixXd& U) {
  const Index k = U.cols();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(k, k);
  // 18 is the largest number of deformations of an element.
  Eigen::MatrixXd d(18, k);
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    constexpr int m = std::decay_t<decltype(c)>::SizeAtCompileTime;
    for (Index j = 0; j < k; ++j) d.col(j).head<m>() = B * detail::gather(coordinates, U.col(j));
    for (Index i = 0; i < k; ++i) {
      const Eigen::Matrix<double, m, 1> stress = d.col(i).head<m>().cwiseProduct(c);
      for (Index j = 0; j <= i; ++j) products(i, j) += stress.dot(d.col(j).head<m>());
    }
  });
  return products.selfadjointView<Eigen::Lower>();
}

double strain_energy_roundoff(const System& system, const Eigen::VectorXd& u) {
  double sum = 0;
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    const auto local = detail::gather(coordinates, u);
    const auto size = (B.cwiseAbs() * local.cwiseAbs()).eval();
    sum += (B * local).cwiseAbs().cwiseProduct(c).dot(size);
  });
  return 2 * std::numeric_limits<double>::epsilon() * sum;
}

double strain_energy_roundoff_scale(const System& system, const Eigen::VectorXd& u) {
  double sum = 0;
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    const auto size = (B.cwiseAbs() * detail::gather(coordinates, u).cwiseAbs()).eval();
    sum += size.cwiseProduct(c).dot(size);
  });
  return sum;
}

Vector3d plate_stress(const System& system, const Triangle& triangle, const Vector3d& at,
                      const Eigen::VectorXd& u) {
  const auto deformation = [](const auto& B, const auto& local) -> Vector3d { return B * local; };
  return stress_by_deformation(system, triangle, at, u, deformation);
}

double plate_stress_roundoff(const System& system, const Triangle& triangle, const Vector3d& at,
                             const Eigen::VectorXd& u) {
  const auto size = [](const auto& B, const auto& local) -> Vector3d {
    return B.cwiseAbs() * local.cwiseAbs();
  };
  const Vector3d stress = stress_by_deformation(system, triangle, at, u, size);
  return kEps * stress.lpNorm<Eigen::Infinity>();
}

Operator stiffness_operator(const System& system) {
  return [&system](const Eigen::VectorXd& q) -> Eigen::VectorXd {
    return system.T.transpose() * internal_forces(system, system.T * q);
  };
}

Eigen::VectorXd inertia_forces(const System& system, const Eigen::VectorXd& a) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(a.size());
  for_each_mass_matrix(system, [&](const auto& coordinates, const auto& m) {
    const auto local = (m * detail::gather(coordinates, a)).eval();
    detail::scatter(coordinates, local, force);
  });
  return force;
}

FactoredStiffness factor_stiffness(const System& system) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> rigidity;
  for_each_deformation(system, [&](const auto& coordinates, const auto& B, const auto& c) {
    for (Index i = 0; i < c.size(); ++i) {
      if (c[i] == 0) continue;
      for (std::size_t k = 0; k < coordinates.size(); ++k) {
        const double b = B(i, static_cast<Index>(k));
        if (coordinates[k] >= 0 && b != 0)
          entries.emplace_back(static_cast<Index>(rigidity.size()), coordinates[k], b);
      }
      rigidity.push_back(c[i]);
    }
  });
  SparseMatrix B(static_cast<Index>(rigidity.size()), system.T.rows());
  B.setFromTriplets(entries.begin(), entries.end());
  return {B * system.T, B.cwiseAbs() * system.T.cwiseAbs(),
          Eigen::Map<const Eigen::VectorXd>(rigidity.data(), B.rows())};
}

}  // namespace trammel::solver
