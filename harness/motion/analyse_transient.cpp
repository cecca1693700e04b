#include "harness/motion/analyse_transient.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "harness/motion/motion_history.h"
#include "harness/scene/outputs.h"
#include "harness/statics_modes/range_warnings.h"
#include "harness/statics_modes/reduced_system.h"
#include "solver/model/numbers.h"
#include "solver/motion/modal_superposition.h"

namespace trammel::harness {
namespace {

/// Displacements, velocities and, where an output asks for them, section forces of a sample.
MovingState state_of(const solver::System& system, const MotionHistory& motion,
                     const std::optional<solver::LateStrain>& late, solver::Index sample,
                     bool with_forces) {
  MovingState state;
  state.displacement = solver::node_motion(system, motion.q.col(sample));
  state.velocity = solver::node_motion(system, motion.v.col(sample));
  state.acceleration = solver::node_motion(system, motion.a.col(sample));
  if (!with_forces) return state;
  solver::ElasticState elastic;
  const Eigen::VectorXd v = motion.v.col(sample);
  elastic.u = system.T * (motion.q.col(sample) + motion.damping.rayleigh.stiffness * v);
  elastic.acceleration =
      system.T * (motion.a.col(sample) + damping_acceleration(motion.damping, system.M, v));
  elastic.load_factor = motion.load_factor[solver::to_size(sample)];
  elastic.constraint_forces = constraint_forces(system, elastic);  // which damping bears upon, too
  elastic.u = system.T * motion.q.col(sample);
  if (late) late->put(motion.q.col(sample), motion.followed_factor.col(sample), elastic);
  postprocess(system, elastic, state.forces);
  return state;
}

/// Of free vibration: how far the energy goes from where it started, over the largest kinetic one.
class EnergyDrift {
 public:
  void look(double kinetic, double strain) {
    const double total = kinetic + strain;
    if (start_ < 0) start_ = total;
    drift_ = std::max(drift_, std::abs(total - start_));
    max_kinetic_ = std::max(max_kinetic_, kinetic);
  }
  void record(Recorder& record) const {
    if (max_kinetic_ > 0) record.add("energy_drift", "", drift_ / max_kinetic_);
  }

 private:
  double start_ = -1, drift_ = 0, max_kinetic_ = 0;
};

void record_energy(const solver::System& system, const MotionHistory& motion, solver::Index sample,
                   EnergyDrift& drift, Recorder& record) {
  const Eigen::VectorXd q = motion.q.col(sample);
  const Eigen::VectorXd v = motion.v.col(sample);
  const double kinetic = 0.5 * v.dot(system.M * v), strain = 0.5 * q.dot(system.K * q);
  record.add("kinetic_energy_J", "", kinetic);
  record.add("strain_energy_J", "", strain);
  record.add("total_energy_J", "", kinetic + strain);
  drift.look(kinetic, strain);
}

void record_peaks(const MotionHistory& motion, const std::vector<Output>& outputs,
                  const Eigen::MatrixXd& values, Recorder& record) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const solver::Peak found =
        solver::peak(motion.time, values.row(static_cast<solver::Index>(i)).transpose());
    record.add(outputs[i].prefixed("peak_"), "", found.value);
    record.add("peak_time_s", outputs[i].name, found.time);
  }
}

/// A hundredth of the initial velocity is noticed in no plot of the motion.
void warn_of_basis(double missing, std::vector<Warning>& warnings) {
  constexpr double kNoticed = 0.01;
  if (!(missing > kNoticed)) return;
  add_warning(warnings,
              {"the part of the initial velocity outside the reduced basis", missing, "",
               "relative to the initial velocity, in the norm of kinetic energy; a larger "
               "'reduction' represents more of it"});
}

void draw_motion(const solver::System& system, const MotionHistory& motion, Drawing& drawing) {
  std::vector<Eigen::VectorXd> q;
  for (solver::Index i = 0; i < motion.q.cols(); ++i) q.emplace_back(motion.q.col(i));
  for (const std::size_t i : drawn_samples(q, drawing.nodes.size())) {
    const std::string label = moment_label(motion.time[i]);
    drawing.poses.push_back(
        {label, drawing.nodes, motion.time[i], draw_shape(system, q[i], label).displacement});
  }
}

}  // namespace

StepResult analyse_transient(const JsonView& analysis, const CaseModel& case_model,
                             std::size_t step, bool draw, Recorder& record) {
  if (case_model.path) throw analysis.error("expected a model at one place");
  if (analysis.has("reduction") && analysis.has("rotating_frame"))
    throw analysis["reduction"].error("expected it without 'rotating_frame'");
  solver::System assembled = solver::assemble(build_model(case_model, step), case_model.effects);
  std::optional<solver::System> full;
  if (analysis.has("reduction")) full = assembled;
  const auto [outcome, system] = reduced_system(analysis, std::move(assembled));
  if (!outcome.solved()) return {outcome, system.counters, std::nullopt};
  const std::vector<Output> outputs = read_outputs(analysis["outputs"], system.model);
  const bool with_forces = needs_forces(outputs);
  if (with_forces && analysis.has("rotating_frame")) {
    throw analysis["outputs"].error(
        "expected motions alone beside 'rotating_frame': what the frame does to the inside of "
        "members is not recovered");
  }
  const MotionHistory motion = compute_motion(analysis, system, case_model.effects);
  StepResult result{motion.outcome, motion.counters, std::nullopt, {}, motion.evidence};
  if (draw) result.drawing = draw_model(system, case_model.manipulator.has_value());
  if (!result.outcome.solved()) {
    if (analysis.has("reduction"))
      result.outcome.reason += "; component modes may be too few for the loads within members";
    return result;
  }
  if (with_forces) warn_of_redundancy(system, result.warnings);
  warn_of_taper(system.model, result.warnings);
  if (full) warn_of_basis(unrepresented_velocity(analysis, *full, system), result.warnings);
  Eigen::MatrixXd values(std::ssize(outputs), std::ssize(motion.time));
  EnergyDrift drift;
  std::optional<solver::LateStrain> late;
  if (with_forces && motion.followed_factor.size() > 0) late.emplace(system);
  for (solver::Index sample = 0; sample < values.cols(); ++sample) {
    const MovingState state = state_of(system, motion, late, sample, with_forces);
    record.add("time_s", "", motion.time[solver::to_size(sample)]);
    for (solver::Index i = 0; i < values.rows(); ++i) {
      const Output& output = outputs[solver::to_size(i)];
      values(i, sample) = value_of(output, system.model, state);
      record.add(output.name, "", values(i, sample));
    }
    record_energy(system, motion, sample, drift, record);
    warn_of_rotation(largest_rotation(system, system.T * motion.q.col(sample)), result.warnings);
  }
  record_peaks(motion, outputs, values, record);
  if (system.load.isZero(0) && !analysis.has("rotating_frame")) drift.record(record);
  record.add("steps", "", static_cast<double>(motion.steps));
  record.add("degrees_of_freedom", "", static_cast<double>(system.K.rows()));
  if (result.drawing) draw_motion(system, motion, *result.drawing);
  return result;
}

}  // namespace trammel::harness
