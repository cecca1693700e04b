#include "solver/large_motion/system/geometrically_exact_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/assembly/validate.h"
#include "solver/elements/edge_load.h"
#include "solver/large_motion/system/element_groups.h"
#include "solver/large_motion/system/linear_constraints.h"
#include "solver/large_motion/system/member_beam.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

double model_size(const Model& model) {
  if (model.nodes.empty()) return 1;
  Vector2d low = model.nodes.front().position, high = low;
  for (const Node& node : model.nodes) {
    low = low.cwiseMin(node.position);
    high = high.cwiseMax(node.position);
  }
  for (const PointMass& mass : model.masses) {
    const Vector2d centre = model.nodes[to_size(mass.node)].position + mass.offset;
    low = low.cwiseMin(centre);
    high = high.cwiseMax(centre);
  }
  const double size = (high - low).norm();
  return size > 0 ? size : 1;
}

/// Numbers what has passed every check.
Layout validated_layout(const Model& model, const LargeMotionModel& large_motion, int order) {
  validate(model);
  validate(large_motion, model);
  if (order < 1 || order > 3) throw ModelError("the degree of beam elements is 1, 2 or 3");
  return number_coordinates(model, large_motion, order);
}

}  // namespace

GeometricallyExactSystem::GeometricallyExactSystem(Model model, LargeMotionModel large_motion,
                                                   const GeometricallyExactOptions& options)
    : model_(std::move(model)),
      large_motion_(std::move(large_motion)),
      order_(options.order),
      layout_(validated_layout(model_, large_motion_, options.order)) {
  gravity_ = VectorXd::Zero(layout_.total);
  loads_ = VectorXd::Zero(layout_.total);
  add_members();
  add_plates();
  add_springs();
  add_masses();
  add_joints();
  add_drives();
  add_linear_constraints();
  add_loads();
  finalize();
}

void GeometricallyExactSystem::add_members() {
  element_row_.assign(layout_.elements.size(), -1);
  if (order_ == 1) add_beams<1>();
  if (order_ == 2) add_beams<2>();
  if (order_ == 3) add_beams<3>();
  add_bars();
  add_end_inertias();
}

template <int P>
void GeometricallyExactSystem::add_beams() {
  auto group = std::make_unique<ConstraintElements<Beam<P>>>(layout_.free, rows_);
  for (std::size_t e = 0; e < layout_.elements.size(); ++e) {
    const MemberElement& element = layout_.elements[e];
    if (element.is_bar()) continue;
    const Member& member = model_.members[to_size(element.member)];
    const Beam<P> beam = make_beam<P>(member, element);
    std::array<Index, 3 * (P + 1)> where{};
    std::copy(element.coordinates.begin(), element.coordinates.end(), where.begin());
    add_masses_of<Beam<P>::N>(beam.mass(), where);
    for (int a = 0; a <= P; ++a) {
      for (int k = 0; k < 2; ++k) {
        loads_[where[to_size(3 * a + k)]] +=
            beam.length * shape_functions<P>().integral[a] * member.load[k];
      }
    }
    element_row_[e] = rows_;
    rows_ += Beam<P>::R;
    group->add(beam, where);
  }
  if (group->size() > 0) element_groups_.push_back(std::move(group));
}

void GeometricallyExactSystem::add_bars() {
  auto group = std::make_unique<ConstraintElements<Bar>>(layout_.free, rows_);
  for (std::size_t e = 0; e < layout_.elements.size(); ++e) {
    const MemberElement& element = layout_.elements[e];
    if (!element.is_bar()) continue;
    const Member& member = model_.members[to_size(element.member)];
    Bar bar;
    bar.offset = element.end - element.start;
    bar.flexibility = member.axially_flexible ? element.length() / element.section.EA : 0.0;
    bar.total_mass = element.length() * element.section.mass_per_length;
    bar.lumped = member.mass == MassMatrix::lumped;
    std::array<Index, 4> where{};
    std::copy(element.coordinates.begin(), element.coordinates.end(), where.begin());
    add_masses_of<4>(bar.mass(), where);
    for (std::size_t i = 0; i < 4; ++i) {
      loads_[where[i]] += element.length() / 2 * member.load[static_cast<Index>(i % 2)];
    }
    element_row_[e] = rows_++;
    group->add(bar, where);
  }
  if (group->size() > 0) element_groups_.push_back(std::move(group));
}

