#include "solver/manipulator/moving_system.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/assembly/inertia.h"
#include "solver/assembly/strain.h"
#include "solver/model/plane.h"
#include "solver/model/quadrature.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Entries of T beyond this have cost four digits.
constexpr double kLargestT = 1e4;
/// An entry of T below this share of its row's largest is round-off of zero.
constexpr double kVanishing = 1e-11;

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

/// The vector's derivative in time, of order 0, 1 or 2, when it turns with a part.
Vector2d derivative(const Vector2d& at_start, const PartMotion& part, int order) {
  const Vector2d now = rotated(at_start, part.angle);
  if (order == 0) return now;
  if (order == 1) return part.rate * perpendicular(now);
  return part.acceleration * perpendicular(now) - part.rate * part.rate * now;
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

}  // namespace

MovingSystem::MovingSystem(const Model& model, bool gyroscopic, bool inertia)
    : start_(assemble(model, inertia ? Effects::all() : Effects::all().without(Effect::inertia))),
      constraints_(start_.constraints),
      gyroscopic_(gyroscopic),
      inertia_(inertia) {
  for (std::size_t r = 0; r < constraints_.rows.size(); ++r) {
    const auto source = constraints_.rows[r].source;
    T_is_variable_ = T_is_variable_ || (constraints_.pivot[r] >= 0 &&
                                        (source == ConstraintRow::Source::rigid_body ||
                                         source == ConstraintRow::Source::inextensible));
  }
  motion_.position.resize(static_cast<Index>(model.nodes.size()), 2);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    motion_.position.row(static_cast<Index>(i)) = model.nodes[i].position;
  }
  motion_.acceleration.setZero(static_cast<Index>(model.nodes.size()), 2);
  motion_.member.resize(model.members.size());
  motion_.plate.resize(model.plates.size());
  motion_.rigid_body.resize(model.rigid_bodies.size());
  if (T_is_variable_) extend_constraint_pattern();
  make_frames();
  make_triangles();
  make_point_masses();
  make_springs();
  make_pattern();
  make_spans();
  inertia_u_.setZero(start_.coordinates.size);
  inertia_load_.setZero(K_.rows());
  load_.setZero(K_.rows());
  static_cast<void>(move_to(NominalMotion(motion_)));
}

// ---- elements
// ------------------------------------------------------------------------------------

void MovingSystem::make_frames() {
  for (const FrameElement& e : start_.mesh.frame) {
    const Member& member = start_.model.members[static_cast<std::size_t>(e.member)];
    Element element;
    element.layout = Layout::frame;
    element.coordinates = e.coordinates;
    element.part = &NominalMotion::member;
    element.part_index = static_cast<std::size_t>(e.member);
    Vector3d c = frame_rigidity(e.section, member.theory, e.length);
    if (!member.axially_flexible) c[0] = 0;
    const FrameDeformation B = frame_deformation(e.direction, e.length);
    element.k = B.transpose() * c.asDiagonal() * B;
    element.m = world_mass(e, member);
    const RotationDerivatives derivatives = rotation_derivatives(e, member);
    element.first_derivative = derivatives.first;
    element.second_derivative = derivatives.second;
    element_evaluations_ += 2;
    elements_.push_back(element);
  }
}

void MovingSystem::make_triangles() {
  for (const Triangle& triangle : start_.model.triangles) {
    Element element;
    element.layout = Layout::triangle;
    element.part = &NominalMotion::plate;
    element.part_index = static_cast<std::size_t>(triangle.plate);
    if (triangle.quadratic()) throw ModelError("triangles of six nodes do not move yet");
    const TrianglePoints points = corners(start_.model, triangle);
    element.coordinates = start_.coordinates.of_triangle<6>(triangle);
    const Plate& plate = start_.model.plates[element.part_index];
    element.k = triangle_stiffness(points, plate);
    element.m = triangle_mass(points, plate);  // the interpolation is isotropic: W does not turn
    element_evaluations_ += 2;
    elements_.push_back(element);
  }
}

