#include "solver/poses/moving_pencil.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/assembly/inertia.h"
#include "solver/elastodynamics/moving_pattern.h"
#include "solver/elements/triangle_element.h"
#include "solver/linalg/backward_error.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;

std::vector<Index> elements_of(const Model& model) {
  std::vector<Index> elements;
  for (const Member& member : model.members) elements.push_back(member.elements);
  return elements;
}

Model with_single_elements(Model model) {
  for (Member& member : model.members) member.elements = 1;
  return model;
}

NominalMotion no_motion(const Model& model) {
  NominalMotion motion;
  motion.member.resize(model.members.size());
  motion.plate.resize(model.plates.size());
  motion.rigid_body.resize(model.rigid_bodies.size());
  return motion;
}

bool alike(const FrameElement& a, const FrameElement& b, const Model& model) {
  const Member& p = model.members[to_size(a.member)];
  const Member& q = model.members[to_size(b.member)];
  return std::tie(p.section.EA, p.section.EI, p.section.kappa_GA, p.section.mass_per_length,
                  p.section.inertia_per_length, p.theory, p.mass, p.axially_flexible, a.length) ==
         std::tie(q.section.EA, q.section.EI, q.section.kappa_GA, q.section.mass_per_length,
                  q.section.inertia_per_length, q.theory, q.mass, q.axially_flexible, b.length);
}

/// The pair (x, y) of columns at i turned: by -angle into the part's axes, by +angle back.
template <class Block>
void turn(Block& v, Index i, double c, double s) {
  const auto x = (c * v.col(i) - s * v.col(i + 1)).eval();
  v.col(i + 1) = s * v.col(i) + c * v.col(i + 1);
  v.col(i) = x;
}

}  // namespace

MovingPencil::MovingPencil(const Model& model, const ManipulatorGeometry& geometry,
                           const Pose& pose)
    : start_(assemble(with_single_elements(model))),
      constraints_(start_, no_motion(model), false),
      motion_(no_motion(model)),
      next_(motion_),
      start_posture_(inverse_kinematics(geometry, pose)),
      start_phi_(pose.phi) {
  add_links(elements_of(model));
  add_platform();
  add_springs();
  find_contributions();
  const Index n = start_.K.rows();
  K_.setZero(n, n);
  M_ = shifted_ = K_;
  free_coordinates_ = n;
  double size = 0;
  for (const Vector2d& position : start_.mesh.positions)
    size = std::max(size, (position - start_.mesh.positions.front()).norm());
  length_.setOnes(n);
  for (Index u = 0; u < start_.coordinates.size; ++u) {
    const Index q = start_.constraints.free[to_size(u)];
    if (q >= 0 && start_.coordinates.is_rotation[to_size(u)]) length_[q] = size;
  }
  for (const Link& link : links_) free_coordinates_ += link.condensed.inside;
  static_cast<void>(move_to(start_posture_, pose));
}

void MovingPencil::add_links(const std::vector<Index>& elements) {
  for (const FrameElement& e : start_.mesh.frame) {
    const auto index = to_size(e.member);
    Link link;
    link.first_inside = inside_;
    Member member = start_.model.members[index];
    member.elements = elements[index];
    std::size_t same = 0;
    while (same < index && !(elements[same] == elements[index] &&
                             alike(start_.mesh.frame[same], e, start_.model))) {
      ++same;
    }
    link.condensed = same < index ? links_[same].condensed : condense(member, e.length);
    const auto& P = link.condensed.P;
    for (Index j = 0; j < P.rows(); ++j) {
      for (Index k = 0; k < 6; ++k) {
        if (P(j, k) != 0) link.couplings.push_back({j, k, P(j, k)});
      }
    }
    inside_ += P.rows();
    coupling_ = std::max(coupling_, link.condensed.coupling);
    Element element;
    element.coordinates = e.coordinates;
    element.B = link.condensed.B;
    element.c = link.condensed.c;
    element.m = link.condensed.m;
    element.part = Element::Part::link;
    element.index = index;
    element.stride = 3;
    element.pairs = 2;
    elements_.push_back(element);
    links_.push_back(std::move(link));
  }
}

