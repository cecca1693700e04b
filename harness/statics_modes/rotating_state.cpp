#include "harness/statics_modes/rotating_state.h"

#include <algorithm>
#include <complex>

#include "harness/readers/field_reader.h"
#include "harness/readers/option_reader.h"

namespace trammel::harness {
namespace {

solver::RotationAxis read_axis(const JsonView& rotating) {
  const std::string axis = rotating.get<std::string>("axis", "normal");
  if (axis == "x") return solver::RotationAxis::x;
  return axis == "y" ? solver::RotationAxis::y : solver::RotationAxis::normal;
}

/// A moment of the motion at which its largest part is at its largest.
Eigen::VectorXd snapshot(const Eigen::VectorXcd& shape) {
  solver::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> turn = std::conj(shape[largest]) / std::abs(shape[largest]);
  return (turn * shape).real();
}

void record_state(const solver::System& system, const solver::RotatingModes& modes,
                  Recorder& record) {
  const Eigen::MatrixX3d motion = solver::node_motion(system, modes.q);
  for (std::size_t i = 0; i < system.model.nodes.size(); ++i) {
    const std::string& name = system.model.nodes[i].name;
    if (name.empty()) continue;
    record.add("steady_displacement_x_m", name, motion(static_cast<solver::Index>(i), 0));
    record.add("steady_displacement_y_m", name, motion(static_cast<solver::Index>(i), 1));
  }
}

}  // namespace

void record_frequencies(const Eigen::VectorXd& frequency, const Eigen::VectorXd& growth_rate,
                        bool several, Recorder& record, const Eigen::VectorXd& roundoff) {
  for (solver::Index i = 0; i < frequency.size(); ++i) {
    const std::string item = several ? std::to_string(i + 1) : "";
    record.add("frequency_Hz", item, frequency[i], roundoff.size() > 0 ? roundoff[i] : -1);
    record.add("growth_rate_per_s", item, growth_rate[i]);
  }
}

solver::RotatingOptions read_rotating_options(const JsonView& modes) {
  const JsonView rotating = modes["rotating"];
  solver::RotatingOptions options;
  options.count = modes["count"].get<solver::Index>();
  options.method = read_eigen_method(modes);
  options.frame.axis = read_axis(rotating);
  if (rotating.has("center_m")) options.frame.centre = read_point(rotating["center_m"]);
  options.prestress_at_steady_state =
      rotating.get<std::string>("prestress_configuration", "deformed") == "deformed";
  return options;
}

std::vector<double> read_speeds(const JsonView& modes) {
  const Json& stated = modes["rotating"]["angular_speed_rad_s"].json();
  if (stated.is_array()) return stated.get<std::vector<double>>();
  return {stated.get<double>()};
}

StepResult analyse_rotating(const JsonView& modes, const solver::System& system,
                            solver::Effects effects, bool draw, Recorder& record) {
  const bool several = modes["rotating"]["angular_speed_rad_s"].json().is_array();
  const std::vector<double> speeds = read_speeds(modes);
  solver::RotatingOptions options = read_rotating_options(modes);
  options.gyroscopic = effects.has(solver::Effect::gyroscopic);
  options.stiffening = effects.has(solver::Effect::geometric_stiffening);
  StepResult result{{}, system.counters, std::nullopt};
  if (draw) result.drawing = draw_model(system, false);
  for (const double speed : speeds) {
    options.frame.speed = speed;
    const solver::RotatingModes found = solver::solve_rotating_modes(system, options);
    solver::Counters step_counters = found.counters;  // which begin with the system's
    step_counters.element_evaluations = 0;
    for (std::size_t i = 0; i < solver::kEffectCount; ++i)
      step_counters.effects[i] -= system.counters.effects[i];
    result.counters += step_counters;
    result.outcome = found.outcome;
    result.evidence.add(found.evidence);
    if (!found.outcome.solved()) return result;
    record.add("angular_speed_rad_s", "", speed);
    record_frequencies(found.frequency, found.growth_rate, several, record);
    record.add("stable", "", found.stable ? 1 : 0);
    record_state(system, found, record);
    if (!result.drawing || several) continue;
    for (solver::Index i = 0; i < std::min(found.frequency.size(), kMaxDrawnShapes); ++i) {
      result.drawing->shapes.push_back(draw_shape(system, snapshot(found.shape.col(i)),
                                                  mode_label(i, found.frequency[i], "Hz")));
    }
  }
  record.add("degrees_of_freedom", "", static_cast<double>(system.K.rows()));
  return result;
}

}  // namespace trammel::harness