void MovingSystem::make_point_masses() {
  const Model& model = start_.model;
  for (const PointMass& point_mass : model.masses) {
    Element element;
    element.layout = Layout::point_mass;
    const auto& node = start_.coordinates.node[static_cast<std::size_t>(point_mass.node)];
    std::copy(node.begin(), node.end(), element.coordinates.begin());
    for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
      const RigidBody& body = model.rigid_bodies[b];
      const bool holds =
          body.reference == point_mass.node ||
          std::count(body.attached.begin(), body.attached.end(), point_mass.node) > 0;
      if (!holds) continue;
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
    elements_.push_back(element);
  }
}

void MovingSystem::make_springs() {
  const Model& model = start_.model;
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double inertia = model.members[i].ends[end].inertia;
      if (inertia == 0) continue;
      Element element;
      element.layout = Layout::scalar;
      element.coordinates[0] = start_.coordinates.member_end[i][end];
      element.part = &NominalMotion::member;
      element.part_index = i;
      element.m(0, 0) = inertia;
      elements_.push_back(element);
    }
  }
  for (const SpringElement& spring : start_.springs) {
    Element element;
    element.layout = Layout::scalar;
    element.coordinates[0] = spring.coordinates[0];
    element.coordinates[1] = spring.coordinates[1];
    element.k(0, 0) = element.k(1, 1) = spring.stiffness;
    element.k(0, 1) = element.k(1, 0) = -spring.stiffness;
    elements_.push_back(element);
  }
}

// ---- places
// --------------------------------------------------------------------------------------

/// Rows that T is solved from, and T with every entry that some pose needs: those that do not
/// vanish at three turns of the parts in general position. Of the pattern alone, each node of an
/// inextensible member would follow all before it; in numbers what they add cancels.
void MovingSystem::extend_constraint_pattern() {
  auto& T = constraints_.T;
  dependent_row_of_.assign(static_cast<std::size_t>(T.rows()), -1);
  for (std::size_t r = 0; r < constraints_.rows.size(); ++r) {
    if (constraints_.pivot[r] < 0 ||
        constraints_.rows[r].source == ConstraintRow::Source::support) {
      continue;
    }
    dependent_row_of_[static_cast<std::size_t>(constraints_.pivot[r])] =
        static_cast<Index>(dependent_rows_.size());
    dependent_rows_.push_back(r);
  }
  Eigen::ArrayXX<bool> needed(static_cast<Index>(dependent_rows_.size()), T.cols());
  needed.setConstant(false);
  NominalMotion general = motion_;
  double turn = 1;
  for (int found = 0, trial = 0; found < 3 && trial < 100; ++trial) {
    for (auto* parts : {&general.member, &general.rigid_body}) {
      for (PartMotion& part : *parts) part.angle = 0.4 * std::sin(turn += std::numbers::phi);
    }
    const MatrixXd X = dependent_coordinates(general).cwiseAbs();
    if (!(X.allFinite() && X.maxCoeff() < kLargestT)) continue;
    ++found;
    for (Index i = 0; i < X.rows(); ++i) {
      needed.row(i) = needed.row(i) || X.row(i).array() > kVanishing * X.row(i).maxCoeff();
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (Index u = 0; u < T.rows(); ++u) {
    const Index row = dependent_row_of_[static_cast<std::size_t>(u)];
    const Index own = constraints_.free[static_cast<std::size_t>(u)];
    for (Index q = 0; q < T.cols(); ++q) {
      const bool enters = row >= 0 ? needed(row, q) : q == own;
      if (enters) entries.emplace_back(static_cast<int>(u), static_cast<int>(q), T.coeff(u, q));
    }
  }
  T.setFromTriplets(entries.begin(), entries.end());
  T.makeCompressed();
  T_dot_ = 0.0 * T;
  T_ddot_ = T_dot_;
}

void MovingSystem::make_pattern() {
  const auto& T = constraints_.T;
  const Index n = T.cols();
  std::vector<Eigen::Triplet<double>> places;
  for (Index i = 0; i < n; ++i) places.emplace_back(static_cast<int>(i), static_cast<int>(i), 0.0);
  const auto visit = [&](auto&& visitor) {
    for (Element& element : elements_) {
      element.first_contribution = contributions_.size();
      for (int i = 0; i < 6; ++i) {
        const Index u = element.coordinates[static_cast<std::size_t>(i)];
        for (int j = 0; j < 6 && u >= 0; ++j) {
          const Index w = element.coordinates[static_cast<std::size_t>(j)];
          if (w < 0) continue;
          for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a) {
            for (int b = T.outerIndexPtr()[w]; b < T.outerIndexPtr()[w + 1]; ++b) {
              visitor(i + 6 * j, a, b, T.innerIndexPtr()[a], T.innerIndexPtr()[b]);
            }
          }
        }
      }
    }
  };
  visit([&](int, int, int, int row, int column) { places.emplace_back(row, column, 0.0); });
  K_.resize(n, n);
  K_.setFromTriplets(places.begin(), places.end());
  K_.makeCompressed();
  if (inertia_) M_ = K_;
  if (gyroscopic_) C_gyroscopic_ = K_centrifugal_euler_ = K_;
  contributions_.reserve(places.size());
  visit([&](int local, int a, int b, int row, int column) {
    const int* const begin = K_.innerIndexPtr() + K_.outerIndexPtr()[column];
    const int* const end = K_.innerIndexPtr() + K_.outerIndexPtr()[column + 1];
    const auto place = std::lower_bound(begin, end, row) - K_.innerIndexPtr();
    contributions_.push_back({local, a, b, static_cast<int>(place)});
  });
}

void MovingSystem::make_spans() {
  const Model& model = start_.model;
  const std::size_t nodes = start_.mesh.positions.size();
  span_.resize(nodes);
  fraction_.assign(nodes, 0.0);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    span_[i] = {static_cast<Index>(i), static_cast<Index>(i)};
  }
  Index before = -1;
  Index done = 0;
  for (const FrameElement& e : start_.mesh.frame) {
    const Member& member = model.members[static_cast<std::size_t>(e.member)];
    done = e.member == before ? done + 1 : 1;
    before = e.member;
    if (done == member.elements) continue;  // its second node is the member's
    const auto node = static_cast<std::size_t>(e.nodes[1]);
    span_[node] = member.nodes;
    fraction_[node] = static_cast<double>(done) / static_cast<double>(member.elements);
  }
}

