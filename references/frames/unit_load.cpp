#include "references/frames/unit_load.h"

#include <algorithm>
#include <map>

#include "references/frames/frame_coordinates.h"

namespace trammel::references {

namespace {

/// Returns the components of the load per unit length along the axis of a member and to its left
/// [N/m]. The load includes the weight.
std::array<Real, 2> member_load(const Frame& frame, const FrameMember& member) {
  const MemberAxis axis = member_axis(frame, member);
  const Real x = member.load[0] + member.section.mass * frame.gravity[0];
  const Real y = member.load[1] + member.section.mass * frame.gravity[1];
  return {x * axis.cosine + y * axis.sine, y * axis.cosine - x * axis.sine};
}

/// Matrices of the force method for the internal forces f of members and springs. B f + p are the
/// resulting forces on the coordinates of the nodes under the loads p. Phi f + phi0 are the
/// deformations of members and springs, where phi0 are the deformations due to distributed loads.
struct Equations {
  RealMatrix B, Phi;
  RealVector p, phi0;
};

/// Integrates products of the force diagrams of a member over its length. Rows: diagrams of a unit
/// N, V and M at the start. Columns: these diagrams, then the diagram of the distributed load. Four
/// Gauss points integrate these polynomials exactly.
Eigen::Matrix<double, 3, 4> compliances(const FrameSection& section,
                                        const std::array<Real, 2>& load, const Real& length) {
  const auto q_u = static_cast<double>(load[0]), q_w = static_cast<double>(load[1]);
  const auto EI = static_cast<double>(section.EI);
  const auto axial = static_cast<double>(section.axial_compliance);
  const auto shear = static_cast<double>(section.shear_compliance);
  const auto products = [&](double x) -> Eigen::Matrix<double, 3, 4> {
    const Eigen::RowVector4d N(1, 0, 0, -q_u * x), V(0, 1, 0, -q_w * x);
    const Eigen::RowVector4d M(0, -x, 1, q_w * x * x / 2);
    return M.head<3>().transpose() * M / EI + N.head<3>().transpose() * N * axial +
           V.head<3>().transpose() * V * shear;
  };
  constexpr std::array<double, 2> kPoints = {0.33998104358485626, 0.86113631159405257};
  constexpr std::array<double, 2> kWeights = {0.65214515486254614, 0.34785484513745386};
  const double half = static_cast<double>(length) / 2;
  Eigen::Matrix<double, 3, 4> sum = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t i = 0; i < 2; ++i)
    sum += kWeights[i] * (products(half + half * kPoints[i]) + products(half - half * kPoints[i]));
  return half * sum;
}

void add_member(const Frame& frame, int index, const FrameCoordinates& coordinates, Equations& e) {
  const FrameMember& member = frame.members[index];
  const MemberAxis axis = member_axis(frame, member);
  const auto load = member_load(frame, member);
  const Real L = axis.length;
  Eigen::Matrix<Real, 3, 3> axes;  // world forces of unit N, V, M
  axes << axis.cosine, -axis.sine, 0, axis.sine, axis.cosine, 0, 0, 0, 1;
  Eigen::Matrix<Real, 6, 3> forces;
  forces << axes, -axes;
  forces(5, 1) += L;
  const RealVector end_load =
      axes * Eigen::Matrix<Real, 3, 1>(load[0] * L, load[1] * L, -load[1] * L * L / 2);
  const auto u = coordinates.member_indices(index);
  for (int row = 0; row < 3; ++row) e.p[u[3 + row]] += end_load[row];
  for (int row = 0; row < 6; ++row) e.B.row(u[row]).segment<3>(3 * index) += forces.row(row);
  const Eigen::Matrix<double, 3, 4> phi = compliances(member.section, load, L);
  e.Phi.block<3, 3>(3 * index, 3 * index) = phi.leftCols<3>().cast<Real>();
  e.phi0.segment<3>(3 * index) = phi.col(3).cast<Real>();
}

void add_loads(const Frame& frame, const FrameCoordinates& coordinates, Equations& e) {
  const auto add = [&](int node, int motion, const Real& force) {
    const int index = coordinates.node_coordinate_index(node, motion);
    if (index >= 0) {
      e.p[index] += force;
    } else if (force != 0) {
      throw DerivationError("node " + frame.nodes[node].name + " has a moment but no rotation");
    }
  };
  for (const FrameLoad& load : frame.loads) {
    for (int motion = 0; motion < 3; ++motion) add(load.node, motion, load.force[motion]);
  }
  for (const FrameMass& mass : frame.masses) {
    const Real fx = mass.mass * frame.gravity[0], fy = mass.mass * frame.gravity[1];
    add(mass.node, 0, fx);
    add(mass.node, 1, fy);
    add(mass.node, 2, mass.offset[0] * fy - mass.offset[1] * fx);
  }
}

Equations force_method_equations(const Frame& frame, const FrameCoordinates& coordinates) {
  const std::vector<SpringElement> springs = coordinates.springs(frame);
  const std::size_t forces = 3 * frame.members.size() + springs.size();
  const std::size_t n = coordinates.coordinate_count();
  Equations e{RealMatrix::Zero(n, forces), RealMatrix::Zero(forces, forces), RealVector::Zero(n),
              RealVector::Zero(forces)};
  for (std::size_t i = 0; i < frame.members.size(); ++i)
    add_member(frame, static_cast<int>(i), coordinates, e);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const std::size_t f = 3 * frame.members.size() + i;
    if (springs[i].from >= 0) e.B(springs[i].from, f) += 1;
    e.B(springs[i].to, f) -= 1;
    e.Phi(f, f) = 1 / springs[i].stiffness;
  }
  add_loads(frame, coordinates, e);
  return e;
}

