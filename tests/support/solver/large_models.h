#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "solver/large/geometrically_exact_system.h"
#include "solver/large/large_motion_model.h"
#include "tests/support/solver/frames.h"

/// Models in large motion that the tests share.
namespace trammel::testing {

using namespace solver;

using large_motion::GeometricallyExactSystem;
using large_motion::LargeMotionModel;
using large_motion::State;

/// EI = 1, inextensible, Euler-Bernoulli: the elastica.
inline Model elastica(Index elements, double angle = 0) {
  Model model = cantilever(unit_section(), 1, elements, angle);
  model.members[0].axially_flexible = false;
  return model;
}

/// Two nodes in one place share their translations.
inline void pin_together(Model& model, Index a, Index b) {
  for (const auto kind : {Coordinate::Kind::x, Coordinate::Kind::y}) {
    const Coordinate first{kind, a, -1, 0}, second{kind, b, -1, 0};
    model.constraints.push_back({"pin", {{first, 1.0}, {second, -1.0}}});
  }
}

/// IFToMM A01: 1 kg at the end of a massless rod of 1 m, let go where the rod is level.
inline Model simple_pendulum() {
  Model model;
  model.nodes = {{"O", {0, 0}}, {"B", {-1, 0}}};
  model.supports = {pin(0)};
  model.rigid_bodies = {{"rod", 0, {1}}};
  model.masses = {{1, 1.0, 0, {0, 0}}};
  model.gravity = {0, -9.81};
  return model;
}

/// IFToMM A02: `loops` four-bars in a row of uniform rods (1 m, 1 kg), upright; node "B0" starts
/// with 1 m/s.
inline std::pair<Model, LargeMotionModel> four_bar_chain(int loops) {
  Model model;
  model.gravity = {0, -9.81};
  for (int i = 0; i <= loops; ++i) {
    model.nodes.push_back({"A" + std::to_string(i), {static_cast<double>(i), 0}});
    model.nodes.push_back({"B" + std::to_string(i), {static_cast<double>(i), 1}});
    const Index a = 2 * i;
    model.supports.push_back(pin(a));
    model.rigid_bodies.push_back({"crank", a, {a + 1}});
    model.masses.push_back({a, 1, 1.0 / 12, {0, 0.5}});
  }
  for (int i = 0; i < loops; ++i) {
    const auto c = static_cast<Index>(model.nodes.size());
    model.nodes.push_back({"C" + std::to_string(i), {static_cast<double>(i), 1}});
    model.nodes.push_back({"D" + std::to_string(i), {static_cast<double>(i + 1), 1}});
    model.rigid_bodies.push_back({"coupler", c, {c + 1}});
    model.masses.push_back({c, 1, 1.0 / 12, {0.5, 0}});
    pin_together(model, c, 2 * i + 1);
    pin_together(model, c + 1, 2 * i + 3);
  }
  LargeMotionModel large_motion;
  large_motion.initial_velocities = {{1, 0, 1.0}};
  return {model, large_motion};
}

/// The angles (beta, Theta, gamma, Phi, delta, Omega, epsilon) of Andrews' squeezing mechanism.
using AndrewsAngles = std::array<double, 7>;

struct Andrews {
  Model model;
  LargeMotionModel large_motion;
  std::array<Index, 7> body{};  ///< reference nodes of the bodies K1 ... K7
  AndrewsAngles start{-.0617138900142764496, 0,
                      .455279819163070380,   .222668390165885885,
                      .487364979543842550,   -.222668390165885885,
                      1.23054744454982119};

