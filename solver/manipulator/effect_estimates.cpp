#include "solver/manipulator/effect_estimates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "solver/linear/element_operators.h"
#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/modes.h"
#include "solver/linear/statics.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/moving_element.h"
#include "solver/manipulator/moving_system.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

constexpr std::size_t kPathSamples = 12;
constexpr Index kModesFromRest = 16, kModesBesidePath = 4;
constexpr Index kElements = 8;
/// (W / w1)^2 of a path whose harmonics come near no resonance.
constexpr double kSlow = 0.1;
constexpr std::array kFlexibilities = {Effect::axial_flexibility, Effect::shear,
                                       Effect::platform_flexibility, Effect::joint_compliance};
/// A part of an energy that is found as a difference and may be rounding.
constexpr double kRounding = 1e-12;

/// The whole motion, on a mesh that is good enough to decide by.
ElastodynamicsOptions coarsened(ElastodynamicsOptions options) {
  options.elastic_inertia = options.gyroscopic = true;
  for (std::size_t i = 0; i < 3; ++i) {
    for (LinkDesign* link : {&options.design.proximal[i], &options.design.distal[i]}) {
      link->elements = std::min(link->elements, kElements);
    }
  }
  return options;
}

/// How fast the path turns [rad/s].
double path_rate(const ElastodynamicsOptions& options) {
  constexpr int kSamples = 64;
  double velocity = 0, acceleration = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double share = static_cast<double>(i) / kSamples;
    const double time = options.time.start + share * (options.time.end - options.time.start);
    const TrajectoryPoint point = at(options.path, time);
    velocity = std::max(velocity, point.velocity.norm());
    acceleration = std::max(acceleration, point.acceleration.norm());
  }
  return velocity > 0 ? acceleration / velocity : 0;
}

/// A response to a load, by its largest translation [m] and by its energy, which stands for forces.
struct ResponseSize {
  double translation = 0, energy = 0;

  void take_max(const ResponseSize& other) {
    translation = std::max(translation, other.translation);
    energy = std::max(energy, other.energy);
  }
};

/// One mode, as far as it vibrates.
struct Vibration {
  double translation = 0;           ///< amplitude over the largest of the response
  double energy = 0;                ///< the same in the norm of K
  std::map<Effect, double> change;  ///< what it loses, relative, or loses step by [rad]
  double frequency = 0;             ///< [rad/s]
  double damping_ratio = 0;
  /// In resonance with the path: the mean age of the vibration over how long one lasts; else 0.
  double resonant_share = 0;
};

class MotionEstimates {
 public:
  MotionEstimates(const ElastodynamicsOptions& options, Effects applicable)
      : options_(coarsened(options)),
        applicable_(applicable),
        rate_(path_rate(options)),
        duration_(options.time.end - options.time.start) {}

  EffectEstimates run() {
    std::vector<double> times = estimate_along_path();
    times.push_back((options_.time.start + options_.time.end) / 2);
    for (std::size_t i = 0; i < times.size() && solved(); ++i) estimate_at(times[i], i == 0);
    if (solved() && frequency_ <= 0) {
      estimates_.outcome = {Status::singular, "nothing vibrates"};
    }
    if (solved()) collect_estimates();
    return std::move(estimates_);
  }

 private:
  [[nodiscard]] bool solved() const { return estimates_.outcome.solved(); }

  [[nodiscard]] static double translation_of(const MovingSystem& system, const VectorXd& q) {
    const VectorXd u = system.constraints().T * q;
    double largest = 0;
    for (const auto& node : system.start().coordinates.node) {
      largest = std::max(largest, std::hypot(u[node[0]], u[node[1]]));
    }
    return largest;
  }
  [[nodiscard]] static ResponseSize size_of(const MovingSystem& system, const VectorXd& q) {
    return {translation_of(system, q), std::sqrt(std::max(0.0, q.dot(system.K() * q)))};
  }

  void record_change(Effect effect, const ResponseSize& change) {
    if (applicable_.has(effect)) change_[effect].take_max(change);
  }

