#include "harness/statics_modes/frequency_differences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/linear/modes.h"
#include "solver/manipulator/frequency_sensitivity.h"

namespace trammel::harness {
namespace {

using Eigen::VectorXd;
using solver::DesignParameter;
using solver::FrequencySet;
using solver::Index;
using solver::ManipulatorDesign;
using solver::ModalSolution;
using solver::Pose;
using solver::Vector2d;
using Kind = DesignParameter::Kind;

/// Calls visit(value) for each number of links, platform and joints that the parameter selects.
template <class Visit>
void visit_parameter(ManipulatorDesign& design, const DesignParameter& parameter, Visit&& visit) {
  const Kind kind = parameter.kind;
  const bool length = kind == Kind::length;
  const auto meet = [&visit](double* x) {
    if (x != nullptr) visit(*x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (kind == Kind::active_stiffness && design.active[i].kind == solver::ActiveKind::sprung)
      visit(design.active[i].stiffness);
    if (kind == Kind::elbow_stiffness && design.elbow[i].kind == solver::ElbowKind::sprung)
      visit(design.elbow[i].stiffness);
    if (kind == Kind::platform_joint_stiffness &&
        design.platform_joint[i].kind == solver::PlatformJointKind::sprung)
      visit(design.platform_joint[i].stiffness);
    if (parameter.proximal[i])
      meet(length ? &design.geometry.proximal[i]
                  : solver::detail::link_property(design.proximal[i], kind));
    if (parameter.distal[i])
      meet(length ? &design.geometry.distal[i]
                  : solver::detail::link_property(design.distal[i], kind));
  }
  if (parameter.platform) meet(solver::detail::property(design.platform, kind));
}

double side(const std::array<Vector2d, 3>& triangle) {
  return (triangle[1] - triangle[0]).norm();
}

void grow(std::array<Vector2d, 3>& triangle, const Vector2d& about, double change) {
  const double factor = change / side(triangle);
  for (Vector2d& corner : triangle) corner += factor * (corner - about);
}

constexpr int kRows = 7;
constexpr double kRatio = 1.6;
/// Number of modes computed in addition to the requested modes. These modes complete the last set
/// of equal frequencies.
constexpr Index kExtraModes = 3;
/// Largest permitted change of a frequency by a finite-difference step, as a fraction of the
/// distance to the nearest other frequency.
constexpr double kShareOfGap = 0.1;

class Differences {
 public:
  Differences(const ManipulatorDesign& design, const Pose& pose, const DesignParameter& parameter,
              Index count)
      : design_(design), pose_(pose), parameter_(parameter), count_(count) {}

  FrequencyDifferences run(double relative_step) {
    const VectorXd all = begin();
    if (!result_.outcome.solved()) return result_;
    extrapolate(first_step(all, relative_step * parameter_value(design_, parameter_)));
    return result_;
  }

  FrequencyDifferences single_quotient(double relative_step, bool is_central) {
    const VectorXd all = begin();
    if (!result_.outcome.solved()) return result_;
    const double step = relative_step * parameter_value(design_, parameter_);
    if (is_central) {
      result_.derivative = central(step);
    } else {
      const VectorXd above = frequencies(step);
      if (above.size() < count_) return result_;
      result_.derivative = (above.head(count_) - all.head(count_)) / step;
    }
    return result_;
  }

 private:
  /// Computes the frequencies of the design with the original value of the parameter.
  VectorXd begin() {
    VectorXd all = frequencies(0);
    result_.frequency = all.head(std::min(count_, all.size()));
    count_ = result_.frequency.size();
    result_.derivative = VectorXd::Constant(count_, std::numeric_limits<double>::quiet_NaN());
    error_estimate_ = VectorXd::Constant(count_, std::numeric_limits<double>::infinity());
    if (result_.outcome.solved()) sets_ = solver::equal_frequencies(all);
    return all;
  }

  VectorXd frequencies(double change) {
    const DesignInPose changed = perturb_design(design_, pose_, parameter_, change);
    const ModalSolution modes = solver::solve_modes(
        solver::assemble(solver::build_manipulator(changed.design, changed.pose)),
        {.count = count_ + kExtraModes});
    result_.counters += modes.counters;
    result_.evidence.add(modes.evidence);
    if (!modes.outcome.solved()) result_.outcome = modes.outcome;
    return modes.frequency;
  }

  [[nodiscard]] bool within_reach(double change) const {
    const DesignInPose changed = perturb_design(design_, pose_, parameter_, change);
    return solver::inverse_kinematics(changed.design.geometry, changed.pose).outcome.solved();
  }

  VectorXd central(double step) {
    const VectorXd above = frequencies(step), below = frequencies(-step);
    const Index needed = sets_.empty() ? 0 : sets_.back().first + sets_.back().count;
    if (std::min(above.size(), below.size()) < needed) {  // the eigensolver did not converge
      return VectorXd::Constant(count_, std::numeric_limits<double>::quiet_NaN());
    }
    VectorXd rate = VectorXd::Zero(count_);
    for (const FrequencySet& set : sets_)
      for (Index k = 0; k < set.count && set.first + k < count_; ++k)
        rate[set.first + k] =
            (above[set.first + k] - below[set.first + set.count - 1 - k]) / (2 * step);
    return rate;
  }

  /// Returns a finite-difference step of at most `step`. The step is so small that the pose remains
  /// within reach if the parameter changes by ten steps, and that adjacent sets of frequencies
  /// remain separate.
  double first_step(const VectorXd& all, double step) {
    while (!within_reach(10 * step) || !within_reach(-10 * step)) step /= 2;
    const double fastest = central(1e-3 * step).cwiseAbs().maxCoeff();
    for (std::size_t i = 1; i < sets_.size(); ++i) {
      const double gap = all[sets_[i].first] - all[sets_[i].first - 1];
      step = std::min(step, kShareOfGap * gap / fastest);
    }
    return step;
  }

  void extrapolate(double step) {
    std::vector<VectorXd> before;
    for (int i = 0; i < kRows; ++i, step /= kRatio) {
      std::vector<VectorXd> row = {central(step)};
      double factor = 1;
      for (std::size_t k = 0; k < before.size(); ++k) {
        factor *= kRatio * kRatio;
        row.emplace_back((factor * row[k] - before[k]) / (factor - 1));
        keep(row[k + 1], row[k], before[k]);
      }
      before = std::move(row);
    }
  }

  void keep(const VectorXd& next, const VectorXd& fine, const VectorXd& coarse) {
    for (Index n = 0; n < count_; ++n) {
      const double change = std::max(std::abs(next[n] - fine[n]), std::abs(next[n] - coarse[n]));
      if (!(change < error_estimate_[n])) continue;
      error_estimate_[n] = change;
      result_.derivative[n] = next[n];
    }
  }

  const ManipulatorDesign& design_;
  const Pose& pose_;
  const DesignParameter& parameter_;
  Index count_;
  std::vector<FrequencySet> sets_;
  VectorXd error_estimate_;  // error of the extrapolation [Hz / unit]
  FrequencyDifferences result_;
};

}  // namespace

DesignInPose perturb_design(const ManipulatorDesign& design, const solver::Pose& pose,
                            const DesignParameter& parameter, double change) {
  DesignInPose changed{design, pose};
  ManipulatorDesign& result = changed.design;
  switch (parameter.kind) {
    case Kind::base_side:
      grow(result.geometry.base, design.geometry.base[0], change);
      break;
    case Kind::platform_side:
      grow(result.geometry.platform, Vector2d::Zero(), change);
      break;
    case Kind::platform_mass:
      result.platform.mass = solver::platform_mass(design).mass + change;
      break;
    case Kind::platform_inertia:
      result.platform.inertia = parameter_value(design, parameter) + change;
      break;
    case Kind::orientation:
      changed.pose.phi += change;
      break;
    default:
      visit_parameter(result, parameter, [change](double& x) { x += change; });
  }
  return changed;
}

double parameter_value(const ManipulatorDesign& design, const DesignParameter& parameter) {
  ManipulatorDesign copy = design;
  double largest = 0;
  switch (parameter.kind) {
    case Kind::base_side:
      return side(design.geometry.base);
    case Kind::platform_side:
      return side(design.geometry.platform);
    case Kind::platform_mass:
      return solver::platform_mass(design).mass;
    case Kind::platform_inertia: {
      if (design.platform.kind != solver::PlatformKind::rigid) return 0;
      const solver::PlatformMass mass = solver::platform_mass(design);
      return design.platform.inertia.value_or(mass.inertia + mass.mass * mass.center.squaredNorm());
    }
    case Kind::orientation:
      return 1;
    default:
      visit_parameter(copy, parameter, [&](double& x) { largest = std::max(largest, x); });
      return largest;
  }
}

FrequencyDifferences differentiate_frequencies(const ManipulatorDesign& design, const Pose& pose,
                                               const DesignParameter& parameter, Index count,
                                               double relative_step) {
  return Differences(design, pose, parameter, count).run(relative_step);
}

FrequencyDifferences difference_quotient(const ManipulatorDesign& design, const Pose& pose,
                                         const DesignParameter& parameter, Index count,
                                         double relative_step, bool central) {
  return Differences(design, pose, parameter, count).single_quotient(relative_step, central);
}

}  // namespace trammel::harness
