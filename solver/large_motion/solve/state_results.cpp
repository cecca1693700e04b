#include "solver/large_motion/solve/state_results.h"

#include "solver/large_motion/system/member_elements.h"
#include "solver/model/numbers.h"
#include "solver/model/plane.h"

namespace trammel::solver::large_motion {

namespace {

double value_or(const VectorXd& values, Index k, double absent) {
  if (k < 0) return absent;
  return k < values.size() ? values[k] : 0.0;
}

/// Forces and moments at the nodes of a beam element that the rest of the structure applies,
/// G^T lambda + K (q + tau v) + M (a + alpha v - g) - loads [N, N, N m].
template <int P>
typename Beam<P>::Coordinates nodal_forces(const Beam<P>& beam,
                                           const GeometricallyExactSystem& system,
                                           const State& state, Index index,
                                           const std::array<Index, Beam<P>::N>& where) {
  constexpr int N = Beam<P>::N, R = Beam<P>::R;
  using Coordinates = typename Beam<P>::Coordinates;
  typename Beam<P>::Rows residual;
  typename Beam<P>::Gradient G;
  const Coordinates q = gather<N>(state.q, where);
  beam.constraint_residual(q, state.t, residual, G);
  Coordinates f = G.transpose() * state.lambda.template segment<R>(system.element_row(index));
  Coordinates strained = q;
  if (state.v.size() > 0) {
    strained += system.strain_rate_damping() * gather<N>(state.v, where);
  }
  f += beam.stiffness() * strained;
  Coordinates inertia = Coordinates::Zero();
  if (state.a.size() > 0) {
    inertia =
        gather<N>(state.a, where) + system.large_motion().mass_damping * gather<N>(state.v, where);
  }
  const Vector2d g = state.gravity * system.model().gravity;
  for (int a = 0; a < N; a += 3) inertia.template segment<2>(a) -= g;
  f += beam.mass() * inertia;
  return f;
}

template <int P>
Eigen::RowVector3d beam_resultants(const GeometricallyExactSystem& system, const State& state,
                                   Index index, bool first) {
  const MemberElement& element = system.layout().elements[to_size(index)];
  const Member& member = system.model().members[to_size(element.member)];
  const Beam<P> beam = make_beam<P>(member, element);
  const auto where = coordinates_of<Beam<P>::N>(element);
  typename Beam<P>::Coordinates f = nodal_forces<P>(beam, system, state, index, where);
  const int k = first ? 0 : 3 * P;
  const double share = beam.length * shape_functions<P>().integral[first ? 0 : P] * state.load;
  f.template segment<2>(k) -= share * member.load;
  const double angle = value_or(state.q, where[to_size(k + 2)], 0);
  const Vector2d e1 = rotated(beam.axis, angle);
  const Vector2d e2 = perpendicular(e1);
  const double sign = first ? -1 : 1;
  const Vector2d force = f.template segment<2>(k);
  return {sign * e1.dot(force), sign * e2.dot(force), sign * f[k + 2]};
}

/// (N, V, M) at the first or the second end of an element.
Eigen::RowVector3d element_resultants(const GeometricallyExactSystem& system, const State& state,
                                      Index index, bool first) {
  if (system.layout().elements[to_size(index)].is_bar()) {
    return {state.lambda[system.element_row(index)], 0, 0};
  }
  if (system.order() == 1) return beam_resultants<1>(system, state, index, first);
  if (system.order() == 2) return beam_resultants<2>(system, state, index, first);
  return beam_resultants<3>(system, state, index, first);
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

Eigen::MatrixX2d end_rotations(const GeometricallyExactSystem& system, const VectorXd& values) {
  const Layout& layout = system.layout();
  Eigen::MatrixX2d rotation(static_cast<Index>(layout.end_rotation.size()), 2);
  for (Index m = 0; m < rotation.rows(); ++m) {
    for (Index end = 0; end < 2; ++end) {
      rotation(m, end) = value_or(values, layout.end_rotation[to_size(m)][to_size(end)], kNaN);
    }
  }
  return rotation;
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

Resultants member_resultants(const GeometricallyExactSystem& system, const State& state) {
  const Layout& layout = system.layout();
  const auto count = static_cast<Index>(system.model().members.size());
  Resultants resultants{Eigen::MatrixX3d(count, 3), Eigen::MatrixX3d(count, 3)};
  for (Index m = 0; m < count; ++m) {
    resultants.start.row(m) =
        element_resultants(system, state, layout.first_element[to_size(m)], true);
    resultants.end.row(m) =
        element_resultants(system, state, layout.first_element[to_size(m + 1)] - 1, false);
  }
  return resultants;
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
    const std::size_t stride = element.is_bar() ? 2 : 3;
    const std::size_t count = element.coordinates.size() / stride;
    for (std::size_t a = points.empty() ? 0 : 1; a < count; ++a) {
      const double x =
          element.is_bar() ? static_cast<double>(a) : lobatto_coordinate(system.order(), a);
      const Vector2d displacement(value_or(q, element.coordinates[stride * a], 0),
                                  value_or(q, element.coordinates[stride * a + 1], 0));
      points.emplace_back(element.start + x * (element.end - element.start) + displacement);
    }
  }
  Eigen::MatrixX2d line(static_cast<Index>(points.size()), 2);
  for (Index i = 0; i < line.rows(); ++i) line.row(i) = points[to_size(i)].transpose();
  return line;
}

}  // namespace trammel::solver::large_motion