  /// K q = F + f; empty where it has no solution.
  VectorXd quasi_static_response(PathFollower& pose, double time, const Vector2d& gravity) {
    estimates_.outcome = pose.move_to(time, gravity);
    if (!solved()) return {};
    max_angular_velocity_ =
        std::max(max_angular_velocity_, largest_angular_velocity(pose.system().motion()));
    VectorXd q;
    if (!pose.solve_statically(pose.load(), q)) {
      estimates_.outcome = {Status::singular, "the stiffness is singular"};
    }
    return q;
  }

  /// What goes with rates, at samples of some spread over the path.
  /// @returns those at which the quasi-static response is largest
  std::vector<double> estimate_along_path() {
    PathFollower pose(options_, options_.time.start);
    ResponseSize largest;
    double farthest = options_.time.start, hardest = farthest;
    const std::vector<double>& samples = options_.time.sample_times;
    const std::size_t stride = (samples.size() + kPathSamples - 1) / kPathSamples;
    for (std::size_t i = 0; i < samples.size(); i += stride) {
      const double time = samples[i];
      const ResponseSize size = estimate_rates_at(pose, time);
      if (!solved()) return {};
      if (size.translation > largest.translation) farthest = time;
      if (size.energy > largest.energy) hardest = time;
      largest.take_max(size);
    }
    estimates_.counters += pose.counters();
    const std::set<double> extremes = {farthest, hardest};
    return estimates_.extreme_times = {extremes.begin(), extremes.end()};
  }

  /// Inertia, damping and gyroscopic forces; at an end of the path, within it.
  /// @returns the size of the response
  ResponseSize estimate_rates_at(PathFollower& pose, double sample) {
    const double step = rate_ > 0 ? std::min(1e-3 / rate_, duration_ / 4) : 1e-4 * duration_;
    const auto [first, last] = time_span(options_.path);
    const double time = std::clamp(sample, first + step, last - step);
    std::array<VectorXd, 3> q;  // before, after, now
    for (std::size_t i = 0; i < 3; ++i) {
      const double offset = std::array{-1.0, 1.0, 0.0}[i];
      q[i] = quasi_static_response(pose, time + offset * step, options_.gravity);
      if (!solved()) return {};
    }
    const VectorXd v = (q[1] - q[0]) / (2 * step);
    const VectorXd a = (q[1] - 2 * q[2] + q[0]) / (step * step);
    const MovingSystem& system = pose.system();
    const VectorXd inertia = system.M() * a;
    const VectorXd damping =
        options_.damping.mass * (system.M() * v) + options_.damping.stiffness * (system.K() * v);
    const VectorXd drag = solve(pose, damping), lag = solve(pose, inertia);
    // The same loads hold what drags: only displacements change.
    record_change(Effect::damping, {translation_of(system, drag), 0});
    record_change(Effect::inertia,
                  {translation_of(system, drag + lag), size_of(system, lag).energy});
    record_change(Effect::gyroscopic,
                  size_of(system, solve(pose, system.gyroscopic_matrix() * v +
                                                  system.centrifugal_and_euler_matrix() * q[2])));
    const ResponseSize size = size_of(system, q[2]);
    response_.take_max(size);
    return size;
  }

  /// At a pose where a load has just been solved for.
  [[nodiscard]] static VectorXd solve(PathFollower& pose, const VectorXd& load) {
    VectorXd x;
    static_cast<void>(pose.solve_statically(load, x));
    return x;
  }

  /// What the loads of one pose say: flexibilities, masses and weights.
  void estimate_at(double time, bool with_modes) {
    PathFollower pose(options_, time);
    const VectorXd q = quasi_static_response(pose, time, options_.gravity);
    if (!solved()) return;
    const MovingSystem& system = pose.system();
    const ResponseSize total = size_of(system, q);
    response_.take_max(total);
    const double energy = q.dot(system.K() * q);
    const EnergyShares shares(system.start(), q, energy);
    for (const Effect effect : kFlexibilities) {
      const double share = energy > 0 ? shares.elastic(effect) : 0;
      share_[effect] = std::max(share_[effect], share);
      const VectorXd lost = solve(pose, system.start().T.transpose() * shares.forces(effect));
      record_change(effect, {translation_of(system, lost), share * total.energy});
    }
    const VectorXd load = pose.load();
    without_masses(time, load, pose);
    if (with_modes && solved()) {
      bound_large_displacement(system, q);
      estimate_vibration(system, q);
    }
    if (applicable_.has(Effect::gravity) && solved()) {
      estimates_.outcome = pose.move_to(time, Vector2d::Zero());
      if (!solved()) return;
      const ResponseSize weight = size_of(system, solve(pose, load - pose.load()));
      double& of_all = share_[Effect::gravity];
      if (total.energy > 0) of_all = std::max(of_all, weight.energy / total.energy);
      record_change(Effect::gravity, weight);
    }
    estimates_.counters += pose.counters();
  }