// ---- constraints
// -----------------------------------------------------------------------------------

/// The coefficient of a term in a row, or its derivative in time.
double MovingSystem::coefficient(const ConstraintRow& row, std::size_t term,
                                 const NominalMotion& motion, int order) const {
  if (row.source == ConstraintRow::Source::inextensible) {
    const FrameElement& e = start_.mesh.frame[static_cast<std::size_t>(row.index)];
    const Vector2d d =
        derivative(e.direction, motion.member[static_cast<std::size_t>(e.member)], order);
    const Index u = row.terms[term].first;
    const auto at = std::find(e.coordinates.begin(), e.coordinates.end(), u);
    const auto local = at - e.coordinates.begin();
    return (local >= 3 ? 1 : -1) * (local % 3 == 0 ? d.x() : d.y());
  }
  const Index first = row.terms.front().first;
  const auto& coordinates = start_.coordinates;
  const bool arm_term = row.source == ConstraintRow::Source::rigid_body && term == 2 &&
                        !coordinates.is_rotation[static_cast<std::size_t>(first)];
  if (!arm_term) return order == 0 ? row.terms[term].second : 0.0;
  const auto body = static_cast<std::size_t>(row.index);
  const Index node = coordinates.node_of[static_cast<std::size_t>(first)];
  const Vector2d arm =
      start_.mesh.positions[static_cast<std::size_t>(node)] -
      start_.mesh.positions[static_cast<std::size_t>(start_.model.rigid_bodies[body].reference)];
  const Vector2d now = derivative(arm, motion.rigid_body[body], order);
  return first == coordinates.node[static_cast<std::size_t>(node)][0] ? now.y() : -now.x();
}

bool MovingSystem::constraints_move(const NominalMotion& motion) const {
  const auto moves = [this](const PartMotion& to, const PartMotion& from) {
    return to.angle != from.angle ||
           (gyroscopic_ && (to.rate != from.rate || to.acceleration != from.acceleration));
  };
  for (const ConstraintRow& row : constraints_.rows) {
    if (row.source == ConstraintRow::Source::inextensible) {
      const auto member =
          static_cast<std::size_t>(start_.mesh.frame[static_cast<std::size_t>(row.index)].member);
      if (moves(motion.member[member], motion_.member[member])) return true;
    } else if (row.source == ConstraintRow::Source::rigid_body) {
      const auto body = static_cast<std::size_t>(row.index);
      if (moves(motion.rigid_body[body], motion_.rigid_body[body])) return true;
    }
  }
  return false;
}

