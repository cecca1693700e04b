#include "references/frames/wittrick_williams.h"

#include <algorithm>

#include "references/frames/counted_roots.h"
#include "references/frames/frame_programs.h"
#include "references/frames/unit_load.h"
#include "references/numerics/roots.h"

namespace trammel::references {

namespace {

/// The lowest circular frequency that any member could have by itself: a scale, not a bound.
Real frequency_scale(const Frame& frame) {
  Real scale = 0;
  for (const FrameMember& member : frame.members) {
    const Real L = member_axis(frame, member).length;
    if (member.section.mass == 0) throw DerivationError("member " + member.name + " has no mass");
    const Real w = sqrt(member.section.EI / member.section.mass) / (L * L);
    scale = scale == 0 ? w : std::min(scale, w);
  }
  if (scale == 0) throw DerivationError("the frame has no members");
  return scale;
}

/// The frame with the axial forces that its loads bring about.
Frame with_axial_forces(Frame frame) {
  const FrameStatics statics = unit_load_statics(frame);
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    FrameMember& member = frame.members[i];
    const auto& N = statics.members[i].N;
    if (N[0] != N[1]) {
      throw DerivationError("the axial force varies along member " + member.name);
    }
    if (member.section.shear_compliance > 0) {
      throw DerivationError("buckling is derived for Euler-Bernoulli members alone");
    }
    member.section.tension = N[0];
  }
  return frame;
}

/// The load at which a pinned member alone would buckle, as a factor: the smallest of them.
Real buckling_scale(const Frame& frame) {
  Real scale = 0;
  for (const FrameMember& member : frame.members) {
    const Real L = member_axis(frame, member).length;
    const Real compression = -member.section.tension;
    if (!(compression > 0)) continue;
    const Real factor = 10 * member.section.EI / (L * L * compression);
    scale = scale == 0 ? factor : std::min(scale, factor);
  }
  if (scale == 0) throw DerivationError("no member is in compression");
  return scale;
}

}  // namespace

FrameFrequencies frame_frequencies(const Frame& frame, int count) {
  const DynamicStiffness<double> coarse(frame);
  const DynamicStiffness<Real> fine(frame);
  const Real scale = frequency_scale(frame);
  const CountingFunction f{[&](double w) { return coarse.count(w).below; },
                           [&](const Real& w) { return fine.count(w); },
                           1e-3 * static_cast<double>(scale), static_cast<double>(scale)};
  FrameFrequencies result;
  result.rigid_motions = fine.count(scale * Real(1e-8)).below;
  result.frequencies = counted_roots(f, result.rigid_motions, count);
  for (Real& w : result.frequencies) w /= 2 * pi<Real>();
  return result;
}

int frequencies_below(const Frame& frame, const Real& frequency) {
  return DynamicStiffness<Real>(frame).count(2 * pi<Real>() * frequency).below;
}

std::vector<Real> frame_buckling_factors(const Frame& unloaded, int count) {
  const Frame frame = with_axial_forces(unloaded);
  const DynamicStiffness<double> coarse(frame);
  const DynamicStiffness<Real> fine(frame);
  const Real w = frequency_scale(frame) * Real(1e-11);  // its square changes a factor by 1e-22
  const auto coarse_w = static_cast<double>(frequency_scale(frame)) * 1e-3;
  if (fine.count(w, Real(1e-6) * buckling_scale(frame)).below > 0) {
    throw DerivationError("the frame can move freely");
  }
  const auto scale = static_cast<double>(buckling_scale(frame));
  return counted_roots(
      {[&](double factor) { return coarse.count(coarse_w, factor).below; },
       [&](const Real& factor) { return fine.count(w, factor); }, 1e-4 * scale, scale},
      0, count);
}

std::vector<double> frame_frequencies_program(const Json& json) {
  const Arguments arguments(json, "", {"model", "manipulator", "pose", "count"});
  return to_doubles(
      frame_frequencies(frame_from_arguments(arguments), arguments.count("count")).frequencies);
}

std::vector<double> frame_count_program(const Json& json) {
  const Arguments arguments(json, "", {"model", "manipulator", "pose", "below_Hz"});
  return {static_cast<double>(
      frequencies_below(frame_from_arguments(arguments), arguments.positive("below_Hz")))};
}

std::vector<double> frame_buckling_program(const Json& json) {
  const Arguments arguments(json, "", {"model", "manipulator", "pose", "loads", "count"});
  return to_doubles(
      frame_buckling_factors(frame_from_arguments(arguments), arguments.count("count")));
}

}  // namespace trammel::references
