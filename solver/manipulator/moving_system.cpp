#include "solver/manipulator/moving_system.h"

#include <algorithm>
#include <cmath>

#include "solver/linear/element_operators.h"
#include "solver/manipulator/moving_element.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

NominalMotion nominal_motion_at_start(const Model& model) {
  NominalMotion motion;
  const Index nodes = std::ssize(model.nodes);
  for (Eigen::MatrixX2d& values : motion.node) values.setZero(nodes, 2);
  for (Index i = 0; i < nodes; ++i) motion.node[0].row(i) = model.nodes[to_size(i)].position;
  motion.part.resize(to_size(body_part_index(model, std::ssize(model.rigid_bodies))));
  return motion;
}

System assemble_at_start(Model model, const MovingSystemOptions& options) {
  if (options.condensed) {
    for (Member& member : model.members) member.elements = 1;
  }
  const Effects all = Effects::all();
  return assemble(model, options.inertia ? all : all.without(Effect::inertia));
}

/// Condenses each member. Equal members are condensed once.
std::vector<LinkSuperelement> condense_members(const Model& model, const Mesh& mesh) {
  std::vector<LinkSuperelement> links;
  const auto numbers = [&](std::size_t i) {
    const Member& m = model.members[i];
    const Section& s = m.section;
    return std::tie(s.EA, s.EI, s.kappa_GA, s.mass_per_length, s.inertia_per_length, m.theory,
                    m.mass, m.axially_flexible, m.elements, mesh.frame[i].length);
  };
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    std::size_t same = 0;
    while (same < i && numbers(same) != numbers(i)) ++same;
    links.push_back(same < i ? links[same]
                             : condense_member(model.members[i], mesh.frame[i].length));
  }
  return links;
}

/// Calls visit(local, a, b, row, column) for each product T(a) A(local) T(b) that contributes to
/// the entry (row, column) of T^T A T, where A is an element matrix. The entry (i, j) of A has the
/// position local = i + 6 j. The positions a and b refer to the array of the values of T.
template <class Visit>
void for_each_contribution(const MovingElement& element, const RowMajorMatrix& T, Visit&& visit) {
  for (int i = 0; i < 6; ++i) {
    const Index u = element.coordinates[to_size(i)];
    for (int j = 0; j < 6 && u >= 0; ++j) {
      const Index w = element.coordinates[to_size(j)];
      if (w < 0) continue;
      for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a) {
        for (int b = T.outerIndexPtr()[w]; b < T.outerIndexPtr()[w + 1]; ++b)
          visit(i + 6 * j, a, b, T.innerIndexPtr()[a], T.innerIndexPtr()[b]);
      }
    }
  }
}

/// Returns the values of the coordinates of an element in element axes.
Vector6d gather_local(const MovingElement& element, const Vector2d& direction, const VectorXd& u) {
  Eigen::Matrix<double, 1, 6> v = detail::gather(element.coordinates, u).transpose();
  element.to_element_axes(v, direction);
  return v.transpose();
}

/// Adds the forces of an element, given in element axes, to the vector `u` of forces on the
/// unconstrained coordinates, in world axes.
void scatter_local(const MovingElement& element, const Vector2d& direction, const Vector6d& force,
                   VectorXd& u) {
  Eigen::Matrix<double, 1, 6> f = force.transpose();
  element.to_world(f, direction);
  detail::scatter(element.coordinates, f.transpose().eval(), u);
}

}  // namespace

MovingSystem::MovingSystem(const Model& model, const MovingSystemOptions& options)
    : options_(options),
      start_(assemble_at_start(model, options)),
      motion_(nominal_motion_at_start(model)),
      constraints_(start_, motion_, options.gyroscopic) {
  if (options_.condensed) links_ = condense_members(model, start_.mesh);
  elements_ = moving_elements(start_, links_);
  locate_mesh_nodes();
  find_pattern();
  inertia_u_.setZero(start_.coordinates.size);
  inertia_load_.setZero(K_.rows());
  load_.setZero(K_.rows());
  static_cast<void>(move_to(NominalMotion(motion_)));
}

void MovingSystem::locate_mesh_nodes() {
  const Model& model = start_.model;
  span_.resize(start_.mesh.positions.size());
  for (Index i = 0; i < std::ssize(model.nodes); ++i) span_[to_size(i)].nodes = {i, i};
  Index before = -1, done = 0;
  for (const FrameElement& e : start_.mesh.frame) {
    const Member& member = model.members[to_size(e.member)];
    done = e.member == before ? done + 1 : 1;
    before = e.member;
    // The second node of the last element is the end of the member.
    if (done == member.elements) continue;
    span_[to_size(e.nodes[1])] = {member.nodes,
                                  static_cast<double>(done) / static_cast<double>(member.elements)};
  }
}