/// X of C_p X = - C_f: what the eliminated coordinates are of the free ones; kept row x q.
MatrixXd MovingSystem::dependent_coordinates(const NominalMotion& motion) {
  const auto k = static_cast<Index>(dependent_rows_.size());
  MatrixXd pivots = MatrixXd::Zero(k, k);
  MatrixXd rhs = MatrixXd::Zero(k, constraints_.T.cols());
  for (Index i = 0; i < k; ++i) {
    const ConstraintRow& row = constraints_.rows[dependent_rows_[static_cast<std::size_t>(i)]];
    for (std::size_t t = 0; t < row.terms.size(); ++t) {
      const auto u = static_cast<std::size_t>(row.terms[t].first);
      const double c = coefficient(row, t, motion, 0);
      if (dependent_row_of_[u] >= 0) pivots(i, dependent_row_of_[u]) += c;
      if (constraints_.free[u] >= 0) rhs(i, constraints_.free[u]) -= c;
    }
  }
  pivots_.compute(pivots);
  return pivots_.solve(rhs);
}

/// C T = 0 with the pivots of the start, and its derivatives: C_p X = - C_f,
/// C_p X. = - C. T, C_p X.. = - C.. T - 2 C. T..
Outcome MovingSystem::solve_constraints(const NominalMotion& motion) {
  auto& T = constraints_.T;
  const MatrixXd X = dependent_coordinates(motion);
  if (!(X.allFinite() && X.cwiseAbs().maxCoeff() < kLargestT)) {
    return {Status::singular,
            "the coordinates that the constraints eliminated at the start do not suit this pose"};
  }
  for (const std::size_t r :
       dependent_rows_) {  // only now, so that what is refused leaves no trace
    ConstraintRow& row = constraints_.rows[r];
    for (std::size_t t = 0; t < row.terms.size(); ++t) {
      row.terms[t].second = coefficient(row, t, motion, 0);
    }
  }
  const auto store = [&](const MatrixXd& values, RowMajorMatrix& target) {
    for (Index u = 0; u < target.rows(); ++u) {
      const Index row = dependent_row_of_[static_cast<std::size_t>(u)];
      if (row < 0) continue;
      for (RowMajorMatrix::InnerIterator it(target, u); it; ++it) {
        it.valueRef() = values(row, it.col());
      }
    }
  };
  store(X, T);
  if (!gyroscopic_) return {};
  const auto product = [&](int order, const RowMajorMatrix& matrix) {
    MatrixXd sum = MatrixXd::Zero(X.rows(), X.cols());
    for (Index i = 0; i < X.rows(); ++i) {
      const ConstraintRow& row = constraints_.rows[dependent_rows_[static_cast<std::size_t>(i)]];
      for (std::size_t t = 0; t < row.terms.size(); ++t) {
        const double c = coefficient(row, t, motion, order);
        if (c != 0) sum.row(i) += c * matrix.row(row.terms[t].first);
      }
    }
    return sum;
  };
  store(pivots_.solve(-product(1, T)), T_dot_);
  store(pivots_.solve(-product(2, T) - 2 * product(1, T_dot_)), T_ddot_);
  return {};
}

// ---- poses
// -----------------------------------------------------------------------------------------

PartMotion MovingSystem::part_of(const Element& element) const {
  return element.part ? (motion_.*element.part)[element.part_index] : PartMotion{};
}

