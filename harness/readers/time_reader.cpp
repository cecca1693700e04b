#include "harness/readers/time_reader.h"

#include <cmath>

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

solver::TimeScheme scheme_of(const std::string& name, const JsonView& numbers) {
  if (name == "hht") return solver::hht_alpha(numbers.number("alpha"));
  if (name == "generalized-alpha")
    return solver::generalized_alpha(numbers.number("spectral_radius"));
  return solver::newmark(numbers.number("beta"), numbers.number("gamma"));
}

}  // namespace

solver::TimeScheme read_time_scheme(const JsonView& scheme) {
  if (scheme.json().is_string()) {
    return scheme.get<std::string>() == "linear-acceleration" ? solver::linear_acceleration()
                                                              : solver::average_acceleration();
  }
  const auto [name, numbers] = scheme.entries().front();
  try {
    return scheme_of(name, numbers);
  } catch (const solver::ModelError& error) {
    throw numbers.error(std::string("expected a scheme that has a meaning: ") + error.what());
  }
}

void require_step_count(const JsonView& step, double duration) {
  const double steps = std::ceil(duration / step.get<double>() * (1 - 1e-12));
  if (steps <= 1e7) return;
  throw step.error("expected at most ten million steps (got " + rounded(steps, 3) + ")");
}

solver::RayleighDamping read_rayleigh(const std::optional<JsonView>& damping) {
  if (!damping) return {};
  return {.mass = damping->get("mass_per_s", 0.0), .stiffness = damping->get("stiffness_s", 0.0)};
}

solver::LoadHistory read_load_history(const JsonView& analysis) {
  const auto history = analysis.find("load_history");
  if (!history) return {};
  const auto time = (*history)["time_s"].get<std::vector<double>>();
  const auto factor = (*history)["factor"].get<std::vector<double>>();
  if (factor.size() != time.size()) {
    throw(*history)["factor"].error("expected " + std::to_string(time.size()) +
                                    " numbers, one for each time (got " +
                                    std::to_string(factor.size()) + ")");
  }
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (time[i] < time[i - 1]) throw(*history)["time_s"][i].error("expected times that ascend");
  }
  return {time, factor};
}

solver::TransientOptions read_time_options(const JsonView& analysis) {
  solver::TransientOptions options;
  options.step = analysis.number("step_s");
  if (const auto scheme = analysis.find("scheme")) options.scheme = read_time_scheme(*scheme);
  if (const auto adaptive = analysis.find("error_control")) {
    solver::ErrorControl control;
    control.relative = adaptive->get("relative", control.relative);
    control.absolute = adaptive->get("absolute", control.absolute);
    control.finest_level = adaptive->get("finest_level", control.finest_level);
    options.adaptive = control;
  }
  return options;
}

}  // namespace trammel::harness