  /// From rotations of the bodies (or their rates) to the mechanism's angles, without the start.
  [[nodiscard]] AndrewsAngles angles(const Eigen::MatrixX3d& motion) const {
    std::array<double, 7> turn{};
    for (std::size_t i = 0; i < 7; ++i) turn[i] = motion(body[i], 2);
    return {turn[0], turn[1] - turn[0], turn[2], turn[3] - turn[4],
            turn[4], turn[5] - turn[6], turn[6]};
  }
};

/// Andrews' squeezing mechanism (E. Hairer, G. Wanner, Solving ODEs II; IVP test set; IFToMM A03)
/// as seven rigid bodies, a line spring and a constant drive torque.
inline Andrews andrews_mechanism() {
  Andrews a;
  Model& m = a.model;
  const auto [beta, theta, gamma, phi, delta, omega, epsilon] = a.start;
  const auto direction = [](double x) { return Vector2d(std::cos(x), std::sin(x)); };
  const auto below = [](double x) { return Vector2d(std::sin(x), -std::cos(x)); };
  const Vector2d A(-.06934, -.00227), B(-.03635, .03273), C(.014, .072);
  const Vector2d F = .007 * direction(beta), k2 = direction(beta + theta);
  const Vector2d E = F - .028 * k2;
  const Vector2d D = B + .02 * direction(gamma) + .018 * below(gamma);
  const Vector2d H = A + .04 * direction(delta), k4 = below(phi + delta);
  const Vector2d G = A + .04 * below(epsilon), k6 = direction(omega + epsilon);
  const auto node = [&m](const char* name, const Vector2d& at) {
    m.nodes.push_back({name, at});
    return static_cast<Index>(m.nodes.size()) - 1;
  };
  const Index o = node("O", {0, 0}), f1 = node("F1", F), f2 = node("F2", F), e2 = node("E2", E);
  const Index b = node("B", B), e3 = node("E3", E), d = node("D", D), a5 = node("A5", A);
  const Index h5 = node("H5", H), h4 = node("H4", H), e4 = node("E4", E), a7 = node("A7", A);
  const Index g7 = node("G7", G), g6 = node("G6", G), e6 = node("E6", E), c = node("C", C);
  for (const Index k : {o, b, a5, a7, c}) m.supports.push_back(pin(k));
  m.rigid_bodies = {{"K1", o, {f1}},  {"K2", f2, {e2}}, {"K3", b, {e3, d}}, {"K4", h4, {e4}},
                    {"K5", a5, {h5}}, {"K6", g6, {e6}}, {"K7", a7, {g7}}};
  pin_together(m, f2, f1);
  pin_together(m, e3, e2);
  pin_together(m, e4, e2);
  pin_together(m, e6, e2);
  pin_together(m, h4, h5);
  pin_together(m, g6, g7);
  m.masses = {
      {o, .04325, 2.194e-6, .00092 * direction(beta)}, {f2, .00365, 4.410e-7, -.0115 * k2},
      {b, .02373, 5.255e-6, {.01874, .01043}},         {h4, .00706, 5.667e-7, (.02 - .01421) * k4},
      {a5, .07050, 1.169e-5, {.02308, .00916}},        {g6, .00706, 5.667e-7, (.02 - .01421) * k6},
      {a7, .05498, 1.912e-5, {.01228, .00449}}};
  m.loads = {{o, {0, 0, .033}}};
  a.large_motion.line_springs = {{"spring", {c, d}, 4530, .07785}};
  a.body = {o, f2, b, h4, a5, g6, a7};
  return a;
}

/// Simo and Vu-Quoc's spin-up manoeuvre (ANSYS VM258): a beam of 10 m whose hub turns up to 6 rad/s
/// in 15 s.
inline std::pair<Model, LargeMotionModel> spin_up(Index elements) {
  Model model = beam({2.8e7, 1.4e4, 1e7, 1.2, 6e-4, 1, 1}, 10, elements);
  model.members[0].theory = BeamTheory::timoshenko;
  model.supports = {pin(0)};
  LargeMotionModel large_motion;
  large_motion.drives = {{"hub", 0, 2, [](double t) {
                            const double w = 2 * std::numbers::pi / 15;
                            if (t >= 15) return std::array<double, 3>{6 * t - 45, 6, 0};
                            return std::array<double, 3>{
                                0.4 * (t * t / 2 + (std::cos(w * t) - 1) / (w * w)),
                                0.4 * (t - std::sin(w * t) / w), 0.4 * (1 - std::cos(w * t))};
                          }}};
  return {model, large_motion};
}

}  // namespace trammel::testing