/// Q A Q^T with Q the rotation of the element's coordinates.
Matrix6d MovingSystem::rotated_matrix(const Element& element, const Matrix6d& A,
                                      double turn) const {
  if (turn == 0 || element.layout == Layout::scalar) return A;
  Matrix6d B = A;
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  const Index step = element.layout == Layout::triangle ? 2 : 3;
  for (Index i = 0; i + 1 < 6; i += step) {
    const Eigen::Matrix<double, 1, 6> x = c * B.row(i) - s * B.row(i + 1);
    B.row(i + 1) = s * B.row(i) + c * B.row(i + 1);
    B.row(i) = x;
  }
  for (Index i = 0; i + 1 < 6; i += step) {
    const Vector6d x = c * B.col(i) - s * B.col(i + 1);
    B.col(i + 1) = s * B.col(i) + c * B.col(i + 1);
    B.col(i) = x;
  }
  return B;
}

/// The element's share of r..: an affine field, which the interpolation holds exactly.
Vector6d MovingSystem::nominal_acceleration(const Element& element) const {
  Vector6d a = Vector6d::Zero();
  const Index step = element.layout == Layout::triangle ? 2 : 3;
  const double alpha = part_of(element).acceleration;
  for (Index i = 0; i < 6; ++i) {
    const Index u = element.coordinates[static_cast<std::size_t>(i)];
    if (u < 0) continue;
    const Index component = element.layout == Layout::scalar ? 2 : i % step;
    if (component == 2) {
      a[i] = alpha;
      continue;
    }
    const auto node =
        static_cast<std::size_t>(start_.coordinates.node_of[static_cast<std::size_t>(u)]);
    const double s = fraction_[node];
    a[i] = (1 - s) * motion_.acceleration(span_[node][0], component) +
           s * motion_.acceleration(span_[node][1], component);
  }
  return a;
}

Vector2d MovingSystem::position(Index mesh_node) const {
  const auto node = static_cast<std::size_t>(mesh_node);
  const double s = fraction_[node];
  return (1 - s) * motion_.position.row(span_[node][0]).transpose() +
         s * motion_.position.row(span_[node][1]).transpose();
}

Vector6d MovingSystem::weight(const Element& element, const Matrix6d& m) const {
  Vector6d g = Vector6d::Zero();
  if (element.layout == Layout::scalar || motion_.gravity.isZero(0)) return g;
  const Index step = element.layout == Layout::triangle ? 2 : 3;
  for (Index i = 0; i + 1 < 6; i += step) g.segment<2>(i) = motion_.gravity;
  return m * g;
}

/// Load of nominal inertia on the element, with the centripetal part of a mass off its node.
Vector6d MovingSystem::element_inertia_load(const Element& element, const Matrix6d& m) const {
  Vector6d f = -m * nominal_acceleration(element);
  if (element.layout == Layout::point_mass) {
    const PartMotion part = part_of(element);
    f.head<2>() += part.rate * part.rate * rotated(element.first_moment, part.angle);
  }
  return f;
}

Outcome MovingSystem::move_to(const NominalMotion& motion) {
  if (T_is_variable_ && constraints_move(motion)) {
    const Outcome outcome = solve_constraints(motion);
    if (!outcome.solved()) return outcome;
  }
  motion_ = motion;
  const double* const T = constraints_.T.valuePtr();
  std::fill_n(K_.valuePtr(), K_.nonZeros(), 0.0);
  if (inertia_) std::fill_n(M_.valuePtr(), M_.nonZeros(), 0.0);
  if (gyroscopic_) {
    std::fill_n(C_gyroscopic_.valuePtr(), K_.nonZeros(), 0.0);
    std::fill_n(K_centrifugal_euler_.valuePtr(), K_.nonZeros(), 0.0);
  }
  inertia_u_.setZero();
  load_u_ = start_.load;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    const PartMotion part = part_of(element);
    const Matrix6d k = rotated_matrix(element, element.k, part.angle);
    const Matrix6d m = rotated_matrix(element, element.m, part.angle);
    const std::size_t end =
        e + 1 < elements_.size() ? elements_[e + 1].first_contribution : contributions_.size();
    for (std::size_t t = element.first_contribution; t < end; ++t) {
      const Contribution& contribution = contributions_[t];
      const double factor = T[contribution.a] * T[contribution.b];
      K_.valuePtr()[contribution.destination] += factor * k(contribution.local);
      if (inertia_) M_.valuePtr()[contribution.destination] += factor * m(contribution.local);
    }
    if (gyroscopic_) add_gyroscopic(element, part, m, end);
    const Vector6d f = element_inertia_load(element, m);
    const Vector6d w = weight(element, m);
    for (Index i = 0; i < 6; ++i) {
      const Index u = element.coordinates[static_cast<std::size_t>(i)];
      if (u < 0) continue;
      inertia_u_[u] += f[i];
      load_u_[u] += w[i];
    }
  }
  inertia_load_.noalias() = constraints_.T.transpose() * inertia_u_;
  load_.noalias() = constraints_.T.transpose() * load_u_;
  return {};
}

