#include <algorithm>

#include "references/frames/programs.h"
#include "references/frames/unit_load.h"
#include "references/frames/wittrick_williams.h"
#include "references/numerics/real.h"

/// Critical loads of a frame by the Wittrick-Williams count.
namespace trammel::references {

namespace {

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

std::vector<Real> frame_buckling_program(const Arguments& arguments) {
  const Frame frame = with_axial_forces(frame_from_arguments(arguments));
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
      0, arguments.count("count"));
}

}  // namespace trammel::references
