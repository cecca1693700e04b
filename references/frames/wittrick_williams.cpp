#include "references/frames/wittrick_williams.h"

#include <algorithm>

#include "references/frames/counted_roots.h"
#include "references/frames/frame_arguments.h"
#include "references/numerics/roots.h"

namespace trammel::references {

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

}  // namespace trammel::references