void MovingSystem::add_gyroscopic(const Element& element, const PartMotion& part, const Matrix6d& m,
                                  std::size_t end) {
  const Matrix6d first_derivative = rotated_matrix(element, element.first_derivative, part.angle);
  const Matrix6d second_derivative = rotated_matrix(element, element.second_derivative, part.angle);
  const Matrix6d c = 2 * part.rate * first_derivative;
  const Matrix6d s =
      part.acceleration * first_derivative + part.rate * part.rate * second_derivative;
  const double* const T = constraints_.T.valuePtr();
  for (std::size_t t = element.first_contribution; t < end; ++t) {
    const Contribution& contribution = contributions_[t];
    const double a = T[contribution.a];
    const double b = T[contribution.b];
    const double b_dot = T_is_variable_ ? T_dot_.valuePtr()[contribution.b] : 0;
    const double b_ddot = T_is_variable_ ? T_ddot_.valuePtr()[contribution.b] : 0;
    C_gyroscopic_.valuePtr()[contribution.destination] +=
        a * (2 * m(contribution.local) * b_dot + c(contribution.local) * b);
    K_centrifugal_euler_.valuePtr()[contribution.destination] +=
        a * (m(contribution.local) * b_ddot + c(contribution.local) * b_dot +
             s(contribution.local) * b);
  }
}

MovingSystem::Forces MovingSystem::forces(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                                          double mass_damping, double stiffness_damping,
                                          bool with_inertia) const {
  const auto& T = constraints_.T;
  const VectorXd u = T * q;
  const VectorXd u_dot = T * v;
  VectorXd u_ddot = T * a + mass_damping * u_dot;
  VectorXd convected = VectorXd::Zero(u.size());  // the velocity that turns
  if (gyroscopic_) {
    convected = u_dot;
    if (T_is_variable_) {
      convected += T_dot_ * q;
      u_ddot += 2 * (T_dot_ * v) + T_ddot_ * q;
    }
  }
  Forces forces;
  forces.element.setZero(6, static_cast<Index>(start_.mesh.frame.size()));
  forces.total = -start_.load;
  forces.external = start_.load;
  const VectorXd strained = u + stiffness_damping * u_dot;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    const PartMotion part = part_of(element);
    const Matrix6d m = rotated_matrix(element, element.m, part.angle);
    Vector6d inertia = m * detail::gather(element.coordinates, u_ddot);
    if (gyroscopic_) {
      const Matrix6d first_derivative =
          rotated_matrix(element, element.first_derivative, part.angle);
      const Matrix6d second_derivative =
          rotated_matrix(element, element.second_derivative, part.angle);
      const Vector6d local = detail::gather(element.coordinates, u);
      inertia +=
          2 * part.rate * (first_derivative * detail::gather(element.coordinates, convected)) +
          part.acceleration * (first_derivative * local) +
          part.rate * part.rate * (second_derivative * local);
    }
    if (with_inertia) inertia -= element_inertia_load(element, m);
    inertia -= weight(element, m);
    const Vector6d f = rotated_matrix(element, element.k, part.angle) *
                           detail::gather(element.coordinates, strained) +
                       inertia;
    for (Index i = 0; i < 6; ++i) {
      const Index c = element.coordinates[static_cast<std::size_t>(i)];
      if (c < 0) continue;
      forces.total[c] += f[i];
      forces.external[c] -= inertia[i];
    }
    if (element.layout != Layout::frame) continue;
    const FrameElement& frame = start_.mesh.frame[e];  // the frame elements come first
    forces.element.col(static_cast<Index>(e)) =
        frame_rotation(rotated(frame.direction, part.angle)) * f;
  }
  return forces;
}

}  // namespace trammel::solver