void MovingPencil::add_platform() {
  const Model& model = start_.model;
  for (const Triangle& triangle : model.triangles) {
    const Plate& plate = model.plates[to_size(triangle.plate)];
    const TrianglePoints points = corners(model, triangle);
    Element element;
    element.coordinates = start_.coordinates.of_triangle<6>(triangle);
    element.B = triangle_deformation(points);
    element.c = membrane_rigidity(plate.material, plate.thickness * std::abs(signed_area(points)));
    element.m = triangle_mass(points, plate);
    element.part = Element::Part::platform;
    element.stride = 2;
    element.pairs = 3;
    elements_.push_back(element);
  }
  for (const PointMass& mass : model.masses) {
    Element element;
    const auto& node = start_.coordinates.node[to_size(mass.node)];
    std::copy(node.begin(), node.end(), element.coordinates.begin());
    element.m.topLeftCorner<3, 3>() = point_inertia(mass.mass, mass.inertia, mass.offset);
    element.part = Element::Part::platform;
    element.pairs = 1;
    elements_.push_back(element);
  }
}

void MovingPencil::add_springs() {
  for (std::size_t i = 0; i < start_.model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      Element element;
      element.coordinates[0] = start_.coordinates.member_end[i][end];
      element.m(0, 0) = start_.model.members[i].ends[end].inertia;
      if (element.m(0, 0) != 0) elements_.push_back(element);
    }
  }
  for (const SpringElement& spring : start_.springs) {
    Element element;
    std::copy(spring.coordinates.begin(), spring.coordinates.end(), element.coordinates.begin());
    element.B(0, 0) = -1;
    element.B(0, 1) = 1;
    element.c[0] = spring.stiffness;
    elements_.push_back(element);
  }
}

void MovingPencil::find_contributions() {
  for (Element& element : elements_) {
    element.k = element.B.transpose() * element.c.asDiagonal() * element.B;
    element.first = contributions_.size();
    for_each_contribution(element.coordinates, constraints_.T(),
                          [&](int local, int a, int b, int row, int column) {
                            if (row >= column) contributions_.push_back({local, a, b, row, column});
                          });
    element.last = contributions_.size();
  }
}

Outcome MovingPencil::move_to(const Posture& posture, const Pose& pose) {
  const double turned = pose.phi - start_phi_;
  for (std::size_t i = 0; i < 3; ++i) {
    next_.member[2 * i].angle = posture.active[i] - start_posture_.active[i];
    next_.member[2 * i + 1].angle = posture.passive[i] - start_posture_.passive[i];
    link_direction_[2 * i] = {std::cos(posture.active[i]), std::sin(posture.active[i])};
    link_direction_[2 * i + 1] = {std::cos(posture.passive[i]), std::sin(posture.passive[i])};
  }
  for (PartMotion& body : next_.rigid_body) body.angle = turned;
  platform_direction_ = {std::cos(turned), std::sin(turned)};
  Outcome outcome = constraints_.move(start_, motion_, next_);
  if (!outcome.solved()) return outcome;
  std::swap(motion_, next_);
  K_.setZero();
  M_.setZero();
  for (const Element& element : elements_) {
    if (!element.c.isZero(0)) add(element, element.k, K_);
    add(element, element.m, M_);
  }
  return {};
}

Vector2d MovingPencil::direction(const Element& element) const {
  if (element.part == Element::Part::ground) return Vector2d::UnitX();
  return element.part == Element::Part::platform ? platform_direction_
                                                 : link_direction_[element.index];
}

