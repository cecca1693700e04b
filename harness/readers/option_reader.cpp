#include "harness/readers/option_reader.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "harness/readers/field_reader.h"

namespace trammel::harness {

TRAMMEL_WORDS(solver::DesignParameter::Kind, "length", "thickness", "width", "E", "density",
              "poisson_ratio", "base_side", "platform_side", "platform_mass", "platform_inertia",
              "active_stiffness", "elbow_stiffness", "platform_joint_stiffness", "orientation");

namespace {

using Kind = solver::DesignParameter::Kind;

solver::TimeScheme time_scheme_from_name(const std::string& name, const JsonView& numbers) {
  if (name == "hht") return solver::hht_alpha(numbers.number("alpha"));
  if (name == "generalized-alpha")
    return solver::generalized_alpha(numbers.number("spectral_radius"));
  return solver::newmark(numbers.number("beta"), numbers.number("gamma"));
}

std::size_t count_of(const JsonView& modal, std::optional<solver::Index> known) {
  if (!modal.has("modes"))
    throw modal.error("a single damping 'ratio' requires 'modes' (the number of modes)");
  const JsonView stated = modal["modes"];
  if (!stated.json().is_string()) return stated.get<std::size_t>();
  if (known) return static_cast<std::size_t>(*known);
  throw stated.error("'all' requires the method 'modal-superposition'; expected a number of modes");
}

}  // namespace

solver::TimeScheme read_time_scheme(const JsonView& scheme) {
  if (scheme.json().is_string())
    return scheme.get<std::string>() == "linear-acceleration" ? solver::linear_acceleration()
                                                              : solver::average_acceleration();
  const auto [name, numbers] = scheme.entries().front();
  try {
    return time_scheme_from_name(name, numbers);
  } catch (const solver::ModelError& error) {
    throw numbers.error(std::string("expected a valid time scheme: ") + error.what());
  }
}

void limit_time_step_count(const JsonView& step, double duration) {
  const double steps = std::ceil(duration / step.get<double>() * (1 - 1e-12));
  if (steps <= 1e7) return;
  throw step.error("the step is too small; expected at most ten million steps (got " +
                   rounded(steps, 3) + ")");
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
  if (factor.size() != time.size())
    throw(*history)["factor"].error("expected " + std::to_string(time.size()) +
                                    " numbers, one for each time (got " +
                                    std::to_string(factor.size()) + ")");
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (time[i] < time[i - 1])
      throw(*history)["time_s"][i].error(
          "this time is less than the previous one; expected ascending times");
  }
  return {time, factor};
}

solver::TransientOptions read_time_options(const JsonView& analysis) {
  solver::TransientOptions options;
  options.step = analysis.get("step_s", 0.0);
  if (const auto scheme = analysis.find("scheme")) options.scheme = read_time_scheme(*scheme);
  if (const auto adaptive = analysis.find("error_control")) {
    const FieldReader reader(*adaptive);
    solver::ErrorControl& control = options.adaptive.emplace();
    reader.optional("relative", control.relative);
    reader.optional("absolute", control.absolute);
    reader.optional("finest_level", control.finest_level);
  }
  return options;
}

solver::HarmonicDamping read_damping(const JsonView& analysis, std::optional<solver::Index> modes) {
  solver::HarmonicDamping read;
  const auto damping = analysis.find("damping");
  if (!damping) return read;
  read.rayleigh = read_rayleigh(damping->find("rayleigh"));
  const auto modal = damping->find("modal");
  if (!modal) return read;
  const JsonView ratio = (*modal)["ratio"];
  if (!ratio.json().is_array()) {
    read.modal_ratio.assign(count_of(*modal, modes), ratio.get<double>());
  } else if (modal->has("modes")) {
    throw(*modal)["modes"].error("'modes' requires a single 'ratio' (got one for each mode)");
  } else {
    read.modal_ratio = ratio.get<std::vector<double>>();
  }
  if (modes && std::ssize(read.modal_ratio) > *modes)
    throw modal->error("expected at most " + std::to_string(*modes) + " damping ratios (got " +
                       std::to_string(read.modal_ratio.size()) + ")");
  return read;
}

solver::EigenMethod read_eigen_method(const JsonView& analysis) {
  return analysis.get("eigensolver", solver::EigenMethod::automatic);
}

solver::DesignParameter read_design_parameter(const JsonView& parameter) {
  solver::DesignParameter read{.kind = parameter["property"].get<Kind>()};
  if (read.kind > Kind::poisson_ratio) {
    for (const char* key : {"links", "platform"})
      if (parameter.has(key))
        throw parameter[key].error(
            "expected no 'links' and no 'platform': neither has the property to be varied");
    return read;
  }
  read.platform = parameter.get("platform", false);
  if (const auto links = parameter.find("links")) {
    read.proximal.fill(false);
    read.distal.fill(false);
    for (const auto& entry : links->entries()) {
      const auto link = entry.second.get<std::string>();  // "A1-B1" or "B1-C1"
      (link[0] == 'A' ? read.proximal : read.distal)[static_cast<std::size_t>(link[1] - '1')] =
          true;
    }
  }
  const bool platform_has = read.kind != Kind::length && read.kind != Kind::width;
  if (read.platform && !platform_has)
    throw parameter["platform"].error(
        "'platform' requires the property thickness, E, density or Poisson's ratio (got a length "
        "or width)");
  const auto any = [](const std::array<bool, 3>& selected) {
    return std::ranges::count(selected, true) > 0;
  };
  if (!any(read.proximal) && !any(read.distal) && !read.platform)
    throw parameter.error("expected at least one link or the platform (got neither)");
  return read;
}