void GeometricallyExactSystem::add_end_inertias() {
  for (std::size_t m = 0; m < model_.members.size(); ++m) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double inertia = model_.members[m].ends[end].inertia;
      if (inertia != 0) point_mass_.emplace_back(layout_.end_rotation[m][end], inertia);
    }
  }
}

template <int N>
void GeometricallyExactSystem::add_masses_of(const Eigen::Matrix<double, N, N>& mass,
                                             const std::array<Index, N>& where) {
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) {
      if (mass(i, j) != 0)
        mass_entries_.emplace_back(where[to_size(i)], where[to_size(j)], mass(i, j));
    }
  }
}

void GeometricallyExactSystem::add_plates() {
  auto linear = std::make_unique<EnergyElements<Triangle2d<3>>>(layout_.free);
  auto quadratic = std::make_unique<EnergyElements<Triangle2d<6>>>(layout_.free);
  const auto add = [&](const Triangle& triangle, auto& group, auto count) {
    constexpr int nodes = decltype(count)::value;
    std::array<Vector2d, nodes> corners;
    std::array<Index, 2 * nodes> where{};
    for (std::size_t a = 0; a < nodes; ++a) {
      corners[a] = model_.nodes[to_size(triangle.nodes[a])].position;
      where[2 * a] = layout_.node[to_size(triangle.nodes[a])][0];
      where[2 * a + 1] = layout_.node[to_size(triangle.nodes[a])][1];
    }
    const Plate& plate = model_.plates[to_size(triangle.plate)];
    const Triangle2d<nodes> element(plate.material, plate.thickness, corners);
    add_masses_of<2 * nodes>(element.mass(), where);
    group->add(element, where);
  };
  for (const Triangle& triangle : model_.triangles) {
    if (triangle.quadratic()) {
      add(triangle, quadratic, std::integral_constant<int, 6>());
    } else {
      add(triangle, linear, std::integral_constant<int, 3>());
    }
  }
  if (linear->size() > 0) element_groups_.push_back(std::move(linear));
  if (quadratic->size() > 0) element_groups_.push_back(std::move(quadratic));
}

void GeometricallyExactSystem::add_springs() {
  auto group = std::make_unique<EnergyElements<CoordinateSpring>>(layout_.free);
  for (const Spring& spring : model_.springs) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double stiffness = spring.stiffness[static_cast<Index>(k)];
      if (stiffness == 0) continue;
      const auto index_of = [&](Index node) {
        return node < 0 ? Index{-1} : layout_.node[to_size(node)][k];
      };
      group->add({stiffness}, {index_of(spring.nodes[0]), index_of(spring.nodes[1])});
    }
  }
  for (std::size_t m = 0; m < model_.members.size(); ++m) {
    for (std::size_t end = 0; end < 2; ++end) {
      const MemberEnd& fixity = model_.members[m].ends[end];
      if (fixity.fixity != EndFixity::sprung) continue;
      const Index node = layout_.node[to_size(model_.members[m].nodes[end])][2];
      group->add({fixity.stiffness}, {node, layout_.end_rotation[m][end]});
    }
  }
  if (group->size() > 0) element_groups_.push_back(std::move(group));
}

