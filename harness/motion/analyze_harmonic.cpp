#include <fmt/format.h>

#include <numbers>
#include <optional>
#include <utility>

#include "harness/motion/analyses.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/observables.h"
#include "harness/statics_modes/range_warnings.h"
#include "harness/statics_modes/reduced_system.h"
#include "solver/linear/modes.h"

namespace trammel::harness {
namespace {

/// System of equations of a case, and its steady response to harmonic loads.
class HarmonicScene {
 public:
  HarmonicScene(const JsonView& analysis, const CaseModel& case_model, std::size_t step)
      : low(analysis.number("from_Hz")),
        high(analysis.number("to_Hz")),
        points(static_cast<std::size_t>(analysis.get<solver::Index>("points", 101))),
        damped_(case_model.effects.has(solver::Effect::damping) && analysis.has("damping")) {
    if (case_model.path) throw analysis.error("this analysis requires 'pose' (got 'trajectory')");
    if (!(high > low)) throw analysis["to_Hz"].error("expected a frequency above 'from_Hz'");
    ReducedSystem reduced = reduced_system(
        analysis, solver::assemble(build_model(case_model, step), case_model.effects),
        Weight::left_out);
    system = std::move(reduced.system);
    outputs = read_outputs(analysis["outputs"], system.model);
    try {
      const auto damping = damped_ ? read_damping(analysis) : solver::HarmonicDamping();
      response.emplace(system, damping);
      bounded_ = damping.rayleigh.mass != 0 || damping.rayleigh.stiffness != 0;
    } catch (const solver::ModelError& error) {
      throw(analysis.has("damping") ? analysis["damping"] : analysis).error(error.what());
    }
    outcome = reduced.outcome.solved() ? response->outcome() : reduced.outcome;
  }

  /// Records the response at one frequency. At a resonance without damping, records a missing
  /// number.
  void record_at(std::size_t point, Recorder& record, StepResult& result) const {
    const double share = static_cast<double>(point) / static_cast<double>(points - 1);
    const double frequency = low + (high - low) * share;
    const Eigen::VectorXcd q = response->at(frequency);
    record.add("frequency_Hz", frequency);
    const ModelState amplitudes = q.size() > 0 ? amplitudes_of(q, frequency) : ModelState();
    for (const Output& output : outputs) {
      if (q.size() == 0) {
        record.add_missing_value(output.name, "");
      } else {
        record.add(output.name, output.value(system.model, amplitudes));
      }
    }
    if (damped_) result.counters.add(solver::Effect::damping, 1);
    if (q.size() == 0) return;
    result.evidence.add(solver::Residual::equilibrium, response->backward_error(q, frequency));
    for (const Eigen::VectorXd& part : {Eigen::VectorXd(q.real()), Eigen::VectorXd(q.imag())})
      warn_of_rotation(largest_rotation(system, system.T * part), result.warnings);
  }

  /// Records the peak of every output.
  /// @returns the frequency of the first peak
  double record_peaks(Recorder& record, std::vector<Warning>& warnings) const {
    if (outputs.empty()) return low;
    std::optional<std::vector<double>> resonances = frequencies_in_range();
    if (!resonances) {
      add_warning(warnings, {"the number of natural frequencies found in the range", 0, "",
                             "a narrow peak between two of 65 sampled frequencies may be missed"});
      const Eigen::VectorXd damped = response->damped_mode_frequencies();
      resonances.emplace(damped.begin(), damped.end());
    }
    std::vector<double> peaks;
    for (const Output& output : outputs) peaks.push_back(record_peak(*resonances, output, record));
    return peaks.front();
  }

  /// Returns the natural frequencies within the range [Hz]; empty if the eigensolver fails.
  [[nodiscard]] std::optional<std::vector<double>> frequencies_in_range() const {
    // If the upper end of the range is a natural frequency up to round-off, the frequencies are
    // counted in a slightly larger range.
    for (const double beyond : {1e-9, 1e-6}) {
      const auto count = solver::sturm_count(system, high * (1 + beyond));
      if (!count) continue;
      if (*count == 0) return std::vector<double>();
      const solver::ModalSolution modes = solver::solve_modes(system, {.count = *count});
      if (!modes.outcome.solved()) return std::nullopt;
      std::vector<double> found;
      for (const double frequency : modes.frequency)
        if (frequency >= low && frequency <= high) found.push_back(frequency);
      return found;
    }
    return std::nullopt;
  }

