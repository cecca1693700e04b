#include "solver/large/state_results.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

double value_or(const VectorXd& values, Index k, double absent) {
  if (k < 0) return absent;
  return k < values.size() ? values[k] : 0.0;
}

/// Element of a member with its coordinates q in a state, from which its nodal and section forces
/// follow.
template <class Element>
struct PlacedElement {
  using Coordinates = typename Element::Coordinates;
  static constexpr int N = Element::N;

  const GeometricallyExactSystem& system;
  const State& state;
  Index index;  ///< index among the elements of all members
  const MemberElement& placed = system.layout().elements[to_size(index)];
  const ElementGroup<Element>& group = system.parts().group<Element>();
  Index place = system.parts().group_index[to_size(index)];
  const Element& element = group.element(place);
  const CoordinateIndices<N>& where = group.coordinate_indices(place);
  Coordinates q = gather<N>(state.q, where);
  int stride = static_cast<int>(placed.coordinates_per_node());

  /// Returns the nodal forces of loads, weight, inertia and mass-proportional damping alpha: loads
  /// + M (g - a - alpha v) [N, N, N m].
  [[nodiscard]] Coordinates applied_forces() const {
    const Member& member = system.model().members[to_size(placed.member)];
    Coordinates field = Coordinates::Zero();  // g - a - alpha v
    if (state.a.size() > 0) {
      field = -gather<N>(state.a, where);
      if (const double damping = system.large_motion().mass_damping; damping != 0)
        field -= damping * gather<N>(system.damped_velocities(state), where);
    }
    for (int k = 0; k < N; k += stride)
      field.template segment<2>(k) += state.gravity * system.model().gravity;
    return element.mass() * field + element.distributed_load(state.load * member.load);
  }

  /// Returns the forces and moments that the remaining structure applies to the nodes, G^T lambda +
  /// K (q + tau v) - applied forces [N, N, N m].
  [[nodiscard]] Coordinates nodal_forces() const {
    typename Element::Rows residual;
    typename Element::Gradient G;
    element.constraint_residual(q, state.t, residual, G);
    Coordinates f =
        G.transpose() * state.lambda.segment<Element::R>(group.first_constraint_row(place));
    if constexpr (requires { element.forces(q, q, 0.0); })
      f += element.forces(q, gather<N>(state.v, where), system.strain_rate_damping());
    return f - applied_forces();
  }

  /// Returns the section forces (N, V, M) at the first or the last node [N, N, N m].
  [[nodiscard]] Eigen::RowVector3d resultants(bool first) const {
    const int node = first ? 0 : N / stride - 1;
    const Coordinates f = nodal_forces();
    const Vector2d e1 = element.section_normal(q, node), force = node_force(f, node);
    const double sign = first ? -1 : 1;
    return {sign * e1.dot(force), sign * perpendicular(e1).dot(force), sign * moment(f, node)};
  }

  [[nodiscard]] Vector2d node_force(const Coordinates& f, int node) const {
    return f.template segment<2>(stride * node);
  }
  [[nodiscard]] double moment(const Coordinates& f, int node) const {
    return stride == 3 ? f[3 * node + 2] : 0;
  }
  [[nodiscard]] Vector2d position(int node) const {
    return placed.position(static_cast<std::size_t>(node)) + node_force(q, node);
  }
};

/// Sums of forces and of moments about a point, and of the magnitudes of their terms.
struct FreeBody {
  Vector2d about;
  Vector2d force = Vector2d::Zero();
  double moment = 0, force_terms = 0, moment_terms = 0;

  void add(const Vector2d& at, const Vector2d& f, double m) {
    const Vector2d arm = at - about;
    force += f;
    moment += cross(arm, f) + m;
    force_terms += f.norm();
    moment_terms += arm.norm() * f.norm() + std::abs(m);
  }
};

/// Returns the sums of forces and moments on a bending member that is cut free at both ends.
FreeBody sum_forces_on_member(const GeometricallyExactSystem& system, const State& state,
                              Index first, Index last) {
  constexpr int kLast = BeamInterpolation::kNodes - 1;
  FreeBody body{PlacedElement<Beam>{system, state, first}.position(0)};
  for (const bool at_start : {true, false}) {
    const PlacedElement<Beam> beam{system, state, at_start ? first : last};
    const int node = at_start ? 0 : kLast;
    const Eigen::RowVector3d section = (at_start ? -1 : 1) * beam.resultants(at_start);
    const Vector2d e1 = beam.element.section_normal(beam.q, node);
    body.add(beam.position(node), section[0] * e1 + section[1] * perpendicular(e1), section[2]);
  }
  for (Index e = first; e <= last; ++e) {
    const PlacedElement<Beam> beam{system, state, e};
    const Beam::Coordinates f = beam.applied_forces();
    for (int a = 0; a <= kLast; ++a)
      body.add(beam.position(a), beam.node_force(f, a), beam.moment(f, a));
    // Bending moments follow from differences of nodal rotations. The round-off error of these
    // moments is relative to the rotation of the member, which the sum of magnitudes therefore
    // includes.
    body.moment_terms +=
        (beam.element.tangent(beam.q, 1, 0).cwiseAbs() * beam.q.cwiseAbs()).maxCoeff();
  }
  return body;
}

/// Returns the section forces (N, V, M) at an end of an element [N, N, N m].
Eigen::RowVector3d section_forces_at_element_end(const GeometricallyExactSystem& system,
                                                 const State& state, Index index, bool first) {
  if (system.layout().elements[to_size(index)].is_bar())
    return PlacedElement<Bar>{system, state, index}.resultants(first);
  return PlacedElement<Beam>{system, state, index}.resultants(first);
}

}  // namespace

