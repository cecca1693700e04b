#include "solver/large_motion/solve/state_results.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include "solver/large_motion/system/member_elements.h"
#include "solver/model/numbers.h"
#include "solver/model/plane.h"

namespace trammel::solver::large_motion {

namespace {

double value_or(const VectorXd& values, Index k, double absent) {
  if (k < 0) return absent;
  return k < values.size() ? values[k] : 0.0;
}

/// g - a - alpha v at the nodes of an element, whose coordinates are `stride` a node.
template <std::size_t N>
Eigen::Matrix<double, N, 1> mass_field(const GeometricallyExactSystem& system, const State& state,
                                       const std::array<Index, N>& where, int stride) {
  Eigen::Matrix<double, N, 1> field = Eigen::Matrix<double, N, 1>::Zero();
  if (state.a.size() > 0) {
    field = -gather<N>(state.a, where);
    if (const double damping = system.large_motion().mass_damping; damping != 0)
      field -= damping * gather<N>(system.damped_velocities(state), where);
  }
  const Vector2d g = state.gravity * system.model().gravity;
  for (int a = 0; a < static_cast<int>(N); a += stride) field.template segment<2>(a) += g;
  return field;
}

/// A beam element where it is.
template <int P>
struct PlacedBeam {
  using Coordinates = typename Beam<P>::Coordinates;
  const GeometricallyExactSystem& system;
  const State& state;
  Index index;
  const MemberElement& element = system.layout().elements[to_size(index)];
  const Member& member = system.model().members[to_size(element.member)];
  Beam<P> beam = make_beam<P>(member, element);
  std::array<Index, Beam<P>::N> where = coordinates_of<Beam<P>::N>(element);
  Coordinates q = gather<Beam<P>::N>(state.q, where);

  /// Loads + M (g - a - alpha v) at each node [N, N, N m].
  [[nodiscard]] Coordinates applied_forces() const {
    Coordinates f = beam.mass() * mass_field<Beam<P>::N>(system, state, where, 3);
    for (int a = 0; a <= P; ++a) {
      f.template segment<2>(3 * a) +=
          beam.length * shape_functions<P>().integral[a] * state.load * member.load;
    }
    return f;
  }

  /// Forces and moments at the nodes that the rest of the structure applies,
  /// G^T lambda + K (q + tau v) - applied forces [N, N, N m].
  [[nodiscard]] Coordinates nodal_forces() const {
    typename Beam<P>::Rows residual;
    typename Beam<P>::Gradient G;
    beam.constraint_residual(q, state.t, residual, G);
    Coordinates strained = q;
    if (state.v.size() > 0)
      strained += system.strain_rate_damping() * gather<Beam<P>::N>(state.v, where);
    return G.transpose() * state.lambda.template segment<Beam<P>::R>(system.element_row(index)) +
           beam.bending(strained) - applied_forces();
  }

  /// Axes of the section at a node.
  [[nodiscard]] Vector2d e1(int node) const { return rotated(beam.axis, q[3 * node + 2]); }
  [[nodiscard]] Vector2d position(int node) const {
    const double x = lobatto_coordinate(P, to_size(node));
    return element.start + x * (element.end - element.start) + q.template segment<2>(3 * node);
  }
};

template <int P>
Eigen::RowVector3d beam_resultants(const GeometricallyExactSystem& system, const State& state,
                                   Index index, bool first) {
  const PlacedBeam<P> placed{system, state, index};
  const int node = first ? 0 : P;
  const typename Beam<P>::Coordinates f = placed.nodal_forces();
  const Vector2d e1 = placed.e1(node);
  const double sign = first ? -1 : 1;
  const Vector2d force = f.template segment<2>(3 * node);
  return {sign * e1.dot(force), sign * perpendicular(e1).dot(force), sign * f[3 * node + 2]};
}

/// Sums of forces and of moments about a point, and of their terms' magnitudes.
struct FreeBody {
  Vector2d about;
  Vector2d force = Vector2d::Zero();
  double moment = 0, force_terms = 0, moment_terms = 0;

