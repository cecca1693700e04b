#include "references/frames/wittrick_williams.h"

#include <algorithm>
#include <boost/math/policies/policy.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <sstream>
#include <utility>

#include "references/frames/unit_load.h"

namespace trammel::references {

namespace {

/// Returns a bracket of relative width 1e-8 about the root `index`, computed in double precision:
/// the count of roots is less than `index` at the lower end of the bracket, and at least `index` at
/// its upper end.
std::pair<Real, Real> coarse_bracket(const CountingFunction& f, int index) {
  double lo = f.lo, hi = f.hi;
  for (int i = 0; f.coarse(hi) < index; ++i) {
    if (i > 60)
      throw DerivationError("fewer than " + std::to_string(index) +
                            " natural frequencies or buckling loads were found");
    lo = hi;
    hi *= 2;
  }
  while (hi - lo > 1e-8 * hi) {
    const double middle = (lo + hi) / 2;
    (f.coarse(middle) < index ? lo : hi) = middle;
  }
  return {Real(lo) * (1 - Real(1e-9)), Real(hi) * (1 + Real(1e-9))};
}

/// Widens a bracket until the count in extended precision shows that the bracket contains the root.
void widen_bracket(const CountingFunction& f, int index, Real& lo, Real& hi) {
  for (Real relative_width = Real(1e-8); f.fine(lo).below >= index; relative_width *= 10) {
    lo *= 1 - std::min(relative_width, Real(0.5));
    if (lo < Real(f.lo) * Real(1e-3))
      throw DerivationError("the lowest natural frequency or buckling load is too close to zero");
  }
  for (Real relative_width = Real(1e-8); f.fine(hi).below < index; relative_width *= 10)
    hi *= 1 + relative_width;
}

/// Returns the argument x at which the count reaches `index`. Let m be the number of roots in the
/// bracket. The function |det D|^(1/m), negative if the count is less than `index`, has a simple
/// zero at x. If a natural frequency of a member with clamped ends lies in the bracket, det D has a
/// pole. Bisection then uses only the count.
Real refine_root(const CountingFunction& f, int index, const Real& lo, const Real& hi) {
  const auto at_lo = f.fine(lo);
  const auto at_hi = f.fine(hi);
  const Real shift = at_lo.log_determinant;
  const int m = at_hi.below - at_lo.below;
  const bool pole = at_lo.clamped_below != at_hi.clamped_below;
  const auto value = [&](const DynamicStiffness<Real>::Count& c) {
    const int sign = c.below < index ? -1 : 1;
    return pole ? Real(sign) : Real(sign * exp((c.log_determinant - shift) / m));
  };
  std::uintmax_t iterations = 400;
  const auto close = [](const Real& a, const Real& b) { return b - a <= Real(1e-20) * b; };
  const auto ends = boost::math::tools::toms748_solve(
      [&](const Real& x) { return value(f.fine(x)); }, lo, hi, value(at_lo), value(at_hi), close,
      iterations, boost::math::policies::policy<>());
  return (ends.first + ends.second) / 2;
}

/// Returns the argument at which the count reaches `index` >= 1, with a relative error of 1e-20.
Real counted_root(const CountingFunction& f, int index) {
  auto [lo, hi] = coarse_bracket(f, index);
  widen_bracket(f, index, lo, hi);
  return refine_root(f, index, lo, hi);
}

/// Returns the frame with the axial forces that its loads cause, as tensions of its members.
Frame frame_with_axial_forces(Frame frame) {
  const FrameStatics statics = force_method_statics(frame);
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    FrameMember& member = frame.members[i];
    const auto& N = statics.members[i].N;
    if (N[0] != N[1])
      throw DerivationError("buckling requires a constant axial force in member " + member.name);
    if (member.section.shear_compliance > 0)
      throw DerivationError("buckling requires Euler-Bernoulli members");
    member.section.tension = N[0];
  }
  return frame;
}

/// Returns approximately the smallest load factor at which a member with pinned ends buckles. The
/// factor pi^2 is rounded to 10.
Real estimated_buckling_factor(const Frame& frame) {
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

/// Returns the number rounded to twelve significant digits. Rounding removes the round-off of a
/// sum, so that 0.1 + 0.2 is stored as the decimal 0.3.
Json decimal(double value) {
  std::ostringstream text;
  text.precision(12);
  text << value;
  return Json::parse(text.str());
}

class Differences {
 public:
  explicit Differences(const Arguments& arguments)
      : arguments_(arguments), count_(arguments.natural_number("count")) {
    const Json& json = arguments.json();
    for (const std::string& text : arguments.texts("pointers")) {
      const Json::json_pointer pointer(text);
      if (!json.contains(pointer) || !json[pointer].is_number())
        arguments.fail("pointers", "expected pointers to numbers (got " + text + ")");
      if (!pointers_.empty() && json[pointer] != json[pointers_.front()])
        arguments.fail("pointers", "expected pointers to equal numbers");
      pointers_.push_back(pointer);
    }
  }

  [[nodiscard]] std::vector<Real> central(double step) const {
    const std::vector<Real> above = frequencies(step);
    const std::vector<Real> below = frequencies(-step);
    std::vector<Real> rate;
    for (std::size_t i = 0; i < above.size(); ++i)
      rate.push_back((above[i] - below[i]) / (2 * Real(decimal(step).dump())));
    return rate;
  }

 private:
  [[nodiscard]] std::vector<Real> frequencies(double change) const {
    Json json = arguments_.json();
    for (const auto& pointer : pointers_)
      json[pointer] = decimal(json[pointer].get<double>() + change);
    return frame_frequencies(frame_from_arguments(Arguments(json, "")), count_).frequencies;
  }

  const Arguments& arguments_;
  int count_;
  std::vector<Json::json_pointer> pointers_;
};

}  // namespace

std::vector<Real> counted_roots(const CountingFunction& f, int skipped, int count) {
  std::vector<Real> roots;
  while (static_cast<int>(roots.size()) < count) {
    const int found = skipped + static_cast<int>(roots.size());
    const Real root = counted_root(f, found + 1);
    const int multiplicity = f.fine(root * (1 + Real(1e-15))).below - found;
    const int missing = count - static_cast<int>(roots.size());
    roots.insert(roots.end(), std::clamp(multiplicity, 1, missing), root);
  }
  return roots;
}

Real frequency_order_of_magnitude(const Frame& frame) {
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
  const Real scale = frequency_order_of_magnitude(frame);
  const CountingFunction f{[&](double w) { return coarse.wittrick_williams(w).below; },
                           [&](const Real& w) { return fine.wittrick_williams(w); },
                           1e-3 * static_cast<double>(scale), static_cast<double>(scale)};
  FrameFrequencies result;
  result.rigid_motions = fine.wittrick_williams(scale * Real(1e-8)).below;
  result.frequencies = counted_roots(f, result.rigid_motions, count);
  for (Real& w : result.frequencies) w /= 2 * pi<Real>();
  return result;
}

int count_frequencies_below(const Frame& frame, const Real& frequency) {
  return DynamicStiffness<Real>(frame).wittrick_williams(2 * pi<Real>() * frequency).below;
}

std::vector<Real> frame_frequencies_program(const Arguments& arguments) {
  return frame_frequencies(frame_from_arguments(arguments), arguments.natural_number("count"))
      .frequencies;
}

std::vector<Real> frame_frequency_count_program(const Arguments& arguments) {
  return {count_frequencies_below(frame_from_arguments(arguments), arguments.positive("below_Hz"))};
}

std::vector<Real> frame_buckling_program(const Arguments& arguments) {
  const Frame frame = frame_with_axial_forces(frame_from_arguments(arguments));
  const DynamicStiffness<double> coarse(frame);
  const DynamicStiffness<Real> fine(frame);
  const Real w = frequency_order_of_magnitude(frame) * Real(1e-11);  // shifts load factors by 1e-22
  const auto coarse_w = static_cast<double>(frequency_order_of_magnitude(frame)) * 1e-3;
  if (fine.wittrick_williams(w, Real(1e-6) * estimated_buckling_factor(frame)).below > 0)
    throw DerivationError("the frame can move freely");
  const auto scale = static_cast<double>(estimated_buckling_factor(frame));
  return counted_roots(
      {[&](double factor) { return coarse.wittrick_williams(coarse_w, factor).below; },
       [&](const Real& factor) { return fine.wittrick_williams(w, factor); }, 1e-4 * scale, scale},
      0, arguments.natural_number("count"));
}

std::vector<Real> frame_frequency_sensitivity_program(const Arguments& arguments) {
  const auto step = static_cast<double>(arguments.positive("step"));
  const Differences differences(arguments);
  const std::vector<Real> a = differences.central(step);
  const std::vector<Real> b = differences.central(step / 2);
  const std::vector<Real> c = differences.central(step / 4);
  std::vector<Real> rate;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Real ab = (4 * b[i] - a[i]) / 3, bc = (4 * c[i] - b[i]) / 3;
    rate.push_back((16 * bc - ab) / 15);
  }
  return rate;
}

}  // namespace trammel::references