/// Finds the sparsity pattern of the matrices: all entries that are nonzero at any pose.
void MovingSystem::find_pattern() {
  const RowMajorMatrix& T = constraints_.T();
  std::vector<Eigen::Triplet<double>> places;
  for (int i = 0; i < static_cast<int>(T.cols()); ++i) places.emplace_back(i, i, 0.0);
  for (const MovingElement& element : elements_) {
    for_each_contribution(element, T, [&](int, int, int, int row, int column) {
      places.emplace_back(row, column, 0.0);
    });
  }
  K_.resize(T.cols(), T.cols());
  K_.setFromTriplets(places.begin(), places.end());
  K_.makeCompressed();
  contributions_.reserve(places.size());
  for (const MovingElement& element : elements_) {
    first_contribution_.push_back(contributions_.size());
    for_each_contribution(element, T, [&](int local, int a, int b, int row, int column) {
      const int* const begin = K_.innerIndexPtr() + K_.outerIndexPtr()[column];
      const int* const end = K_.innerIndexPtr() + K_.outerIndexPtr()[column + 1];
      const auto place = std::lower_bound(begin, end, row) - K_.innerIndexPtr();
      contributions_.push_back({local, a, b, static_cast<int>(place)});
    });
  }
  first_contribution_.push_back(contributions_.size());
  if (options_.inertia) M_ = K_;
  if (options_.gyroscopic) C_gyroscopic_ = K_centrifugal_euler_ = K_T_dot_ = M_T_dot_ = K_;
}

Vector2d MovingSystem::interpolate_at_mesh_node(Index mesh_node,
                                                const Eigen::MatrixX2d& values) const {
  const auto& [nodes, s] = span_[to_size(mesh_node)];
  return (1 - s) * values.row(nodes[0]).transpose() + s * values.row(nodes[1]).transpose();
}

/// Returns the inertia load of the nominal motion on an element, in element axes. The nominal
/// acceleration is an affine field, which the interpolation represents exactly. A point mass that
/// is offset from its node adds a centrifugal force.
Vector6d MovingSystem::element_inertia_load(const MovingElement& element, const PartMotion& part,
                                            const Vector2d& direction) const {
  Eigen::Matrix<double, 1, 6> a = Eigen::Matrix<double, 1, 6>::Zero();
  for (Index i = 0; i < 6; ++i) {
    const Index u = element.coordinates[to_size(i)];
    if (u < 0) continue;
    const bool rotation =
        element.layout == MovingElement::Layout::scalar || i % element.coordinates_per_node() == 2;
    a[i] = rotation ? part.acceleration
                    : interpolate_at_mesh_node(start_.coordinates.node_of[to_size(u)],
                                               motion_.node[2])[i % element.coordinates_per_node()];
  }
  element.to_element_axes(a, direction);
  Vector6d f = -element.m * a.transpose();
  f.head<2>() += part.rate * part.rate * element.first_moment;
  return f;
}

/// Returns the nodal forces of the weight of an element, in element axes.
Vector6d MovingSystem::weight(const MovingElement& element, const Vector2d& direction) const {
  Eigen::Matrix<double, 1, 6> g = Eigen::Matrix<double, 1, 6>::Zero();
  if (element.layout == MovingElement::Layout::scalar || motion_.gravity.isZero(0))
    return Vector6d::Zero();
  for (Index i = 0; i + 1 < 6; i += element.coordinates_per_node())
    g.segment<2>(i) = motion_.gravity;
  element.to_element_axes(g, direction);
  return element.m * g.transpose();
}

Outcome MovingSystem::move_to(const NominalMotion& motion) {
  const Outcome outcome = constraints_.update_transformation(start_, motion_, motion);
  if (!outcome.solved()) return outcome;
  motion_ = motion;
  for (SparseMatrix* A : {&K_, &M_, &C_gyroscopic_, &K_centrifugal_euler_, &K_T_dot_, &M_T_dot_})
    std::fill_n(A->valuePtr(), A->nonZeros(), 0.0);
  for (std::size_t e = 0; e < elements_.size(); ++e) add_matrices(e);
  if (options_.condensed) return {};
  inertia_u_.setZero();
  load_u_ = motion_.load_factor * start_.load;
  for (const MovingElement& element : elements_) add_loads(element);
  inertia_load_.noalias() = constraints_.T().transpose() * inertia_u_;
  load_.noalias() = constraints_.T().transpose() * load_u_;
  return {};
}

void MovingSystem::add_loads(const MovingElement& element) {
  const Vector2d direction = element.axis_direction(motion_);
  scatter_local(element, direction,
                element_inertia_load(element, element.part_motion(motion_), direction), inertia_u_);
  scatter_local(element, direction, weight(element, direction), load_u_);
}