std::string frequency_sensitivity_name(Kind kind) {
  switch (kind) {
    case Kind::E:
      return "sensitivity_Hz_per_Pa";
    case Kind::density:
      return "sensitivity_Hz_m3_per_kg";
    case Kind::poisson_ratio:
      return "sensitivity_Hz";
    case Kind::platform_mass:
      return "sensitivity_Hz_per_kg";
    case Kind::platform_inertia:
      return "sensitivity_Hz_per_kg_m2";
    case Kind::active_stiffness:
    case Kind::elbow_stiffness:
    case Kind::platform_joint_stiffness:
      return "sensitivity_Hz_rad_per_N_m";
    case Kind::orientation:
      return "sensitivity_Hz_per_rad";
    default:
      return "sensitivity_Hz_per_m";
  }
}

namespace {

solver::Index find_node_by_name(const std::string& word, const JsonView& place,
                                const solver::Model& built) {
  const solver::Index found = word.empty() ? -1 : built.find_node(word);
  if (found >= 0) return found;
  std::vector<std::string> names;
  for (const solver::Node& node : built.nodes)
    if (!node.name.empty()) names.push_back(node.name);
  throw place.error(unknown_name_message("the name of a node", word, names));
}

solver::large_motion::TimeFunction spin_up(double speed, double duration) {
  return [speed, duration](double t) {
    const double w = 2 * std::numbers::pi / duration;
    if (t >= duration) return std::array<double, 3>{speed * (t - duration / 2), speed, 0};
    // The half-angle form of 1 - cos avoids cancellation for small t.
    const double half = std::sin(w * t / 2), turned = t * t / 2 - 2 * half * half / (w * w);
    return std::array<double, 3>{speed / duration * turned,
                                 speed / duration * (t - std::sin(w * t) / w),
                                 speed / duration * 2 * half * half};
  };
}

solver::large_motion::TimeFunction rest_to_rest_motion(double travel, double duration) {
  return [travel, duration](double t) {
    if (t >= duration) return std::array<double, 3>{travel, 0, 0};
    const double u = std::max(0.0, t / duration);
    return std::array<double, 3>{travel * u * u * u * (10 - u * (15 - 6 * u)),
                                 travel / duration * 30 * u * u * (1 - u) * (1 - u),
                                 travel / (duration * duration) * 60 * u * (1 - u) * (1 - 2 * u)};
  };
}

}  // namespace

solver::large_motion::TimeFunction read_motion_law(const JsonView& law) {
  if (const auto place = law.find("constant_speed")) {
    const double speed = place->number("speed_per_s");
    return [speed](double t) { return std::array<double, 3>{speed * t, speed, 0}; };
  }
  if (const auto place = law.find("spin_up"))
    return spin_up(place->number("speed_per_s"), place->number("duration_s"));
  if (const auto place = law.find("rest_to_rest"))
    return rest_to_rest_motion(place->number("travel"), place->number("duration_s"));
  const JsonView place = law["harmonic"];
  const double a = place.number("amplitude"), w = place.number("angular_speed_rad_s");
  return [a, w](double t) {
    return std::array<double, 3>{a * std::sin(w * t), a * w * std::cos(w * t),
                                 -a * w * w * std::sin(w * t)};
  };
}

solver::Index find_node(const JsonView& name, const solver::Model& built) {
  return find_node_by_name(name.get<std::string>(), name, built);
}

void read_prescribed_motions(const JsonView& analysis, const solver::Model& built,
                             solver::large_motion::LargeMotionModel& large_motion) {
  for (const auto& [name, place] : analysis.entries("drives")) {
    const auto direction = static_cast<int>(place["motion"].get<NodeMotion>());
    large_motion.drives.push_back(
        {name, find_node(place["node"], built), direction, read_motion_law(place["law"])});
  }
}

void read_motion_conditions(const JsonView& analysis, const solver::Model& built,
                            solver::large_motion::LargeMotionModel& large_motion) {
  large_motion.mass_damping = analysis.get("mass_damping_per_s", 0.0);
  large_motion.strain_rate_damping = analysis.get("strain_rate_damping_s", 0.0);
  if (const auto ramp = analysis.find("load_ramp_s")) {
    const solver::large_motion::TimeFunction law = rest_to_rest_motion(1, ramp->get<double>());
    large_motion.load_history = [law](double t) { return law(t)[0]; };
  }
  if (const auto stated = analysis.find("load_history")) {
    if (analysis.has("load_ramp_s"))
      throw stated->error("'load_history' is not allowed with 'load_ramp_s'; expected one of them");
    const solver::LoadHistory history = read_load_history(analysis);
    for (std::size_t i = 1; i < history.time.size(); ++i) {
      if (history.time[i] > history.time[i - 1]) continue;
      throw(*stated)["time_s"][i].error(
          "the factor jumps; expected a continuous function, with increasing times");
    }
    large_motion.load_history = [history](double t) { return history.at(t); };
    large_motion.load_breakpoints = history.breakpoint_times();
  }
  for (const auto& [name, place] : analysis.entries("initial_velocities")) {
    const solver::Index node = find_node_by_name(name, place, built);
    int direction = 0;
    for (const char* key : {"x_m_per_s", "y_m_per_s", "rotation_rad_per_s"}) {
      if (place.has(key))
        large_motion.initial_velocities.push_back({node, direction, place.number(key)});
      ++direction;
    }
  }
}

}  // namespace trammel::harness