Eigen::MatrixX3d node_motion(const GeometricallyExactSystem& system, const VectorXd& values) {
  const Layout& layout = system.layout();
  Eigen::MatrixX3d motion(static_cast<Index>(layout.node.size()), 3);
  for (Index i = 0; i < motion.rows(); ++i) {
    for (Index k = 0; k < 3; ++k)
      motion(i, k) = value_or(values, layout.node[to_size(i)][to_size(k)], kNaN);
  }
  return motion;
}

Eigen::MatrixX3d reactions(const GeometricallyExactSystem& system, const State& state) {
  const Layout& layout = system.layout();
  VectorXd force(layout.total);
  system.force_residual(state, force);
  Eigen::MatrixX3d reaction =
      Eigen::MatrixX3d::Zero(static_cast<Index>(system.model().supports.size()), 3);
  for (Index i = 0; i < reaction.rows(); ++i) {
    const Support& support = system.model().supports[to_size(i)];
    for (Index k = 0; k < 3; ++k) {
      const Index coordinate = layout.node[to_size(support.node)][to_size(k)];
      if (support.fixed[to_size(k)] && coordinate >= layout.free)
        reaction(i, k) = force[coordinate];
    }
  }
  return reaction;
}

StaticSolution static_solution(const GeometricallyExactSystem& system, const State& state) {
  const Layout& layout = system.layout();
  const Index members = std::ssize(system.model().members);
  StaticSolution solution;
  solution.displacement = node_motion(system, state.q);
  solution.reaction = reactions(system, state);
  solution.end_rotation.resize(members, 2);
  solution.resultant_start.resize(members, 3);
  solution.resultant_end.resize(members, 3);
  for (Index m = 0; m < members; ++m) {
    for (Index end = 0; end < 2; ++end)
      solution.end_rotation(m, end) =
          value_or(state.q, layout.end_rotation[to_size(m)][to_size(end)], kNaN);
    solution.resultant_start.row(m) =
        section_forces_at_element_end(system, state, layout.first_element[to_size(m)], true);
    solution.resultant_end.row(m) = section_forces_at_element_end(
        system, state, layout.first_element[to_size(m + 1)] - 1, false);
  }
  return solution;
}

void MemberBalance::add_state(const GeometricallyExactSystem& system, const State& state) {
  const Layout& layout = system.layout();
  for (std::size_t m = 0; m < system.model().members.size(); ++m) {
    const Index first = layout.first_element[m], last = layout.first_element[m + 1] - 1;
    if (layout.elements[to_size(first)].is_bar()) continue;
    const FreeBody body = sum_forces_on_member(system, state, first, last);
    force_ = nan_max(force_, body.force.norm());
    moment_ = nan_max(moment_, std::abs(body.moment));
    force_terms_ = std::max(force_terms_, body.force_terms);
    moment_terms_ = std::max(moment_terms_, body.moment_terms);
    length_ = std::max(
        length_,
        (layout.elements[to_size(last)].end - layout.elements[to_size(first)].start).norm());
  }
}

double MemberBalance::residual() const {
  if (force_ == 0 && moment_ == 0) return 0;
  const double moment_terms = std::max(moment_terms_, force_terms_ * length_);
  return nan_max(force_ * length_, moment_) / moment_terms;
}

double drive_force(const GeometricallyExactSystem& system, const State& state, Index drive) {
  return -state.lambda[system.drive_row(drive)];
}

Eigen::MatrixX2d member_node_positions(const GeometricallyExactSystem& system, const VectorXd& q,
                                       Index member) {
  const Layout& layout = system.layout();
  std::vector<Vector2d> points;
  for (Index e = layout.first_element[to_size(member)];
       e < layout.first_element[to_size(member + 1)]; ++e) {
    const MemberElement& element = layout.elements[to_size(e)];
    for (std::size_t a = points.empty() ? 0 : 1; a < element.nodes(); ++a) {
      const std::size_t k = element.coordinates_per_node() * a;
      points.push_back(element.position(a) + Vector2d(value_or(q, element.coordinates[k], 0),
                                                      value_or(q, element.coordinates[k + 1], 0)));
    }
  }
  Eigen::MatrixX2d line(static_cast<Index>(points.size()), 2);
  for (Index i = 0; i < line.rows(); ++i) line.row(i) = points[to_size(i)].transpose();
  return line;
}

Index redundant_constraint_count(const GeometricallyExactSystem& system, const State& state) {
  const Index rigid = (system.row_compliance().array() == 0).count();
  if (rigid == 0 || rigid > kMaxCountedConstraints || system.coordinate_count() == 0) return 0;
  KktMatrix matrix(system.coordinate_count(), system.constraint_count(), system.coupled_unknowns());
  TangentCoefficients coefficients;
  coefficients.has_penalty = false;
  matrix.clear();
  system.add_tangent(state, coefficients, matrix);
  Eigen::SparseMatrix<double> columns =
      matrix.constraint_gradient(system.scale(), system.row_units()).transpose().sparseView();
  VectorXd factor = VectorXd::Zero(columns.cols());
  for (Index r = 0; r < columns.cols(); ++r) {
    const double size = columns.col(r).norm();  // 0 if supports hold all coordinates
    if (system.row_compliance()[r] == 0 && size > 0) factor[r] = 1 / size;
  }
  columns = columns * factor.asDiagonal();
  columns.prune(0.0);
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(1e-10);  // relative to unit columns; round-off errors are much smaller
  qr.compute(columns);
  return rigid - qr.rank();
}

}  // namespace trammel::solver::large_motion
