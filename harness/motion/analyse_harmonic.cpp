#include "harness/motion/analyse_harmonic.h"

#include <algorithm>
#include <optional>

#include "harness/readers/option_reader.h"
#include "harness/scene/outputs.h"
#include "harness/statics_modes/range_warnings.h"
#include "harness/statics_modes/reduced_system.h"
#include "solver/linear/modes.h"

namespace trammel::harness {
namespace {

/// The steady response of one system, by outputs.
class Response {
 public:
  Response(const solver::System& system, const solver::HarmonicDamping& damping)
      : system_(system), response_(system, damping) {}

  [[nodiscard]] const solver::HarmonicSolver& of_system() const { return response_; }

  /// @returns the response; empty at a resonance without damping
  Eigen::VectorXcd record_at(double frequency, const std::vector<Output>& outputs,
                             Recorder& record) const {
    Eigen::VectorXcd q = response_.at(frequency);
    record.add("frequency_Hz", "", frequency);
    solver::HarmonicAmplitudes amplitudes;
    if (q.size() > 0) amplitudes = response_.amplitudes(q, frequency);
    for (const Output& output : outputs) {
      if (q.size() == 0) {
        record.add_gap(output.name, "");
      } else {
        record.add(output.name, "", amplitude_of(output, system_.model, amplitudes, frequency));
      }
    }
    return q;
  }

  void add_evidence(const Eigen::VectorXcd& q, double frequency, StepResult& result) const {
    if (q.size() == 0) return;
    result.evidence.add(solver::Residual::equilibrium, response_.backward_error(q, frequency));
    for (const Eigen::VectorXd& part : {Eigen::VectorXd(q.real()), Eigen::VectorXd(q.imag())})
      warn_of_rotation(largest_rotation(system_, system_.T * part), result.warnings);
  }

  /// A gap at a resonance that nothing bounds.
  /// @param resonances  natural frequencies within [low, high] [Hz]
  /// @param bounded  all of them
  /// @returns its frequency
  double record_peak(double low, double high, const std::vector<double>& resonances, bool bounded,
                     const Output& output, Recorder& record) const {
    for (const double resonance : resonances) {
      if (bounded || !is_pole(resonance, high, output)) continue;
      record.add_gap(output.prefixed("peak_"), "");
      record.add("peak_frequency_Hz", output.name, resonance);
      return resonance;
    }
    const solver::HarmonicPeak found = solver::harmonic_peak(
        response_, low, high, resonances, [&](const Eigen::VectorXcd& q, double frequency) {
          return amplitude(output, q, frequency);
        });
    record.add(output.prefixed("peak_"), "", found.amplitude);
    record.add("peak_frequency_Hz", output.name, found.frequency);
    return found.frequency;
  }

  /// The shape in phase with the load and a quarter of a turn behind it, at a frequency.
  void draw_at(double frequency, Drawing& drawing) const {
    const Eigen::VectorXcd q = response_.at(frequency);
    if (q.size() == 0) return;
    char text[64];
    std::snprintf(text, sizeof text, "%.4g Hz, ", frequency);
    drawing.shapes.push_back(
        draw_shape(system_, q.real(), std::string(text) + "in phase with the loads"));
    drawing.shapes.push_back(
        draw_shape(system_, -q.imag(), std::string(text) + "a quarter turn behind"));
  }

 private:
  /// Whether the amplitude grows as 1 / distance on the way to a frequency.
  [[nodiscard]] bool is_pole(double frequency, double high, const Output& output) const {
    const double unit = frequency > 0 ? frequency : high;
    const auto size_at = [&](double distance) {
      const double near = frequency + distance * unit;
      const Eigen::VectorXcd q = response_.at(near);
      return q.size() == 0 ? 0.0 : amplitude(output, q, near);
    };
    return size_at(1e-6) > 10 * size_at(1e-4);
  }

  [[nodiscard]] double amplitude(const Output& output, const Eigen::VectorXcd& q,
                                 double frequency) const {
    return amplitude_of(output, system_.model, response_.amplitudes(q, frequency), frequency);
  }

  const solver::System& system_;
  solver::HarmonicSolver response_;
};

/// How many frequencies.
std::size_t points_of(const JsonView& analysis) {
  return static_cast<std::size_t>(analysis.get<solver::Index>("points", 101));
}

/// The case's system and its response.
class HarmonicScene {
 public:
  HarmonicScene(const JsonView& analysis, const CaseModel& case_model, std::size_t step)
      : low_(analysis.number("from_Hz")),
        high_(analysis.number("to_Hz")),
        points_(points_of(analysis)),
        damped_(case_model.effects.has(solver::Effect::damping) && analysis.has("damping")) {
    if (case_model.path) throw analysis.error("expected a model at one place");
    if (!(high_ > low_)) throw analysis["to_Hz"].error("expected more than 'from_Hz'");
    ReducedSystem reduced = reduced_system(
        analysis, solver::assemble(build_model(case_model, step), case_model.effects),
        Weight::left_out);
    system = std::move(reduced.system);
    outcome_ = reduced.outcome;
    outputs = read_outputs(analysis["outputs"], system.model);
    try {
      const auto damping = damped_ ? read_damping(analysis) : solver::HarmonicDamping();
      response.emplace(system, damping);
      bounded_ = damping.rayleigh.mass != 0 || damping.rayleigh.stiffness != 0;
    } catch (const solver::ModelError& error) {
      throw(analysis.has("damping") ? analysis["damping"] : analysis).error(error.what());
    }
  }