  /// The same model without masses of links, or the turning of their sections: other loads.
  void without_masses(double time, const VectorXd& load, PathFollower& pose) {
    for (const Effect effect : {Effect::link_mass, Effect::rotary_inertia}) {
      if (!applicable_.has(effect)) continue;
      ElastodynamicsOptions options = options_;
      options.design = restrict_effects(options.design, Effects::all().without(effect));
      PathFollower light(options, time);
      estimates_.outcome = light.move_to(time, options.gravity);
      if (!solved()) return;
      record_change(effect, size_of(pose.system(), solve(pose, load - light.load())));
    }
  }

  /// By the largest rotation, and by the largest compression or tension over the buckling load of
  /// a hinged link: a limb of two links with one free end buckles at a sixteenth of that.
  void bound_large_displacement(const MovingSystem& moving, const VectorXd& q) {
    constexpr double kOfRotation = 2, kOfBucklingLoad = 16;
    const System& system = moving.start();
    const VectorXd u = system.T * q;
    double rotation = 0, load = 0;
    for (Index i = 0; i < u.size(); ++i) {
      if (system.coordinates.is_rotation[to_size(i)]) rotation = std::max(rotation, std::abs(u[i]));
    }
    const VectorXd still = VectorXd::Zero(q.size());
    const MovingSystem::Forces forces = moving.forces(q, still, still, {}, true);
    const VectorXd axial = axial_forces(system, u, moving.constraints().multipliers(forces.total));
    for (std::size_t i = 0; i < system.mesh.frame.size(); ++i) {
      const FrameElement& e = system.mesh.frame[i];
      if (e.is_bar()) continue;
      const Member& member = system.model.members[to_size(e.member)];
      const double length = e.length * static_cast<double>(member.elements);
      const double force = axial[static_cast<Index>(i)];
      load = std::max(load, std::abs(force) * length * length /
                                (std::numbers::pi * std::numbers::pi * e.section.EI));
    }
    estimates_.large_displacement_bound = std::max(
        {estimates_.large_displacement_bound, kOfRotation * rotation, kOfBucklingLoad * load});
  }

  /// The first modes that are no rigid motions: all that vibrate where load and inertia set in at
  /// once, else those that may resonate; and what they lose step by without each effect.
  void estimate_vibration(const MovingSystem& moving, const VectorXd& response) {
    const System& system = moving.start();
    const bool from_rest = !options_.time.quasi_static_start;
    const ModalSolution modes =
        solve_modes(system, {.count = from_rest ? kModesFromRest : kModesBesidePath});
    estimates_.counters += modes.counters;
    estimates_.outcome = modes.outcome;
    if (!modes.outcome.solved()) return;
    Index first = 0;
    while (first < modes.frequency.size() && !(modes.frequency[first] > 0)) ++first;
    if (first == modes.frequency.size()) return;
    frequency_ = 2 * std::numbers::pi * modes.frequency[first];
    damping_ = damping_ratio(options_.damping, frequency_);
    const VectorXd load = moving.K() * response;
    const ResponseSize total = size_of(moving, response);
    double energy_left = total.energy > 0 ? 1 : 0;
    for (Index k = first; k < modes.frequency.size(); ++k) {
      const double omega = 2 * std::numbers::pi * modes.frequency[k];
      const VectorXd& shape = modes.shape.col(k);
      const double amplitude = std::abs(shape.dot(load)) / (omega * omega);
      Vibration one = vibration_without_effects(system, shape, omega);
      one.change[Effect::gyroscopic] = gyroscopic_coupling(moving, modes, first, k);
      if (from_rest && total.translation > 0 && total.energy > 0) {
        one.energy = amplitude * omega / total.energy;
        one.translation = amplitude * translation_of(moving, shape) / total.translation;
        energy_left -= one.energy * one.energy;
      }
      vibrations_.push_back(one);
    }
    if (from_rest && energy_left > kRounding) beyond_modes_ = std::sqrt(energy_left);
    const EnergyShares shares(system, modes.shape.col(first), frequency_ * frequency_);
    const double rotary = shares.kinetic(true);
    share_[Effect::link_mass] = shares.kinetic(false) - rotary;
    share_[Effect::rotary_inertia] = rotary;
  }