void GeometricallyExactSystem::add_masses() {
  auto links = std::make_unique<ConstraintElements<RigidLink>>(layout_.free, rows_);
  for (std::size_t i = 0; i < model_.masses.size(); ++i) {
    const PointMass& mass = model_.masses[i];
    const std::array<Index, 3>& node = layout_.node[to_size(mass.node)];
    const std::array<Index, 2>& centre = layout_.mass_centre[i];
    for (const Index k : centre) point_mass_.emplace_back(k, mass.mass);
    if (mass.inertia != 0) point_mass_.emplace_back(node[2], mass.inertia);
    if (mass.offset.isZero(0)) continue;
    RigidLink link;
    link.offset = mass.offset;
    links->add(link, {node[0], node[1], node[2], centre[0], centre[1]});
  }
  for (const RigidBody& body : model_.rigid_bodies) {
    const std::array<Index, 3>& a = layout_.node[to_size(body.reference)];
    for (const Index attached : body.attached) {
      const std::array<Index, 3>& b = layout_.node[to_size(attached)];
      RigidLink link;
      link.offset =
          model_.nodes[to_size(attached)].position - model_.nodes[to_size(body.reference)].position;
      links->add(link, {a[0], a[1], a[2], b[0], b[1]});
    }
  }
  rows_ += RigidLink::R * links->size();
  if (links->size() > 0) element_groups_.push_back(std::move(links));
}

void GeometricallyExactSystem::add_joints() {
  auto sliders = std::make_unique<ConstraintElements<SlidingJoint>>(layout_.free, rows_);
  for (const Slider& slider : large_motion_.sliders) {
    SlidingJoint joint;
    joint.normal = Vector2d(-std::sin(slider.direction), std::cos(slider.direction));
    std::array<Index, 3> rail{-1, -1, -1};
    if (slider.rail >= 0) {
      rail = layout_.node[to_size(slider.rail)];
      joint.offset =
          model_.nodes[to_size(slider.node)].position - model_.nodes[to_size(slider.rail)].position;
    }
    const std::array<Index, 3>& node = layout_.node[to_size(slider.node)];
    sliders->add(joint, {rail[0], rail[1], rail[2], node[0], node[1]});
  }
  rows_ += sliders->size();
  if (sliders->size() > 0) element_groups_.push_back(std::move(sliders));
  auto springs = std::make_unique<ConstraintElements<LineSpringElement>>(layout_.free, rows_);
  for (const LineSpring& spring : large_motion_.line_springs) {
    LineSpringElement element;
    element.offset = model_.nodes[to_size(spring.nodes[1])].position -
                     model_.nodes[to_size(spring.nodes[0])].position;
    if (std::isfinite(spring.rest_length)) {
      element.initial_elongation = element.offset.norm() - spring.rest_length;
    }
    element.flexibility = 1 / spring.stiffness;
    const auto& a = layout_.node[to_size(spring.nodes[0])];
    const auto& b = layout_.node[to_size(spring.nodes[1])];
    springs->add(element, {a[0], a[1], b[0], b[1]});
  }
  rows_ += springs->size();
  if (springs->size() > 0) element_groups_.push_back(std::move(springs));
}

void GeometricallyExactSystem::add_drives() {
  auto group = std::make_unique<ConstraintElements<DrivenCoordinate>>(layout_.free, rows_);
  first_drive_row_ = rows_;
  for (const Drive& drive : large_motion_.drives) {
    DrivenCoordinate driven;
    driven.law = drive.law;
    group->add(driven, {layout_.node[to_size(drive.node)][to_size(drive.direction)]});
  }
  rows_ += group->size();
  if (group->size() > 0) element_groups_.push_back(std::move(group));
}