void MovingPencil::add(const Element& element, const Matrix6d& A, MatrixXd& sum) const {
  Matrix6d world = A;
  if (element.part != Element::Part::ground) {
    const Vector2d d = direction(element);
    for (Index p = 0; p < element.pairs; ++p) turn(world, p * element.stride, d.x(), d.y());
    world.transposeInPlace();
    for (Index p = 0; p < element.pairs; ++p) turn(world, p * element.stride, d.x(), d.y());
  }
  const double* const T = constraints_.T().valuePtr();
  for (std::size_t t = element.first; t < element.last; ++t) {
    const Contribution& to = contributions_[t];
    sum(to.i, to.j) += T[to.a] * world(to.local) * T[to.b];
  }
}

Index MovingPencil::eigenvalues_below(double shift) {
  shifted_.noalias() = K_ - shift * M_;
  Index below = 0;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const LinkSuperelement& link = links_[l].condensed;
    if (link.mu.size() == 0) continue;
    Matrix6d reduction = Matrix6d::Zero();
    for (Index j = 0; j < link.mu.size(); ++j) {
      const double pivot = 1 - shift * link.mu[j];
      if (pivot == 0) return -1;
      if (pivot < 0) ++below;
      reduction -= shift * shift / pivot * link.P.row(j).transpose() * link.P.row(j);
    }
    add(elements_[l], reduction, shifted_);  // the links come first
  }
  const bool reliable = count_.compute(shifted_) && count_.element_growth() < 1e8;
  return reliable ? below + count_.negative_pivots() : -1;
}

/// Of an element, in its own axes.
template <int rows>
MovingPencil::Local<rows> MovingPencil::gather(const Element& element, const Rows<rows>& U) const {
  Local<rows> v;
  for (Index i = 0; i < 6; ++i) {
    const Index u = element.coordinates[to_size(i)];
    if (u >= 0) {
      v.col(i) = U.col(u);
    } else {
      v.col(i).setZero();
    }
  }
  const Vector2d d = direction(element);
  for (Index p = 0; p < element.pairs; ++p) turn(v, p * element.stride, d.x(), -d.y());
  return v;
}

template <int rows>
void MovingPencil::displacements(const Rows<rows>& X, Rows<rows>& U) const {
  const auto& T = constraints_.T();
  U.setZero(rows, T.rows());
  for (Index u = 0; u < T.rows(); ++u) {
    for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a)
      U.col(u) += T.valuePtr()[a] * X.col(T.innerIndexPtr()[a]);
  }
}

template <int rows>
void MovingPencil::mass_times(const VectorBlock<rows>& X, VectorBlock<rows>& Y,
                              Workspace<rows>& space) const {
  const Index n = ends();
  Y.ends.setZero(rows, n);
  Y.inside.resize(rows, inside_);
  for (Index j = 0; j < n; ++j) {
    Y.ends.col(j) += M_(j, j) * X.ends.col(j);
    for (Index i = j + 1; i < n; ++i) {
      if (M_(i, j) == 0) continue;
      Y.ends.col(i) += M_(i, j) * X.ends.col(j);
      Y.ends.col(j) += M_(i, j) * X.ends.col(i);
    }
  }
  if (inside_ == 0) return;
  displacements<rows>(X.ends, space.U);
  space.F.setZero(rows, space.U.cols());
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const Link& link = links_[l];
    const Local<rows> v = gather<rows>(elements_[l], space.U);
    Local<rows> f = Local<rows>::Zero();
    const Eigen::VectorXd& mu = link.condensed.mu;
    for (Index j = 0; j < mu.size(); ++j)
      Y.inside.col(link.first_inside + j) = mu[j] * X.inside.col(link.first_inside + j);
    for (const auto& [mode, coordinate, value] : link.couplings) {
      Y.inside.col(link.first_inside + mode) += value * v.col(coordinate);
      f.col(coordinate) += value * X.inside.col(link.first_inside + mode);
    }
    for (const Index i : {0, 3}) turn(f, i, link_direction_[l].x(), link_direction_[l].y());
    for (Index i = 0; i < 6; ++i) space.F.col(elements_[l].coordinates[to_size(i)]) += f.col(i);
  }
  const auto& T = constraints_.T();
  for (Index u = 0; u < T.rows(); ++u) {
    for (int a = T.outerIndexPtr()[u]; a < T.outerIndexPtr()[u + 1]; ++a)
      Y.ends.col(T.innerIndexPtr()[a]) += T.valuePtr()[a] * space.F.col(u);
  }
}