  void add(const Vector2d& at, const Vector2d& f, double m) {
    const Vector2d arm = at - about;
    force += f;
    moment += arm.x() * f.y() - arm.y() * f.x() + m;
    force_terms += f.norm();
    moment_terms += arm.norm() * f.norm() + std::abs(m);
  }
};

template <int P>
FreeBody cut_free(const GeometricallyExactSystem& system, const State& state, Index first,
                  Index last) {
  const auto section_force = [](const PlacedBeam<P>& beam, const Eigen::RowVector3d& resultant,
                                int node) -> Vector2d {
    return resultant[0] * beam.e1(node) + resultant[1] * perpendicular(beam.e1(node));
  };
  const PlacedBeam<P> head{system, state, first}, tail{system, state, last};
  FreeBody body{head.position(0)};
  const Eigen::RowVector3d start = beam_resultants<P>(system, state, first, true);
  const Eigen::RowVector3d end = beam_resultants<P>(system, state, last, false);
  body.add(head.position(0), -section_force(head, start, 0), -start[2]);
  body.add(tail.position(P), section_force(tail, end, P), end[2]);
  for (Index e = first; e <= last; ++e) {
    const PlacedBeam<P> beam{system, state, e};
    const typename Beam<P>::Coordinates f = beam.applied_forces();
    for (int a = 0; a <= P; ++a)
      body.add(beam.position(a), f.template segment<2>(3 * a), f[3 * a + 2]);
    // Moments are differences of rotations, however far the member has turned.
    body.moment_terms += (beam.beam.stiffness().cwiseAbs() * beam.q.cwiseAbs()).maxCoeff();
  }
  return body;
}

/// The force of the spring along the bar, and what each end bears of its loads and its mass.
Eigen::RowVector3d bar_resultants(const GeometricallyExactSystem& system, const State& state,
                                  Index index, bool first) {
  const MemberElement& element = system.layout().elements[to_size(index)];
  const Member& member = system.model().members[to_size(element.member)];
  const Bar bar = make_bar(member, element);
  const std::array<Index, 4> where = coordinates_of<4>(element);
  const Bar::Coordinates q = gather<4>(state.q, where);
  const Bar::Coordinates carried = bar.mass() * mass_field<4>(system, state, where, 2);
  const Vector2d axis = (bar.offset + q.tail<2>() - q.head<2>()).normalized();
  const Vector2d applied =
      carried.segment<2>(first ? 0 : 2) + element.length() / 2 * state.load * member.load;
  const double sign = first ? 1 : -1;
  return {state.lambda[system.element_row(index)] + sign * axis.dot(applied),
          sign * perpendicular(axis).dot(applied), 0};
}

/// (N, V, M) at the first or the second end of an element.
Eigen::RowVector3d element_resultants(const GeometricallyExactSystem& system, const State& state,
                                      Index index, bool first) {
  if (system.layout().elements[to_size(index)].is_bar())
    return bar_resultants(system, state, index, first);
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

void MemberBalance::add(const GeometricallyExactSystem& system, const State& state) {
  const Layout& layout = system.layout();
  for (std::size_t m = 0; m < system.model().members.size(); ++m) {
    const Index first = layout.first_element[m], last = layout.first_element[m + 1] - 1;
    if (layout.elements[to_size(first)].is_bar()) continue;
    const FreeBody body = system.order() == 1   ? cut_free<1>(system, state, first, last)
                          : system.order() == 2 ? cut_free<2>(system, state, first, last)
                                                : cut_free<3>(system, state, first, last);
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

Index redundant_constraints(const GeometricallyExactSystem& system, const State& state) {
  const Index rigid = (system.compliance().array() == 0).count();
  if (rigid == 0 || rigid > kMaxCountedConstraints || system.coordinates() == 0) return 0;
  KktMatrix matrix(system.coordinates(), system.constraints(), system.blocks());
  TangentCoefficients coefficients;
  coefficients.has_penalty = false;
  matrix.clear();
  system.tangent(state, coefficients, matrix);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows =
      matrix.constraint_gradient(system.scale(), system.row_unit());
  std::vector<Eigen::Triplet<double>> entries;
  Index column = 0;
  for (Index r = 0; r < rows.rows(); ++r) {
    if (system.compliance()[r] > 0) continue;
    const double size = rows.row(r).norm();  // 0 for what supports hold at both ends
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, r); size > 0 && it;
         ++it)
      entries.emplace_back(it.col(), column, it.value() / size);
    ++column;
  }
  Eigen::SparseMatrix<double> columns(system.coordinates(), rigid);
  columns.setFromTriplets(entries.begin(), entries.end());
  columns.makeCompressed();
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(1e-10);  // of unit columns; rounding leaves far less
  qr.compute(columns);
  return rigid - qr.rank();
}

}  // namespace trammel::solver::large_motion