void MovingSystem::add_matrices(std::size_t index) {
  const MovingElement& element = elements_[index];
  const Vector2d direction = element.axis_direction(motion_);
  const Matrix6d k = element.matrix_in_world_axes(element.k, direction);
  const Matrix6d m = element.matrix_in_world_axes(element.m, direction);
  const double* const T = constraints_.T().valuePtr();
  double* const K = K_.valuePtr();
  double* const M = options_.inertia ? M_.valuePtr() : nullptr;
  for (std::size_t t = first_contribution_[index]; t < first_contribution_[index + 1]; ++t) {
    const auto [local, a, b, destination] = contributions_[t];
    const double factor = T[a] * T[b];
    K[destination] += factor * k(local);
    if (M != nullptr) M[destination] += factor * m(local);
  }
  if (options_.gyroscopic) add_gyroscopic_matrices(index, k, m);
}

void MovingSystem::add_gyroscopic_matrices(std::size_t index, const Matrix6d& k,
                                           const Matrix6d& m) {
  const MovingElement& element = elements_[index];
  const PartMotion part = element.part_motion(motion_);
  const Vector2d direction = element.axis_direction(motion_);
  const auto first_derivative = element.matrix_in_world_axes(element.first_derivative, direction);
  const auto second_derivative = element.matrix_in_world_axes(element.second_derivative, direction);
  const Matrix6d c = 2 * part.rate * first_derivative;
  const Matrix6d s =
      part.acceleration * first_derivative + part.rate * part.rate * second_derivative;
  const double* const T = constraints_.T().valuePtr();
  const bool variable = constraints_.is_pose_dependent();
  for (std::size_t t = first_contribution_[index]; t < first_contribution_[index + 1]; ++t) {
    const Contribution& at = contributions_[t];
    const double a = T[at.a];
    const double b = T[at.b];
    const double b_dot = variable ? constraints_.T_dot().valuePtr()[at.b] : 0;
    const double b_ddot = variable ? constraints_.T_ddot().valuePtr()[at.b] : 0;
    C_gyroscopic_.valuePtr()[at.destination] += a * (2 * m(at.local) * b_dot + c(at.local) * b);
    K_centrifugal_euler_.valuePtr()[at.destination] +=
        a * (m(at.local) * b_ddot + c(at.local) * b_dot + s(at.local) * b);
    K_T_dot_.valuePtr()[at.destination] += a * k(at.local) * b_dot;
    M_T_dot_.valuePtr()[at.destination] += a * m(at.local) * b_dot;
  }
}

MovingSystem::Forces MovingSystem::forces(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                                          const RayleighDamping& damping, bool with_inertia) const {
  const auto& T = constraints_.T();
  Forces forces;
  forces.working = {.u = T * q, .load = load_u_, .drag = VectorXd::Zero(load_u_.size())};
  if (with_inertia) forces.working.load += inertia_u_;
  VectorXd u_dot = T * v, u_ddot = T * a;
  if (options_.gyroscopic && constraints_.is_pose_dependent()) {
    u_dot += constraints_.T_dot() * q;
    u_ddot += 2 * (constraints_.T_dot() * v) + constraints_.T_ddot() * q;
  }
  forces.element.setZero(6, static_cast<Index>(start_.mesh.frame.size()));
  forces.external = motion_.load_factor * start_.load;
  forces.total = -forces.external;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const MovingElement& element = elements_[e];
    const PartMotion part = element.part_motion(motion_);
    const Vector2d direction = element.axis_direction(motion_);
    const Vector6d u = gather_local(element, direction, forces.working.u);
    const Vector6d velocity = gather_local(element, direction, u_dot);
    const Vector6d strain_force = element.k * u, momentum = element.m * velocity;
    const Vector6d strain_drag = damping.stiffness * (element.k * velocity);
    const Vector6d mass_drag = damping.mass * momentum;
    Vector6d inertia = element.m * gather_local(element, direction, u_ddot) + mass_drag;
    if (options_.gyroscopic)
      inertia += 2 * part.rate * (element.first_derivative * velocity) +
                 part.acceleration * (element.first_derivative * u) +
                 part.rate * part.rate * (element.second_derivative * u);
    if (with_inertia) inertia -= element_inertia_load(element, part, direction);
    inertia -= weight(element, direction);
    const Vector6d f = strain_force + strain_drag + inertia;
    forces.working.strain += u.dot(strain_force) / 2;
    forces.working.kinetic += velocity.dot(momentum) / 2;
    scatter_local(element, direction, mass_drag + strain_drag, forces.working.drag);
    scatter_local(element, direction, f, forces.total);
    scatter_local(element, direction, -inertia, forces.external);
    // Frame elements precede all other elements, so that e is the index of the frame element.
    if (element.layout == MovingElement::Layout::frame)
      forces.element.col(static_cast<Index>(e)) = f;
  }
  return forces;
}