template <int rows>
void MovingPencil::measure_strain(const VectorBlock<rows>& X, const Rows<rows>& U,
                                  ModeMeasures<rows>& measures) const {
  measures.strain = X.inside.array().square().rowwise().sum();
  measures.rounding = measures.strain;
  for (const Element& element : elements_) {
    if (element.c.isZero(0)) continue;
    const Local<rows> v = gather<rows>(element, U);
    for (Index k = 0; k < 3; ++k) {
      if (element.c[k] == 0) continue;
      Eigen::Array<double, rows, 1> d = Eigen::Array<double, rows, 1>::Zero(), magnitude = d;
      for (Index i = 0; i < 6; ++i) {
        if (element.B(k, i) == 0) continue;
        d += element.B(k, i) * v.col(i).array();
        magnitude += std::abs(element.B(k, i)) * v.col(i).array().abs();
      }
      measures.strain += element.c[k] * d.square();
      measures.rounding += element.c[k] * d.abs() * magnitude;
    }
  }
  measures.rounding *= 2 * kEps;
}

/// Row by row; none is judged by coordinates that are rounding of the others (backward_error.h),
/// modes inside by the energy of the whole.
template <int rows>
void MovingPencil::measure_residual(const VectorBlock<rows>& X, Workspace<rows>& space,
                                    ModeMeasures<rows>& measures) const {
  using Numbers = Eigen::Array<double, rows, 1>;
  const Numbers w2 = measures.strain / measures.inertia;
  space.sizes = X.ends.cwiseAbs();
  Numbers largest = Numbers::Zero();
  for (Index i = 0; i < ends(); ++i) largest = largest.max(length_[i] * space.sizes.col(i).array());
  for (Index i = 0; i < ends(); ++i) {
    space.sizes.col(i) = space.sizes.col(i).array().max(kLeastShare / length_[i] * largest);
  }
  measures.backward_error.setZero();
  for (Index i = 0; i < ends(); ++i) {
    Numbers sum = -w2 * space.image.ends.col(i).array(), terms = sum.abs();
    for (Index j = 0; j < ends(); ++j) {
      const double k = i >= j ? K_(i, j) : K_(j, i);
      if (k == 0) continue;
      sum += k * X.ends.col(j).array();
      terms += std::abs(k) * space.sizes.col(j).array();
    }
    measures.backward_error = measures.backward_error.max(sum.abs() / terms);
  }
  const Numbers size = measures.strain.sqrt();  // modes inside have stiffness 1
  for (Index j = 0; j < inside_; ++j) {
    const Numbers force = w2 * space.image.inside.col(j).array();
    measures.backward_error =
        measures.backward_error.max((X.inside.col(j).array() - force).abs() / size);
  }
}

template <int rows>
ModeMeasures<rows> MovingPencil::measure(const VectorBlock<rows>& X, Workspace<rows>& space) const {
  ModeMeasures<rows> measures;
  mass_times(X, space.image, space);
  measures.inertia = X.ends.cwiseProduct(space.image.ends).rowwise().sum() +
                     X.inside.cwiseProduct(space.image.inside).rowwise().sum();
  displacements<rows>(X.ends, space.U);
  measure_strain(X, space.U, measures);
  measure_residual(X, space, measures);
  return measures;
}

template void MovingPencil::mass_times(const VectorBlock<6>&, VectorBlock<6>&, Workspace<6>&) const;
template void MovingPencil::mass_times(const VectorBlock<16>&, VectorBlock<16>&,
                                       Workspace<16>&) const;
template ModeMeasures<6> MovingPencil::measure(const VectorBlock<6>&, Workspace<6>&) const;
template ModeMeasures<16> MovingPencil::measure(const VectorBlock<16>&, Workspace<16>&) const;

}  // namespace trammel::solver