  /// How far a mode of unit modal mass is out of step at last without each effect [rad], and what
  /// damping takes of it.
  [[nodiscard]] Vibration vibration_without_effects(const System& system, const VectorXd& shape,
                                                    double omega) const {
    Vibration one;
    one.frequency = omega;
    const double ratio = one.damping_ratio = damping_ratio(options_.damping, omega);
    const double phase = vibration_duration(omega, ratio) * omega;
    const EnergyShares shares(system, shape, omega * omega);
    for (const Effect effect : kFlexibilities)
      one.change[effect] = phase * frequency_change_without(shares.elastic(effect));
    const double rotary = shares.kinetic(true), all = shares.kinetic(false);
    one.change[Effect::link_mass] = phase * frequency_change_without(all - rotary);
    one.change[Effect::rotary_inertia] = phase * frequency_change_without(rotary);
    one.change[Effect::damping] = -std::expm1(-ratio * omega * duration_);
    if (std::pow(rate_ / omega, 2) > kSlow) {
      const double age = ratio > 0 ? std::min(duration_ / 2, 1 / (ratio * omega)) : duration_ / 2;
      one.resonant_share = age / vibration_duration(omega, ratio);
    }
    return one;
  }

  /// By how much gyroscopic forces change a mode while it lasts, or turn it into another: the
  /// slower, the nearer their frequencies.
  [[nodiscard]] double gyroscopic_coupling(const MovingSystem& moving, const ModalSolution& modes,
                                           Index first, Index i) const {
    const auto omega = [&](Index k) { return 2 * std::numbers::pi * modes.frequency[k]; };
    const double time = vibration_duration(omega(i), damping_ratio(options_.damping, omega(i)));
    const VectorXd C = moving.gyroscopic_matrix().transpose() * modes.shape.col(i);
    const VectorXd S = moving.centrifugal_and_euler_matrix().transpose() * modes.shape.col(i);
    double coupling = 0;
    for (Index j = first; j < modes.shape.cols(); ++j) {
      const double rate =
          (std::abs(C.dot(modes.shape.col(j))) + std::abs(S.dot(modes.shape.col(j))) / omega(i)) /
          2;
      const double difference = std::abs(omega(i) - omega(j));
      coupling = std::max(coupling, rate * (difference * time > 1 ? 1 / difference : time));
    }
    return coupling;
  }

  /// Duration of a vibration.
  [[nodiscard]] double vibration_duration(double omega, double damping) const {
    return damping > 0 ? std::min(duration_, 1 / (std::numbers::e * damping * omega)) : duration_;
  }

  /// A change over the quasi-static response; nothing moves without a load.
  [[nodiscard]] ResponseSize relative_change(Effect effect) const {
    const auto found = change_.find(effect);
    if (found == change_.end() || !(response_.translation > 0 && response_.energy > 0)) return {};
    return {found->second.translation / response_.translation,
            found->second.energy / response_.energy};
  }

  /// A stiff part has a mode of its own beyond those looked at, in which the force it carries
  /// swings by itself, for half a period at least; from a start on q_s as far as the vibration goes
  /// and such a mode takes up its speed.
  /// @param share  of the part in the strain energy: (w1 / w)^2 of its mode
  [[nodiscard]] double stiff_part_vibration(double share, double vibration_share) const {
    const Vibration& last = vibrations_.back();
    const double decay = std::exp(-std::numbers::pi * last.damping_ratio);
    if (!options_.time.quasi_static_start) return decay;
    const double period = std::min(1 / last.frequency, std::sqrt(share) / frequency_);
    return decay * vibration_share * std::min(1.0, 2 * rate_ * period);
  }