  [[nodiscard]] StepResult result() const {
    return {outcome_.solved() ? response->of_system().outcome() : outcome_, {}, std::nullopt};
  }

  void record_at(std::size_t point, bool with_evidence, Recorder& record,
                 StepResult& result) const {
    const double share = static_cast<double>(point) / static_cast<double>(points_ - 1);
    const double frequency = low_ + (high_ - low_) * share;
    const Eigen::VectorXcd q = response->record_at(frequency, outputs, record);
    if (with_evidence) response->add_evidence(q, frequency, result);
    if (damped_) result.counters.count(solver::Effect::damping, 1);
  }

  /// Of every output.
  /// @returns the frequency of the first
  double record_peaks(Recorder& record, std::vector<Warning>& warnings) const {
    if (outputs.empty()) return low_;
    std::optional<double> first;
    std::optional<std::vector<double>> resonances = frequencies_in_range();
    if (!resonances) {
      add_warning(warnings, {"the number of natural frequencies found in the range", 0, "",
                             "a narrow peak between two of 65 frequencies may have been missed"});
      const Eigen::VectorXd damped = response->of_system().frequencies();
      resonances.emplace(damped.begin(), damped.end());
    }
    for (const Output& output : outputs) {
      const double at = response->record_peak(low_, high_, *resonances, bounded_, output, record);
      if (!first) first = at;
    }
    return first.value_or(low_);
  }

  /// Natural frequencies within the range [Hz]; nothing where they are not found.
  [[nodiscard]] std::optional<std::vector<double>> frequencies_in_range() const {
    // Where the end of the range is one of them to the last digits, a little beyond it.
    for (const double beyond : {1e-9, 1e-6}) {
      const auto count = solver::sturm_count(system, high_ * (1 + beyond));
      if (!count) continue;
      if (*count == 0) return std::vector<double>();
      const solver::ModalSolution modes = solver::solve_modes(system, {.count = *count});
      if (!modes.outcome.solved()) return std::nullopt;
      std::vector<double> found;
      for (const double frequency : modes.frequency)
        if (frequency >= low_ && frequency <= high_) found.push_back(frequency);
      return found;
    }
    return std::nullopt;
  }

  solver::System system;
  std::vector<Output> outputs;
  std::optional<Response> response;

 private:
  double low_, high_;
  std::size_t points_;
  bool damped_;
  bool bounded_ = false;  ///< every resonance, by Rayleigh damping
  solver::Outcome outcome_;
};

}  // namespace

std::set<std::size_t> harmonic_sample(const JsonView& analysis, const CaseModel& case_model) {
  constexpr std::size_t kStride = 4;
  const HarmonicScene scene(analysis, case_model, 0);
  const double low = analysis.number("from_Hz"), high = analysis.number("to_Hz");
  const std::size_t points = points_of(analysis);
  const std::optional<std::vector<double>> frequencies = scene.frequencies_in_range();
  std::set<std::size_t> sample = {points - 1};
  for (std::size_t i = 0; i < points; i += frequencies ? kStride : 1) sample.insert(i);
  for (const double frequency : frequencies.value_or(std::vector<double>())) {
    const double share = (frequency - low) / (high - low) * static_cast<double>(points - 1);
    const auto before = static_cast<std::size_t>(share);
    sample.insert({before, std::min(before + 1, points - 1)});
  }
  return sample;
}

StepResult analyse_harmonic_at(const JsonView& analysis, const CaseModel& case_model,
                               const std::vector<std::size_t>& points, Recorder& record) {
  const HarmonicScene scene(analysis, case_model, 0);
  StepResult result = scene.result();
  if (!result.outcome.solved()) return result;
  for (const std::size_t point : points)
    scene.record_at(point, point == points.front(), record, result);
  result.counters += scene.response->of_system().counters();
  return result;
}

StepResult analyse_harmonic(const JsonView& analysis, const CaseModel& case_model, std::size_t step,
                            bool draw, Recorder& record) {
  const HarmonicScene scene(analysis, case_model, step);
  const Response& response = *scene.response;
  StepResult result = scene.result();
  if (draw) result.drawing = draw_model(scene.system, case_model.manipulator.has_value());
  if (!result.outcome.solved()) return result;
  const std::size_t points = points_of(analysis);
  for (std::size_t point = 0; point < points; ++point) scene.record_at(point, true, record, result);
  if (needs_forces(scene.outputs)) warn_of_redundancy(scene.system, result.warnings);
  const double at = scene.record_peaks(record, result.warnings);
  if (result.drawing && !scene.outputs.empty()) response.draw_at(at, *result.drawing);
  for (const double frequency : response.of_system().frequencies())
    record.add("natural_frequency_Hz", "", frequency);
  record.add("degrees_of_freedom", "", static_cast<double>(scene.system.K.rows()));
  result.counters += response.of_system().counters();
  return result;
}

}  // namespace trammel::harness
