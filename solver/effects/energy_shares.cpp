#include "solver/effects/energy_shares.h"

#include <algorithm>
#include <cmath>

#include "solver/assembly/element_mass.h"
#include "solver/assembly/strain.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {

using Eigen::VectorXd;

namespace {

/// How much of each of an element's three deformations is the effect's; the last is antisymmetric
/// bending.
Vector3d deformation_share(const System& system, const FrameElement& e, Effect effect) {
  if (e.is_bar()) return Vector3d::Zero();
  if (effect == Effect::axial_flexibility) return {1, 0, 0};
  if (effect != Effect::shear) return Vector3d::Zero();
  const BeamTheory theory = system.model.members[to_size(e.member)].theory;
  const double phi = shear_ratio(e.section, theory, e.length);
  return {0, 0, phi / (1 + phi)};
}

}  // namespace

VectorXd EnergyShares::forces(Effect effect) const {
  const auto frames = static_cast<Index>(system_.mesh.frame.size());
  const auto plates = frames + static_cast<Index>(system_.model.triangles.size());
  Index own_springs = 0;
  for (const Spring& spring : system_.model.springs)
    own_springs += (spring.stiffness.array() != 0).count();
  VectorXd force = VectorXd::Zero(u_.size());
  Index visited = 0;
  for_each_deformation(system_, [&](const auto& coordinates, const auto& B, const auto& c) {
    const Index i = visited++;
    auto part = (c.asDiagonal() * (B * detail::gather(coordinates, u_))).eval();
    if (i < frames) {
      const Vector3d w = deformation_share(system_, system_.mesh.frame[to_size(i)], effect);
      for (Index k = 0; k < part.size(); ++k) part[k] *= w[k];
    } else {
      const bool plate = i < plates && effect == Effect::platform_flexibility;
      const bool joint = i >= plates + own_springs && effect == Effect::joint_compliance;
      if (!plate && !joint) return;
    }
    detail::scatter(coordinates, (B.transpose() * part).eval(), force);
  });
  return force;
}

double EnergyShares::elastic(Effect effect) const {
  return u_.dot(forces(effect)) / energy_;
}

double EnergyShares::kinetic(bool rotary_only) const {
  double energy = 0;
  for (const FrameElement& e : system_.mesh.frame) {
    const Member& member = system_.model.members[static_cast<std::size_t>(e.member)];
    FrameElement part = e;
    if (rotary_only) {
      if (e.is_bar() || !has_rotary_inertia(member.theory)) continue;
      part.section.mass_per_length = 0;
    }
    const Vector6d motion = detail::gather(e.coordinates, u_);
    energy += motion.dot(world_mass(part, member) * motion);
  }
  if (rotary_only) return energy;
  for (std::size_t i = 0; i < system_.model.members.size(); ++i) {
    for (std::size_t end = 0; end < 2; ++end) {
      const Index rotation = system_.coordinates.member_end[i][end];
      if (rotation < 0) continue;
      energy += system_.model.members[i].ends[end].inertia * u_[rotation] * u_[rotation];
    }
  }
  return energy;
}

double frequency_change_without(double share) {
  constexpr double kMaxShare = 1 - 1e-12;
  return 1 / std::sqrt(1 - std::min(share, kMaxShare)) - 1;
}

}  // namespace trammel::solver
