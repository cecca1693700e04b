#include "harness/motion/analyse_harmonic.h"

#include "harness/readers/damping_reader.h"
#include "harness/scene/outputs.h"
#include "harness/statics_modes/range_warnings.h"

namespace trammel::harness {
namespace {

/// The steady response of one system, by outputs.
class Response {
 public:
  Response(const solver::System& system, const solver::HarmonicDamping& damping)
      : system_(system), response_(system, damping) {}

  [[nodiscard]] const solver::HarmonicSolver& of_system() const { return response_; }

  void record_at(double frequency, const std::vector<Output>& outputs, Recorder& record,
                 StepResult& result) const {
    const Eigen::VectorXcd q = response_.at(frequency);
    record.add("frequency_Hz", "", frequency);
    solver::HarmonicAmplitudes amplitudes;
    if (q.size() > 0) {
      amplitudes = solver::harmonic_amplitudes(system_, q, frequency);
      result.evidence.add(solver::Residual::equilibrium, response_.backward_error(q, frequency));
    }
    for (const Output& output : outputs) {
      if (q.size() == 0) {  // resonance without damping
        record.add_gap(output.name, "");
      } else {
        record.add(output.name, "", amplitude_of(output, system_.model, amplitudes, frequency));
      }
    }
    if (q.size() == 0) return;
    for (const Eigen::VectorXd& part : {Eigen::VectorXd(q.real()), Eigen::VectorXd(q.imag())})
      warn_of_rotation(largest_rotation(system_, system_.T * part), result.warnings);
  }

  /// @returns its frequency
  double record_peak(double low, double high, const Output& output, Recorder& record) const {
    const solver::HarmonicPeak found = solver::harmonic_peak(
        response_, low, high, [&](const Eigen::VectorXcd& q, double frequency) {
          return amplitude_of(output, system_.model,
                              solver::harmonic_amplitudes(system_, q, frequency), frequency);
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
  const solver::System& system_;
  solver::HarmonicSolver response_;
};

}  // namespace

StepResult analyse_harmonic(const JsonView& analysis, const CaseModel& case_model, std::size_t step,
                            bool draw, Recorder& record) {
  if (case_model.path) throw analysis.error("expected a model at one place");
  const double low = analysis.number("from_Hz");
  const double high = analysis.number("to_Hz");
  if (!(high > low)) throw analysis["to_Hz"].error("expected more than 'from_Hz'");
  const solver::System system = solver::assemble(build_model(case_model, step), case_model.effects);
  const std::vector<Output> outputs = read_outputs(analysis["outputs"], system.model);
  const bool damped = case_model.effects.has(solver::Effect::damping) && analysis.has("damping");
  const solver::HarmonicDamping damping =
      damped ? read_damping(analysis) : solver::HarmonicDamping();
  try {
    const Response response(system, damping);
    StepResult result{response.of_system().outcome(), {}, std::nullopt};
    if (draw) result.drawing = draw_model(system, case_model.manipulator.has_value());
    if (!result.outcome.solved()) return result;
    const auto points = analysis.get<solver::Index>("points", 101);
    for (solver::Index i = 0; i < points; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(points - 1);
      response.record_at(low + (high - low) * share, outputs, record, result);
    }
    for (const Output& output : outputs) {
      const double at = response.record_peak(low, high, output, record);
      if (result.drawing && &output == &outputs.front()) response.draw_at(at, *result.drawing);
    }
    for (solver::Index i = 0; i < response.of_system().frequencies().size(); ++i) {
      record.add("natural_frequency_Hz", "", response.of_system().frequencies()[i]);
    }
    record.add("degrees_of_freedom", "", static_cast<double>(system.K.rows()));
    result.counters = response.of_system().counters();
    if (damped) result.counters.count(solver::Effect::damping, points);
    return result;
  } catch (const solver::ModelError& error) {
    throw(analysis.has("damping") ? analysis["damping"] : analysis).error(error.what());
  }
}

}  // namespace trammel::harness
