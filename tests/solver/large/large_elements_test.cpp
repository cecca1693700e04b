#include <Eigen/Core>
#include <boost/test/unit_test.hpp>
#include <random>

#include "solver/large/beam.h"
#include "solver/large/joints.h"
#include "solver/large/triangle.h"

BOOST_AUTO_TEST_SUITE(large_elements)

namespace {

using namespace trammel::solver;
using namespace trammel::solver::large_motion;

template <int N>
Eigen::Matrix<double, N, 1> random_vector(unsigned seed, double size) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  Eigen::Matrix<double, N, 1> v;
  for (int i = 0; i < N; ++i) v[i] = uniform(generator);
  return v;
}

Beam some_beam() {
  Beam beam;
  beam.axis = Vector2d(0.6, 0.8);
  beam.length = 0.7;
  beam.EI = 3;
  beam.stretch_compliance = 1e-3;
  beam.shear_compliance = 2e-3;
  beam.mass_per_length = 1.3;
  beam.inertia_per_length = 0.02;
  return beam;
}

large_motion::RigidLink some_link() {
  return {{}, Vector2d(0.3, -0.4)};
}

SlidingJoint some_slider() {
  return {{}, Vector2d(-0.6, 0.8), Vector2d(0.2, 0.5)};
}

LineSpringElement some_spring() {
  return {{}, Vector2d(0.7, 0.2), /*initial_elongation=*/0.1, /*flexibility=*/0.01};
}

/// Returns the residual of the constraint rows of an element, and the gradient of the residual.
template <class Element>
std::pair<typename Element::Rows, typename Element::Gradient> linearize(
    const Element& element, const typename Element::Coordinates& q) {
  std::pair<typename Element::Rows, typename Element::Gradient> rows;
  element.constraint_residual(q, 0, rows.first, rows.second);
  return rows;
}

constexpr double kStep = 1e-5;

/// Checks the gradient and the geometric stiffness of an element by central differences. Also
/// checks the defining property of the discrete gradient.
template <class Element>
void check_derivatives(const Element& element) {
  using Coordinates = typename Element::Coordinates;
  const Coordinates q = random_vector<Element::N>(1, 0.8), dq = random_vector<Element::N>(2, 1);
  const auto lambda = random_vector<Element::R>(3, 1);
  const Coordinates plus = q + kStep * dq, minus = q - kStep * dq;
  const auto slope =
      ((linearize(element, plus).first - linearize(element, minus).first) / (2 * kStep)).eval();
  BOOST_TEST((linearize(element, q).second * dq - slope).norm() < 1e-9);
  const Coordinates bend =
      (linearize(element, plus).second - linearize(element, minus).second).transpose() * lambda /
      (2 * kStep);
  const auto K = element.geometric_stiffness(q, lambda);
  BOOST_TEST((K * dq - bend).norm() < 1e-9);
  BOOST_TEST((K - K.transpose()).norm() < 1e-14);
  const Coordinates far = q + random_vector<Element::N>(4, 2);
  const auto change = (linearize(element, far).first - linearize(element, q).first).eval();
  BOOST_TEST((element.discrete_gradient(q, far) * (far - q) - change).norm() < 1e-14);
}

template <class Element>
void check_energy_derivatives(const Element& element) {
  using Coordinates = typename Element::Coordinates;
  const Coordinates q = random_vector<Element::N>(5, 0.1), dq = random_vector<Element::N>(6, 0.1);
  const Coordinates none = Coordinates::Zero();
  const double scale = element.forces(q, none, 0).norm();
  const Coordinates plus = q + kStep * dq, minus = q - kStep * dq;
  const double slope = (element.energy(plus) - element.energy(minus)) / (2 * kStep);
  BOOST_TEST(std::abs(element.forces(q, none, 0).dot(dq) - slope) < 1e-8 * scale);
  const Coordinates bend =
      (element.forces(plus, none, 0) - element.forces(minus, none, 0)) / (2 * kStep);
  BOOST_TEST((element.tangent(q, 1, 0) * dq - bend).norm() < 1e-8 * scale);
  const Coordinates to = q + random_vector<Element::N>(7, 0.3);
  const double work = element.discrete_gradient_forces(q, to, 0).dot(to - q);
  BOOST_TEST(std::abs(work - element.energy(to) + element.energy(q)) < 1e-12 * element.energy(to));
}

const Material kSoft{3.0, 2.0, 0.3};