  /// Draws the deformation at one frequency: in phase with the loads, and a quarter period later.
  void draw_at(double frequency, Drawing& drawing) const {
    const Eigen::VectorXcd q = response->at(frequency);
    if (q.size() == 0) return;
    const std::string label = fmt::format("{:.4g} Hz, ", frequency);
    drawing.shapes.push_back(draw_shape(system, q.real(), label + "in phase with the loads"));
    drawing.shapes.push_back(draw_shape(system, -q.imag(), label + "a quarter period later"));
  }

  double low, high;  ///< limits of the frequency range [Hz]
  std::size_t points;
  solver::System system;
  std::vector<Output> outputs;
  std::optional<solver::HarmonicSolver> response;
  solver::Outcome outcome;

 private:
  /// Records the peak of an output, or a missing number at an unbounded resonance.
  /// @param resonances  natural frequencies within the range [Hz]
  /// @returns the frequency of the peak
  double record_peak(const std::vector<double>& resonances, const Output& output,
                     Recorder& record) const {
    for (const double resonance : resonances) {
      if (bounded_ || !is_pole(resonance, output)) continue;
      record.add_missing_value("peak_" + output.name, "");
      record.add("peak_frequency_Hz", output.name, resonance);
      return resonance;
    }
    const solver::HarmonicPeak found = solver::harmonic_peak(
        *response, low, high, resonances, [&](const Eigen::VectorXcd& q, double frequency) {
          return output.value(system.model, amplitudes_of(q, frequency));
        });
    record.add("peak_" + output.name, found.amplitude);
    record.add("peak_frequency_Hz", output.name, found.frequency);
    return found.frequency;
  }

  /// Returns true if the amplitude of the output is unbounded at a natural frequency. Near such a
  /// frequency f0, the amplitude at a frequency f is proportional to 1 / |f - f0|.
  [[nodiscard]] bool is_pole(double frequency, const Output& output) const {
    const double unit = frequency > 0 ? frequency : high;
    const auto size_at = [&](double distance) {
      const double near = frequency + distance * unit;
      const Eigen::VectorXcd q = response->at(near);
      return q.size() == 0 ? 0.0 : output.value(system.model, amplitudes_of(q, near));
    };
    return size_at(1e-6) > 10 * size_at(1e-4);
  }

  [[nodiscard]] ModelState amplitudes_of(const Eigen::VectorXcd& q, double frequency) const {
    const double omega = 2 * std::numbers::pi * frequency;
    solver::HarmonicAmplitudes found = response->amplitudes(q, frequency);
    ModelState state;
    state.velocity = omega * found.displacement;
    state.acceleration = omega * omega * found.displacement;
    state.displacement = std::move(found.displacement);
    state.resultant_start = std::move(found.resultant_start);
    state.resultant_end = std::move(found.resultant_end);
    state.member_stress = std::move(found.member_stress);
    return state;
  }

  bool damped_;
  bool bounded_ = false;  ///< true: Rayleigh damping limits the amplitude at each resonance
};

}  // namespace

StepResult analyze_harmonic(const JsonView& analysis, const CaseModel& case_model, std::size_t step,
                            bool draw, Recorder& record) {
  const HarmonicScene scene(analysis, case_model, step);
  StepResult result{scene.outcome, {}};
  if (draw) result.drawing = draw_model(scene.system, case_model.manipulator.has_value());
  if (!result.outcome.solved()) return result;
  for (std::size_t point = 0; point < scene.points; ++point) scene.record_at(point, record, result);
  if (needs_forces(scene.outputs)) warn_of_redundant_constraints(scene.system, result.warnings);
  const double peak = scene.record_peaks(record, result.warnings);
  if (result.drawing && !scene.outputs.empty()) scene.draw_at(peak, *result.drawing);
  for (const double frequency : scene.response->damped_mode_frequencies())
    record.add("natural_frequency_Hz", frequency);
  record.add("degrees_of_freedom", scene.system.K.rows());
  result.counters += scene.response->counters();
  return result;
}

}  // namespace trammel::harness
