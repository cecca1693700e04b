#include "references/frames/unit_load.h"

#include <gsl/gsl_integration.h>

#include <memory>

#include "references/frames/frame_coordinates.h"

namespace trammel::references {

namespace {

/// Internal forces N, V and M at x along a member. The causes are a unit N, V or M at its start,
/// and its distributed load.
std::array<double, 3> internal_forces(int cause, const std::array<double, 2>& load, double x) {
  if (cause == 0) return {1, 0, 0};
  if (cause == 1) return {0, 1, -x};
  if (cause == 2) return {0, 0, 1};
  return {-load[0] * x, -load[1] * x, load[1] * x * x / 2};
}

/// Integrates the product of two diagrams with four Gauss points, which is exact for the quartics
/// that occur here.
double compliance(int a, int b, const FrameSection& section, const std::array<double, 2>& load,
                  double length) {
  static const std::unique_ptr<gsl_integration_glfixed_table,
                               void (*)(gsl_integration_glfixed_table*)>
      table(gsl_integration_glfixed_table_alloc(4), gsl_integration_glfixed_table_free);
  const auto product = [&](double x) {
    const auto [Na, Va, Ma] = internal_forces(a, load, x);
    const auto [Nb, Vb, Mb] = internal_forces(b, load, x);
    return Ma * Mb / static_cast<double>(section.EI) +
           Na * Nb * static_cast<double>(section.axial_compliance) +
           Va * Vb * static_cast<double>(section.shear_compliance);
  };
  gsl_function function{[](double x, void* f) { return (*static_cast<decltype(&product)>(f))(x); },
                        const_cast<void*>(static_cast<const void*>(&product))};
  return gsl_integration_glfixed(&function, 0, length, table.get());
}

/// Load per unit length in the member's axes, weight included: along it and to its left.
std::array<Real, 2> member_load(const Frame& frame, const FrameMember& member) {
  const MemberAxis axis = member_axis(frame, member);
  const Real x = member.load[0] + member.section.mass * frame.gravity[0];
  const Real y = member.load[1] + member.section.mass * frame.gravity[1];
  return {x * axis.cosine + y * axis.sine, y * axis.cosine - x * axis.sine};
}

/// Equations of the force method: B f + p on every coordinate, compliances Phi f + phi0.
struct Equations {
  RealMatrix B, Phi;
  RealVector p, phi0;
};

void add_member(const Frame& frame, int index, const FrameCoordinates& coordinates, Equations& e) {
  const FrameMember& member = frame.members[index];
  const MemberAxis axis = member_axis(frame, member);
  const auto load = member_load(frame, member);
  const Real L = axis.length;
  const auto u = coordinates.member_indices(index);
  const std::array<Real, 3> x_of = {axis.cosine, -axis.sine, 0};  // world x of unit N, V, M
  const std::array<Real, 3> y_of = {axis.sine, axis.cosine, 0};
  for (int k = 0; k < 3; ++k) {
    const std::size_t f = 3 * static_cast<std::size_t>(index) + k;
    e.B(u[0], f) += x_of[k];
    e.B(u[1], f) += y_of[k];
    e.B(u[3], f) -= x_of[k];
    e.B(u[4], f) -= y_of[k];
    e.B(u[2], f) += k == 2 ? 1 : 0;
    e.B(u[5], f) -= k == 2 ? Real(1) : k == 1 ? Real(-L) : Real(0);
  }
  e.p[u[3]] += (load[0] * x_of[0] + load[1] * x_of[1]) * L;
  e.p[u[4]] += (load[0] * y_of[0] + load[1] * y_of[1]) * L;
  e.p[u[5]] -= load[1] * L * L / 2;

  const auto length = static_cast<double>(L);
  const std::array<double, 2> q = {static_cast<double>(load[0]), static_cast<double>(load[1])};
  for (int i = 0; i < 3; ++i) {
    const std::size_t row = 3 * static_cast<std::size_t>(index) + i;
    for (int j = 0; j < 3; ++j) {
      e.Phi(row, 3 * static_cast<std::size_t>(index) + j) =
          compliance(i, j, member.section, q, length);
    }
    e.phi0[row] = compliance(i, 3, member.section, q, length);
  }
}

void add_loads(const Frame& frame, const FrameCoordinates& coordinates, Equations& e) {
  const auto add = [&](int node, int motion, const Real& force) {
    const int index = coordinates.node_index(node, motion);
    if (index >= 0) {
      e.p[index] += force;
    } else if (force != 0) {
      throw DerivationError("a moment on node " + frame.nodes[node].name + ", which cannot turn");
    }
  };
  for (const FrameLoad& load : frame.loads) {
    for (int motion = 0; motion < 3; ++motion) add(load.node, motion, load.force[motion]);
  }
  for (const FrameMass& mass : frame.masses) {
    const Real fx = mass.mass * frame.gravity[0];
    const Real fy = mass.mass * frame.gravity[1];
    add(mass.node, 0, fx);
    add(mass.node, 1, fy);
    add(mass.node, 2, mass.offset[0] * fy - mass.offset[1] * fx);
  }
}

Equations equations(const Frame& frame, const FrameCoordinates& coordinates) {
  const std::vector<SpringElement> springs = coordinates.springs(frame);
  const std::size_t forces = 3 * frame.members.size() + springs.size();
  const std::size_t n = coordinates.size();
  Equations e{RealMatrix::Zero(n, forces), RealMatrix::Zero(forces, forces), RealVector::Zero(n),
              RealVector::Zero(forces)};
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    add_member(frame, static_cast<int>(i), coordinates, e);
  }
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const std::size_t f = 3 * frame.members.size() + i;
    if (springs[i].from >= 0) e.B(springs[i].from, f) += 1;
    e.B(springs[i].to, f) -= 1;
    e.Phi(f, f) = 1 / springs[i].stiffness;
  }
  add_loads(frame, coordinates, e);
  return e;
}

/// Phi f + B^T N q = -phi0, N^T (B f + p) = 0; returns f, then q.
RealVector minimize_complementary_energy(const Equations& e, const RealMatrix& N) {
  const RealMatrix G = N.transpose() * e.B;
  RealMatrix system(e.Phi.rows() + N.cols(), e.Phi.rows() + N.cols());
  system << e.Phi, G.transpose(), G, RealMatrix::Zero(N.cols(), N.cols());
  RealVector load(system.rows());
  load << -e.phi0, -N.transpose() * e.p;
  return solve(system, load,
               "the frame can move freely, or a rigid part's forces are not determined",
               Real(1e-35));
}

}  // namespace

FrameStatics unit_load_statics(const Frame& frame) {
  const FrameCoordinates coordinates(frame, false);
  const Equations e = equations(frame, coordinates);
  const RealVector x = minimize_complementary_energy(e, coordinates.N());
  const RealVector f = x.head(e.Phi.rows());

  FrameStatics statics;
  statics.displacement = coordinates.N() * x.tail(coordinates.free());
  statics.residual_force = e.B * f + e.p;
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    const auto load = member_load(frame, frame.members[i]);
    const Real L = member_axis(frame, frame.members[i]).length;
    const Real N = f[3 * i];
    const Real V = f[3 * i + 1];
    const Real M = f[3 * i + 2];
    statics.members.push_back(
        {{N, N - load[0] * L}, {V, V - load[1] * L}, {M, M - V * L + load[1] * L * L / 2}});
  }
  return statics;
}

}  // namespace trammel::references