void GeometricallyExactSystem::add_linear_constraints() {
  auto group = std::make_unique<LinearConstraints>(layout_.free, rows_);
  for (const Slider& slider : large_motion_.sliders) {
    if (!slider.keeps_angle) continue;
    const Index b = layout_.node[to_size(slider.node)][2];
    if (slider.rail < 0) {
      group->add({{b}, VectorXd::Ones(1)});
    } else {
      const Index a = layout_.node[to_size(slider.rail)][2];
      group->add({{a, b}, Eigen::Vector2d(-1, 1)});
    }
  }
  for (const LinearConstraint& constraint : model_.constraints) {
    if (layout_.equated_coordinates(constraint)) continue;
    LinearConstraintRow row;
    row.factors.resize(static_cast<Index>(constraint.terms.size()));
    Index rotations = 0;
    for (const auto& [coordinate, factor] : constraint.terms) {
      const Index k = layout_.index_of(coordinate);
      if (k < 0) {
        throw ModelError("constraint " + constraint.name + " names a rotation that no part has");
      }
      if (layout_.is_rotation[to_size(k)]) ++rotations;
      row.factors[static_cast<Index>(row.coordinates.size())] = factor;
      row.coordinates.push_back(k);
    }
    if (rotations != 0 && rotations != row.factors.size()) {
      throw ModelError("constraint " + constraint.name +
                       " mixes translations and rotations: it holds for small motion only");
    }
    group->add(std::move(row));
  }
  rows_ += group->size();
  linear_constraints_ = group.get();
  element_groups_.push_back(std::move(group));
}

void GeometricallyExactSystem::add_loads() {
  for (const NodalLoad& load : model_.loads) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double force = load.force[static_cast<Index>(k)];
      if (force != 0) loads_[layout_.node[to_size(load.node)][k]] += force;
    }
  }
  for (const EdgeLoad& load : model_.edge_loads) {
    const std::array<Vector2d, 3> force = edge_forces(model_, load);
    for (std::size_t i = 0; i < 3; ++i) {
      if (load.nodes[i] < 0) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        loads_[layout_.node[to_size(load.nodes[i])][k]] += force[i][static_cast<Index>(k)];
      }
    }
  }
  auto group = std::make_unique<FollowerLoads>(layout_.free);
  for (const FollowerLoad& load : large_motion_.follower_loads) {
    group->add(load.force, layout_.node[to_size(load.node)]);
  }
  follower_loads_ = group.get();
  element_groups_.push_back(std::move(group));
}

void GeometricallyExactSystem::finalize() {
  for (const auto& [k, m] : point_mass_) mass_entries_.emplace_back(k, k, m);
  mass_.resize(layout_.total, layout_.total);
  mass_.setFromTriplets(mass_entries_.begin(), mass_entries_.end());
  mass_entries_.clear();
  VectorXd field = VectorXd::Zero(layout_.total);
  const auto set = [&](Index x, Index y) {
    field[x] = model_.gravity.x();
    field[y] = model_.gravity.y();
  };
  for (const auto& node : layout_.node) set(node[0], node[1]);
  for (const auto& centre : layout_.mass_centre) set(centre[0], centre[1]);
  for (const MemberElement& element : layout_.elements) {
    for (std::size_t a = 0; a < element.coordinates.size(); a += element.is_bar() ? 2 : 3) {
      set(element.coordinates[a], element.coordinates[a + 1]);
    }
  }
  gravity_ = mass_ * field;
  const double size = model_size(model_);
  scale_.resize(layout_.free);
  for (Index i = 0; i < layout_.free; ++i) scale_[i] = layout_.is_rotation[to_size(i)] ? 1.0 : size;
  set_constraint_scales();
  for (const std::unique_ptr<ElementGroup>& group : element_groups_) group->append_blocks(blocks_);
  compliance_ = VectorXd::Zero(rows_);
  padded_ = VectorXd::Zero(layout_.total);
  product_ = VectorXd::Zero(layout_.total);
  const auto collect = [&](auto* rows) {
    if (rows == nullptr) return;
    for (Index e = 0; e < rows->size(); ++e) {
      const auto c = rows->element(e).compliance();
      compliance_.segment(rows->first_row(e), c.size()) = c;
    }
  };
  for (const std::unique_ptr<ElementGroup>& group : element_groups_) {
    collect(dynamic_cast<ConstraintElements<Beam<1>>*>(group.get()));
    collect(dynamic_cast<ConstraintElements<Beam<2>>*>(group.get()));
    collect(dynamic_cast<ConstraintElements<Beam<3>>*>(group.get()));
    collect(dynamic_cast<ConstraintElements<LineSpringElement>*>(group.get()));
    collect(dynamic_cast<ConstraintElements<Bar>*>(group.get()));
  }
}