  /// Translations of modes may add up; they are orthogonal in energy.
  [[nodiscard]] double vibration_change(Effect effect) const {
    double translation = 0, energy = std::pow(2 * beyond_modes_, 2), resonant = 0;
    for (const Vibration& one : vibrations_) {
      const auto found = one.change.find(effect);
      const double change = found == one.change.end() ? 0 : std::abs(found->second);
      const double bounded = std::min(2.0, change);
      translation += one.translation * bounded;
      energy += std::pow(one.energy * bounded, 2);
      resonant = std::max(resonant, std::min(2.0, one.resonant_share * change));
    }
    return std::max({translation, std::sqrt(energy), resonant});
  }

  /// What vibrations lose by step where the stiffness changes as much as the response does.
  [[nodiscard]] double stiffening_phase() const {
    double translation = 0, resonant = 0;
    for (const Vibration& one : vibrations_) {
      const double phase = vibration_duration(one.frequency, one.damping_ratio) * one.frequency / 2;
      translation += one.translation * phase;
      resonant = std::max(resonant, one.resonant_share * phase);
    }
    return std::max(translation, resonant);
  }

  void collect_estimates() {
    const double r = rate_ / frequency_;
    const double amplified = std::max(1.0, 1 / std::hypot(1 - r * r, 2 * damping_ * r));
    const bool resonates = r * r > kSlow;
    // A load that may be in resonance grows so far; what changes the frequency alone does not.
    const double lasts =
        damping_ > 0 ? std::min(duration_, 1 / (damping_ * frequency_)) : duration_;
    const double growth = resonates ? std::max(1.0, frequency_ * lasts / 2) : 1;
    // Half a period later what started on q_s is twice as far from the response beside it.
    const double from_start = 1 + std::exp(-std::numbers::pi * damping_);
    double vibration_share = 1;
    if (options_.time.quasi_static_start && !vibrations_.empty()) {
      vibration_share = std::min(1.0, relative_change(Effect::inertia).translation * amplified);
      vibrations_.front().translation = vibrations_.front().energy = vibration_share;
    }
    const double amplitude = amplified * (1 + vibration_share);
    estimates_.large_displacement_growth = amplitude * (1 + amplitude * stiffening_phase());
    // Damping resists in world axes what only turns with its link.
    estimates_.large_displacement_beside = 2 * options_.damping.stiffness * max_angular_velocity_;
    for (const Effect effect : applicable_.list()) {
      if (effect == Effect::large_displacement) continue;  // the caller can tell more of it
      const ResponseSize relative = relative_change(effect);
      double change = std::max(relative.translation, relative.energy) * amplified;
      double number = share_[effect];
      if (effect == Effect::gravity || effect == Effect::link_mass ||
          effect == Effect::rotary_inertia)
        change *= growth;
      if (effect == Effect::inertia) {
        number = r * r;
        change = growth * std::max(change * from_start, vibration_share);
      }
      if (effect == Effect::damping) {
        number = damping_;
        change *= from_start;
      }
      if (effect == Effect::gyroscopic) number = 2 * max_angular_velocity_ / frequency_;
      if (effect == Effect::axial_flexibility && applicable_.has(Effect::damping))
        change += options_.damping.stiffness * max_angular_velocity_;
      if (effect == Effect::platform_flexibility || effect == Effect::joint_compliance)
        change += stiff_part_vibration(number, vibration_share);
      if (effect != Effect::inertia && effect != Effect::gravity)
        change += vibration_change(effect);
      estimates_.effects.push_back({effect, number, change});
    }
  }

  ElastodynamicsOptions options_;
  Effects applicable_;
  double rate_;
  double duration_;
  // Largest over the poses.
  ResponseSize response_;
  std::map<Effect, ResponseSize> change_;
  std::map<Effect, double> share_;  // of the strain energy, or of that of all loads
  double frequency_ = 0, damping_ = 0, max_angular_velocity_ = 0;
  std::vector<Vibration> vibrations_;
  double beyond_modes_ = 0;  ///< of what vibrates from rest, by energy
  EffectEstimates estimates_;
};

}  // namespace

EffectEstimates estimate_motion_effects(const ElastodynamicsOptions& options, Effects applicable) {
  return MotionEstimates(options, applicable).run();
}

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
