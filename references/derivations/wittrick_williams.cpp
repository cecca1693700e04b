#include "references/derivations/wittrick_williams.h"

#include <algorithm>
#include <boost/math/policies/policy.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "references/derivations/dynamic_stiffness.h"
#include "references/derivations/frame_programs.h"

namespace trammel::derive {

namespace {

/// The lowest circular frequency that any member could have by itself: a scale, not a bound.
double lowest_scale(const Frame& frame) {
  double scale = 0;
  for (const FrameMember& member : frame.members) {
    const Real L = member_axis(frame, member).length;
    if (member.section.mass == 0) continue;
    const auto w = static_cast<double>(sqrt(member.section.EI / member.section.mass) / (L * L));
    scale = scale == 0 ? w : std::min(scale, w);
  }
  if (scale == 0) throw DerivationError("the frame's members have no mass");
  return scale;
}

class Search {
 public:
  explicit Search(const Frame& frame) : coarse_(frame), fine_(frame), scale_(lowest_scale(frame)) {
    rigid_ = fine_.count(Real(scale_) * Real(1e-8)).below;
  }

  [[nodiscard]] int rigid_motions() const { return rigid_; }

  /// The `index`-th frequency, rigid motions included, from 1 [rad/s].
  [[nodiscard]] Real frequency(int index) const {
    auto [lo, hi] = coarse_bracket(index);
    confirm(index, lo, hi);
    return refined(index, lo, hi);
  }

  [[nodiscard]] int count(const Real& w) const { return fine_.count(w).below; }

 private:
  /// lo and hi within 1e-8 of each other, with fewer than `index` below lo and not so below hi.
  [[nodiscard]] std::pair<Real, Real> coarse_bracket(int index) const {
    double lo = scale_ * 1e-3;
    double hi = scale_;
    for (int i = 0; coarse_.count(hi).below < index; ++i) {
      if (i > 60) throw DerivationError("too few natural frequencies were found");
      lo = hi;
      hi *= 2;
    }
    while (hi - lo > 1e-8 * hi) {
      const double middle = (lo + hi) / 2;
      (coarse_.count(middle).below < index ? lo : hi) = middle;
    }
    return {Real(lo) * (1 - Real(1e-9)), Real(hi) * (1 + Real(1e-9))};
  }

  /// Widens the bracket until the count in extended precision agrees with it.
  void confirm(int index, Real& lo, Real& hi) const {
    for (Real widen = Real(1e-8); count(lo) >= index; widen *= 10)
      lo *= 1 - std::min(widen, Real(0.5));
    for (Real widen = Real(1e-8); count(hi) < index; widen *= 10) hi *= 1 + widen;
  }

  /// Where the count passes `index`. The m-th root of |det D|, with the sign of the count, crosses
  /// zero there as a simple root does, m the frequencies that the bracket holds; where a clamped
  /// frequency of a member falls into the bracket, det D has a pole and the count alone is
  /// bisected.
  [[nodiscard]] Real refined(int index, Real lo, Real hi) const {
    const auto at_lo = fine_.count(lo);
    const auto at_hi = fine_.count(hi);
    const Real shift = at_lo.log_determinant;
    const int m = at_hi.below - at_lo.below;
    const bool pole = at_lo.clamped_below != at_hi.clamped_below;
    const auto value = [&](const typename DynamicStiffness<Real>::Count& c) {
      const int sign = c.below < index ? -1 : 1;
      return pole ? Real(sign) : Real(sign * exp((c.log_determinant - shift) / m));
    };
    std::uintmax_t iterations = 400;
    const auto close = [](const Real& a, const Real& b) { return b - a <= Real(1e-20) * b; };
    const auto ends = boost::math::tools::toms748_solve(
        [&](const Real& w) { return value(fine_.count(w)); }, lo, hi, value(at_lo), value(at_hi),
        close, iterations, boost::math::policies::policy<>());
    return (ends.first + ends.second) / 2;
  }

  DynamicStiffness<double> coarse_;
  DynamicStiffness<Real> fine_;
  double scale_;
  int rigid_ = 0;
};

}  // namespace

FrameFrequencies frame_frequencies(const Frame& frame, int count) {
  const Search search(frame);
  FrameFrequencies result;
  result.rigid_motions = search.rigid_motions();
  while (static_cast<int>(result.frequencies.size()) < count) {
    const int found = result.rigid_motions + static_cast<int>(result.frequencies.size());
    const Real w = search.frequency(found + 1);
    const int copies = search.count(w * (1 + Real(1e-15))) - found;
    for (int i = 0; i < std::max(copies, 1) && static_cast<int>(result.frequencies.size()) < count;
         ++i) {
      result.frequencies.push_back(w / (2 * pi<Real>()));
    }
  }
  return result;
}

int frequencies_below(const Frame& frame, const Real& frequency) {
  return DynamicStiffness<Real>(frame).count(2 * pi<Real>() * frequency).below;
}

std::vector<double> frame_frequencies_program(const Json& json) {
  const Arguments arguments(json, "", {"model", "manipulator", "pose", "count"});
  std::vector<double> values;
  for (const Real& f :
       frame_frequencies(frame_of(arguments), arguments.count("count")).frequencies) {
    values.push_back(static_cast<double>(f));
  }
  return values;
}

std::vector<double> frame_count_program(const Json& json) {
  const Arguments arguments(json, "", {"model", "manipulator", "pose", "below_Hz"});
  return {
      static_cast<double>(frequencies_below(frame_of(arguments), arguments.positive("below_Hz")))};
}

}  // namespace trammel::derive