namespace {

/// Smallest ratio of a pivot to the diagonal element in its row for which the stiffness matrix is
/// treated as regular.
constexpr double kSingularPivotRatio = 1e-13;

Model model_with_loads_at_time(const ElastodynamicsOptions& options, double time) {
  Model model = build_manipulator(options.design, at(options.path, time).pose);
  if (!options.wrench.isZero(0)) model.loads.push_back({model.find_node("P"), options.wrench});
  return model;
}

}  // namespace

PathFollower::PathFollower(const ElastodynamicsOptions& options, double built_at)
    : options_(options),
      is_at_rest_(solver::is_at_rest(options.path)),
      rigid_(rigid_manipulator(options.design)),
      moving_(model_with_loads_at_time(options, built_at),
              {.inertia = options.elastic_inertia, .gyroscopic = options.gyroscopic}) {
  rigid_.gravity = options.gravity;
  start_ = inverse_dynamics(rigid_, at(options.path, built_at), wrench(built_at)).q;
}

bool PathFollower::update_to(double time) {
  if (time == time_) return outcome_.solved();
  if (is_at_rest_ && options_.load_history.is_constant() && !std::isnan(time_)) {
    point_.time = time;
  } else {
    outcome_ = move_to(time, options_.gravity);
    if (!outcome_.solved())
      outcome_.reason = "at t = " + std::to_string(time) + " s: " + outcome_.reason;
  }
  time_ = time;
  return outcome_.solved();
}

Outcome PathFollower::move_to(double time, const Vector2d& gravity) {
  time_ = kNaN;
  factored_ = false;
  point_ = at(options_.path, time);
  dynamics_ = inverse_dynamics(rigid_, point_, wrench(time));
  if (!dynamics_.outcome.solved()) return dynamics_.outcome;
  NominalMotion motion = nominal_motion(moving_.start().model, dynamics_, start_, point_, gravity);
  motion.load_factor = options_.load_history.at(time);
  return moving_.move_to(motion);
}

Vector3d PathFollower::wrench(double time) const {
  return options_.load_history.at(time) * options_.wrench;
}

bool PathFollower::is_damped() const {
  return options_.damping.mass != 0 || options_.damping.stiffness != 0;
}

VectorXd PathFollower::load() const {
  VectorXd f = moving_.external_load();
  if (options_.nominal_inertia) f += moving_.inertia_load();
  return f;
}

void PathFollower::compute_matrices(SparseMatrix& M, SparseMatrix& C, SparseMatrix& K) {
  K.coeffs() = moving_.K().coeffs();
  M.coeffs().setZero();
  if (options_.elastic_inertia) M.coeffs() = moving_.M().coeffs();
  const auto [mass, stiffness] = options_.damping;
  if (is_damped() || options_.gyroscopic)
    C.coeffs() = mass * M.coeffs() + stiffness * moving_.K().coeffs();
  if (is_damped()) counters_.add(Effect::damping, 1);
  if (!options_.gyroscopic) return;
  counters_.add(Effect::gyroscopic, 1);
  C.coeffs() += moving_.gyroscopic_matrix().coeffs();
  K.coeffs() += moving_.centrifugal_and_euler_matrix().coeffs() +
                mass * moving_.M_T_dot().coeffs() + stiffness * moving_.K_T_dot().coeffs();
}

bool PathFollower::solve_statically(const VectorXd& f, VectorXd& q) {
  if (!factored_) {
    factored_ = true;
    ++counters_.factorizations;
    regular_ = stiffness_.factorize(moving_.K()) &&
               stiffness_.smallest_pivot_to_diagonal() > kSingularPivotRatio;
  }
  if (!regular_) return false;
  ++counters_.solves;
  stiffness_.solve(f, q);
  return true;
}

double PathFollower::energy_norm(const VectorXd& f) {
  VectorXd q;
  return solve_statically(f, q) ? std::sqrt(std::max(0.0, f.dot(q))) : kNaN;
}

Vector3d PathFollower::rigid_torque() const {
  if (options_.nominal_inertia) return dynamics_.torque;
  TrajectoryPoint still = point_;
  still.velocity.setZero();
  still.acceleration.setZero();
  return inverse_dynamics(rigid_, still, wrench(point_.time)).torque;
}

Counters PathFollower::counters() const {
  Counters all = counters_;
  all.element_evaluations += moving_.evaluations_per_pose();
  all.effects = moving_.start().counters.effects;
  for (std::size_t i = 0; i < kEffectCount; ++i) all.effects[i] += counters_.effects[i];
  if (!options_.gravity.isZero(0)) all.add(Effect::gravity, 1);
  return all;
}

}  // namespace trammel::solver