template <int Nodes>
Triangle2d<Nodes> make_triangle(const std::array<Vector2d, Nodes>& points) {
  Model model;
  model.plates = {{"", kSoft, 0.5}};
  Triangle triangle;
  triangle.plate = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    model.nodes.push_back({"", points[i]});
    triangle.nodes[i] = static_cast<Index>(i);
  }
  return {model, triangle};
}

Triangle2d<3> some_triangle() {
  return make_triangle<3>({Vector2d(0, 0), Vector2d(1, 0.1), Vector2d(0.2, 0.9)});
}

Triangle2d<6> some_curved_triangle() {
  return make_triangle<6>({Vector2d(0, 0), Vector2d(1, 0.1), Vector2d(0.2, 0.9), Vector2d(0.5, 0),
                           Vector2d(0.65, 0.55), Vector2d(0.1, 0.45)});
}

}  // namespace

BOOST_AUTO_TEST_CASE(tangents_and_discrete_gradients_are_consistent) {
  check_derivatives(some_beam());
  check_derivatives(some_link());
  check_derivatives(some_slider());
  check_derivatives(some_spring());
  check_energy_derivatives(some_triangle());
  check_energy_derivatives(some_curved_triangle());
}

BOOST_AUTO_TEST_CASE(rigid_motion_of_a_beam_has_no_strain) {
  const Beam beam = some_beam();
  for (const double angle : {1e-9, 0.4, 2.0, -40.0}) {
    Beam::Coordinates q;
    for (int a = 0; a <= 3; ++a) {
      const Vector2d position =
          (0.3 + beam_interpolation().node[static_cast<std::size_t>(a)]) * beam.length * beam.axis;
      const Vector2d displacement =
          cosine_minus_one(angle) * position + std::sin(angle) * perpendicular(position);
      q.segment<3>(3 * a) << displacement + Vector2d(2, -1) * angle, angle;
    }
    BOOST_TEST(linearize(beam, q).first.norm() < 4e-15 * std::abs(angle));
  }
}

BOOST_AUTO_TEST_CASE(strains_do_not_depend_on_a_rigid_rotation) {
  const Beam beam = some_beam();
  const Beam::Coordinates q = random_vector<12>(8, 0.5);
  const double angle = 1.1;
  Beam::Coordinates rotated_q;
  for (int a = 0; a <= 3; ++a) {
    const Vector2d position =
        beam.length * beam_interpolation().node[static_cast<std::size_t>(a)] * beam.axis;
    rotated_q.segment<2>(3 * a) = rotated(position + q.segment<2>(3 * a), angle) - position;
    rotated_q[3 * a + 2] = q[3 * a + 2] + angle;
  }
  BOOST_TEST((linearize(beam, rotated_q).first - linearize(beam, q).first).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(rigid_rotation_of_a_triangle_has_no_energy) {
  const Triangle2d<3> triangle = some_triangle();
  const std::array<Vector2d, 3> corners = {Vector2d(0, 0), Vector2d(1, 0.1), Vector2d(0.2, 0.9)};
  Triangle2d<3>::Coordinates q;
  for (std::size_t a = 0; a < 3; ++a)
    q.segment<2>(2 * static_cast<Index>(a)) = rotated(corners[a], 2.1) - corners[a];
  BOOST_TEST(triangle.energy(q) < 1e-30);
}

BOOST_AUTO_TEST_CASE(element_mass_matrices_sum_to_the_total_mass) {
  const Beam beam = some_beam();
  Beam::Coordinates along = Beam::Coordinates::Zero();
  for (int a = 0; a <= 3; ++a) along[3 * a] = 1;
  BOOST_TEST(std::abs(along.dot(beam.mass() * along) - 1.3 * 0.7) < 1e-15);
  const double area = 0.44;
  const Vector2d a(0, 0), b(1, 0.1), c(0.2, 0.9);
  const Triangle2d<6> straight = make_triangle<6>({a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2});
  Triangle2d<6>::Coordinates shift;
  for (int k = 0; k < 6; ++k) shift.segment<2>(2 * k) << 0, 1;
  BOOST_TEST(std::abs(shift.dot(straight.mass() * shift) - 2 * 0.5 * area) < 1e-14);
  Triangle2d<3>::Coordinates shift3;
  shift3 << 0, 1, 0, 1, 0, 1;
  BOOST_TEST(std::abs(shift3.dot(some_triangle().mass() * shift3) - 2 * 0.5 * area) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