/// Minimizes the complementary energy by the equations Phi f + B^T N q = -phi0, N^T (B f + p) = 0.
/// The matrix N maps the free displacements q to the displacements of all coordinates.
/// @returns the internal forces f, then the free displacements q.
RealVector minimize_complementary_energy(const Equations& e, const RealMatrix& N) {
  const RealMatrix G = N.transpose() * e.B;
  RealMatrix system(e.Phi.rows() + N.cols(), e.Phi.rows() + N.cols());
  system << e.Phi, G.transpose(), G, RealMatrix::Zero(N.cols(), N.cols());
  RealVector load(system.rows());
  load << -e.phi0, -N.transpose() * e.p;
  return solve(system, load,
               "the frame can move freely, or the forces of a rigid part are undetermined",
               Real(1e-35));
}

using Values = std::map<std::string, Real>;

void add_node_outputs(const Frame& frame, const FrameCoordinates& coordinates,
                      const FrameStatics& statics, int node, Values& values) {
  static const char* const displacements[] = {
      "displacement_x_m:", "displacement_y_m:", "rotation_rad:"};
  static const char* const reactions[] = {"reaction_x_N:", "reaction_y_N:", "reaction_moment_N_m:"};
  const std::string& name = frame.nodes[node].name;
  const bool is_in_body = std::ranges::any_of(frame.bodies, [&](const FrameBody& body) {
    return body.reference == node || std::ranges::count(body.attached, node) > 0;
  });
  for (int motion = 0; motion < 3; ++motion) {
    const int index = coordinates.node_coordinate_index(node, motion);
    if (index < 0) continue;
    values[displacements[motion] + name] = statics.displacement[index];
    if (!is_in_body) values[reactions[motion] + name] = -statics.residual_force[index];
  }
  const Real x = values[displacements[0] + name], y = values[displacements[1] + name];
  values["deflection_m:" + name] = sqrt(x * x + y * y);
}

/// Adds the outputs at both ends of a member. If the member has no distributed load, its largest
/// stress occurs at an end, and is |N|/A + |M|/W with the section modulus W.
void add_member_outputs(const Frame& frame, const FrameCoordinates& coordinates,
                        const FrameStatics& statics, int index, Values& values) {
  const FrameMember& member = frame.members[index];
  const MemberForces& forces = statics.members[index];
  const bool has_stress = member.section.modulus > 0 && member.load[0] == 0 && member.load[1] == 0;
  for (int end = 0; end < 2; ++end) {
    const std::string name = ":" + member.name + (end == 0 ? ".start" : ".end");
    values["axial_force_N" + name] = forces.N[end];
    values["shear_force_N" + name] = forces.V[end];
    values["bending_moment_N_m" + name] = forces.M[end];
    values["end_rotation_rad" + name] =
        statics.displacement[coordinates.end_rotation_index(index, end)];
    if (!has_stress) continue;
    Real& stress = values["stress_Pa:" + member.name];
    stress = std::max(stress, Real(abs(forces.N[end]) / member.section.area +
                                   abs(forces.M[end]) / member.section.modulus));
  }
}

/// Returns all outputs of the statics of a frame by name.
Values outputs(const Frame& frame) {
  const FrameCoordinates coordinates(frame, false);
  const FrameStatics statics = force_method_statics(frame);
  Values values;
  for (std::size_t i = 0; i < frame.nodes.size(); ++i)
    add_node_outputs(frame, coordinates, statics, static_cast<int>(i), values);
  for (std::size_t i = 0; i < frame.members.size(); ++i)
    add_member_outputs(frame, coordinates, statics, static_cast<int>(i), values);
  Real& work = values["load_work_J"];
  for (const FrameLoad& load : frame.loads) {
    for (int motion = 0; motion < 3; ++motion) {
      const int index = coordinates.node_coordinate_index(load.node, motion);
      if (index >= 0) work += load.force[motion] * statics.displacement[index];
    }
  }
  values["strain_energy_J"] = work / 2;
  return values;
}

}  // namespace

FrameStatics force_method_statics(const Frame& frame) {
  const FrameCoordinates coordinates(frame, false);
  const Equations e = force_method_equations(frame, coordinates);
  const RealVector x = minimize_complementary_energy(e, coordinates.N());
  const RealVector f = x.head(e.Phi.rows());

  FrameStatics statics;
  statics.displacement = coordinates.N() * x.tail(coordinates.free_count());
  statics.residual_force = e.B * f + e.p;
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    const auto load = member_load(frame, frame.members[i]);
    const Real L = member_axis(frame, frame.members[i]).length;
    const Real N = f[3 * i], V = f[3 * i + 1], M = f[3 * i + 2];
    statics.members.push_back(
        {{N, N - load[0] * L}, {V, V - load[1] * L}, {M, M - V * L + load[1] * L * L / 2}});
  }
  return statics;
}

std::vector<Real> frame_statics_program(const Arguments& arguments) {
  const Values values = outputs(frame_from_arguments(arguments));
  std::vector<Real> result;
  for (const std::string& name : arguments.texts("outputs")) {
    const auto value = values.find(name);
    if (value == values.end())
      arguments.fail("outputs", "'" + name + "' is not an output of this frame");
    result.push_back(value->second);
  }
  return result;
}

}  // namespace trammel::references