void GeometricallyExactSystem::set_constraint_scales() {
  // What is joined: stiffness of the elements and mass at each coordinate.
  VectorXd stiffness = VectorXd::Zero(layout_.total);
  for (const MemberElement& element : layout_.elements) {
    const double h = element.length();
    for (std::size_t a = 0; a < element.coordinates.size(); ++a) {
      const double part = a % 3 == 2 ? h : h * h * h;
      stiffness[element.coordinates[a]] +=
          element.is_bar() ? element.section.EA / h : 12 * element.section.EI / part;
    }
  }
  for (const Triangle& triangle : model_.triangles) {
    const Plate& plate = model_.plates[to_size(triangle.plate)];
    for (const Index node : triangle.nodes) {
      if (node < 0) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        stiffness[layout_.node[to_size(node)][k]] += plate.material.E * plate.thickness;
      }
    }
  }
  const VectorXd mass = mass_.diagonal();
  const auto mean = [](const VectorXd& values) {
    const Index count = (values.array() > 0).count();
    return count > 0 ? values.sum() / static_cast<double>(count) : 0.0;
  };
  double mean_mass = mean(mass), mean_stiffness = mean(stiffness);
  if (mean_mass <= 0) mean_mass = 1;
  if (mean_stiffness <= 0) mean_stiffness = mean_mass;
  const auto typical = [&](const VectorXd& values, const auto& where, double fallback) {
    double sum = 0;
    for (const Index k : where) {
      if (k >= 0) sum = std::max(sum, values[k]);
    }
    return sum > 0 ? sum : fallback;
  };
  const auto assign = [&](auto* rows) {
    if (rows == nullptr) return;
    for (Index e = 0; e < rows->size(); ++e) {
      auto& joint = rows->elements()[to_size(e)];
      joint.stiffness_scale = typical(stiffness, rows->coordinates(e), mean_stiffness);
      joint.mass_scale = typical(mass, rows->coordinates(e), mean_mass);
    }
  };
  for (const std::unique_ptr<ElementGroup>& group : element_groups_) {
    assign(dynamic_cast<ConstraintElements<RigidLink>*>(group.get()));
    assign(dynamic_cast<ConstraintElements<SlidingJoint>*>(group.get()));
    assign(dynamic_cast<ConstraintElements<LineSpringElement>*>(group.get()));
    assign(dynamic_cast<ConstraintElements<Bar>*>(group.get()));
    assign(dynamic_cast<ConstraintElements<DrivenCoordinate>*>(group.get()));
  }
  for (LinearConstraintRow& row : linear_constraints_->rows()) {
    row.stiffness_scale = typical(stiffness, row.coordinates, mean_stiffness);
    row.mass_scale = typical(mass, row.coordinates, mean_mass);
  }
}

void GeometricallyExactSystem::force_residual(const State& state, Eigen::Ref<VectorXd> r) const {
  const Index n = layout_.free, size = r.size();
  r = -state.gravity * gravity_.head(size) - state.load * loads_.head(size);
  if (state.a.size() == n) {
    padded_.head(n) = state.a + large_motion_.mass_damping * state.v;
    product_.noalias() = mass_ * padded_;
    r += product_.head(size);
  }
  for (const std::unique_ptr<ElementGroup>& group : element_groups_) {
    group->forces(state, large_motion_.strain_rate_damping, r);
  }
}

void GeometricallyExactSystem::constraint_residual(const State& state,
                                                   Eigen::Ref<VectorXd> residual,
                                                   Eigen::Ref<VectorXd> rate) const {
  for (const std::unique_ptr<ElementGroup>& group : element_groups_)
    group->constraint_residual(state, residual, rate);
}

TangentCoefficients GeometricallyExactSystem::with_damping(TangentCoefficients coefficients) const {
  coefficients.mass += large_motion_.mass_damping * coefficients.damping;
  return coefficients;
}

