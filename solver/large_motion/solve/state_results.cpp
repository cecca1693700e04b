#include "solver/large_motion/solve/state_results.h"

#include <limits>

#include "solver/large_motion/system/element_group.h"
#include "solver/large_motion/system/joints.h"
#include "solver/large_motion/system/member_beam.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

double value_or(const VectorXd& values, Index k, double absent) {
  if (k < 0) return absent;
  return k < values.size() ? values[k] : 0.0;
}

/// Forces of the nodes on an element, less its own share of loads and inertia: what the rest of the
/// structure applies at its ends.
template <class Element, int N>
Eigen::Matrix<double, N, 1> end_forces(const Element& element,
                                       const GeometricallyExactSystem& system, const State& state,
                                       Index index, const std::array<Index, N>& where) {
  typename Element::Rows residual;
  typename Element::Gradient G;
  const typename Element::Coordinates q = gather<N>(state.q, where);
  element.constraint_residual(q, state.t, residual, G);
  constexpr int R = Element::R;
  typename Element::Coordinates f =
      G.transpose() * state.lambda.template segment<R>(system.element_row(index));
  const double tau = system.strain_rate_damping();
  typename Element::Coordinates strained = q;
  if (state.v.size() > 0) strained += tau * gather<N>(state.v, where);
  f += element.stiffness() * strained;
  typename Element::Coordinates inertia = Element::Coordinates::Zero();
  if (state.a.size() > 0) {
    inertia =
        gather<N>(state.a, where) + system.large_motion().mass_damping * gather<N>(state.v, where);
  }
  const Vector2d g = state.gravity * system.model().gravity;
  constexpr int stride = N == 4 ? 2 : 3;
  for (int a = 0; a < N; a += stride) inertia.template segment<2>(a) -= g;
  f += element.mass() * inertia;
  return f;
}

template <int P>
void beam_resultants(const GeometricallyExactSystem& system, const State& state, Index index,
                     bool first, Eigen::Ref<Eigen::RowVector3d> out) {
  const MemberElement& element = system.layout().elements[to_size(index)];
  const Member& member = system.model().members[to_size(element.member)];
  const Beam<P> beam = make_beam<P>(member, element);
  std::array<Index, 3 * (P + 1)> where{};
  std::copy(element.coordinates.begin(), element.coordinates.end(), where.begin());
  typename Beam<P>::Coordinates f =
      end_forces<Beam<P>, Beam<P>::N>(beam, system, state, index, where);
  const int k = first ? 0 : 3 * P;
  const double share = beam.length * shape_functions<P>().integral[first ? 0 : P] * state.load;
  f.template segment<2>(k) -= share * member.load;
  const double angle = value_or(state.q, where[to_size(k + 2)], 0);
  const Vector2d e1 = rotated(beam.axis, angle);
  const Vector2d e2 = perpendicular(e1);
  const double sign = first ? -1 : 1;
  const Vector2d force = f.template segment<2>(k);
  out << sign * e1.dot(force), sign * e2.dot(force), sign * f[k + 2];
}

void bar_resultants(const GeometricallyExactSystem& system, const State& state, Index index,
                    Eigen::Ref<Eigen::RowVector3d> out) {
  out << state.lambda[system.element_row(index)], 0, 0;
}

void element_resultants(const GeometricallyExactSystem& system, const State& state, Index index,
                        bool first, Eigen::Ref<Eigen::RowVector3d> out) {
  if (system.layout().elements[to_size(index)].is_bar()) {
    bar_resultants(system, state, index, out);
  } else if (system.order() == 1) {
    beam_resultants<1>(system, state, index, first, out);
  } else if (system.order() == 2) {
    beam_resultants<2>(system, state, index, first, out);
  } else {
    beam_resultants<3>(system, state, index, first, out);
  }
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
    Eigen::RowVector3d start, end;
    element_resultants(system, state, layout.first_element[to_size(m)], true, start);
    element_resultants(system, state, layout.first_element[to_size(m + 1)] - 1, false, end);
    resultants.start.row(m) = start;
    resultants.end.row(m) = end;
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
      const Vector2d moved(value_or(q, element.coordinates[stride * a], 0),
                           value_or(q, element.coordinates[stride * a + 1], 0));
      points.emplace_back(element.start + x * (element.end - element.start) + moved);
    }
  }
  Eigen::MatrixX2d line(static_cast<Index>(points.size()), 2);
  for (Index i = 0; i < line.rows(); ++i) line.row(i) = points[to_size(i)].transpose();
  return line;
}

}  // namespace trammel::solver::large_motion