void GeometricallyExactSystem::add_point_masses(const TangentCoefficients& coefficients,
                                                KktMatrix& matrix) const {
  for (const auto& [k, m] : point_mass_) {
    if (k < layout_.free) matrix.add_diagonal(k, coefficients.mass * m);
  }
}

void GeometricallyExactSystem::count_elements() const {
  element_evaluations_ +=
      static_cast<std::int64_t>(layout_.elements.size() + model_.triangles.size());
}

void GeometricallyExactSystem::tangent(const State& state, const TangentCoefficients& coefficients,
                                       KktMatrix& matrix) const {
  count_elements();
  const TangentCoefficients damped = with_damping(coefficients);
  for (const std::unique_ptr<ElementGroup>& group : element_groups_) {
    group->tangent(state, large_motion_.strain_rate_damping, damped, matrix);
  }
  add_point_masses(damped, matrix);
}

void GeometricallyExactSystem::discrete_gradient_tangent(const State& from, const State& to,
                                                         const State& midpoint,
                                                         const TangentCoefficients& coefficients,
                                                         KktMatrix& matrix) const {
  count_elements();
  const TangentCoefficients damped = with_damping(coefficients);
  for (const std::unique_ptr<ElementGroup>& group : element_groups_) {
    group->discrete_gradient_tangent(from, to, midpoint, large_motion_.strain_rate_damping, damped,
                                     matrix);
  }
  add_point_masses(damped, matrix);
}

void GeometricallyExactSystem::discrete_gradient_residual(const State& from, const State& to,
                                                          const VectorXd& lambda,
                                                          Eigen::Ref<VectorXd> r) const {
  const Index n = layout_.free, size = r.size();
  const double h = to.t - from.t;
  r = -(from.gravity + to.gravity) / 2 * gravity_.head(size) -
      (from.load + to.load) / 2 * loads_.head(size);
  padded_.head(n) = (to.v - from.v) / h + large_motion_.mass_damping * (from.v + to.v) / 2;
  product_.noalias() = mass_ * padded_;
  r += product_.head(size);
  for (const std::unique_ptr<ElementGroup>& group : element_groups_) {
    group->discrete_gradient_forces(from, to, lambda, large_motion_.strain_rate_damping, r);
  }
}

bool GeometricallyExactSystem::symmetric() const {
  return follower_loads_->size() == 0;
}

double GeometricallyExactSystem::load_factor(double t) const {
  return large_motion_.load_history ? large_motion_.load_history(t) : 1.0;
}

Energy GeometricallyExactSystem::energy(const State& state) const {
  Energy energy;
  const Index n = layout_.free;
  if (state.v.size() == n) {
    padded_.head(n) = state.v;
    product_.noalias() = mass_ * padded_;
    energy.kinetic = product_.head(n).dot(state.v) / 2;
  }
  for (const std::unique_ptr<ElementGroup>& group : element_groups_)
    energy.strain += group->energy(state);
  VectorXd residual = VectorXd::Zero(rows_), rate = VectorXd::Zero(rows_);
  constraint_residual(state, residual, rate);
  for (Index i = 0; i < rows_; ++i) {
    if (compliance_[i] > 0) energy.strain += residual[i] * residual[i] / (2 * compliance_[i]);
  }
  energy.load = -state.q.dot(state.gravity * gravity_.head(n) + state.load * loads_.head(n));
  return energy;
}

void GeometricallyExactSystem::load_derivative(const State& state, Eigen::Ref<VectorXd> r) const {
  r = -gravity_.head(r.size()) - loads_.head(r.size());
  follower_loads_->add_load_derivative(state, r);
}

State GeometricallyExactSystem::reference_state() const {
  State state;
  state.q = state.v = state.a = VectorXd::Zero(layout_.free);
  state.lambda = VectorXd::Zero(rows_);
  return state;
}

Index GeometricallyExactSystem::drive_row(Index drive) const {
  return first_drive_row_ + drive;
}

}  // namespace trammel::solver::large_motion
