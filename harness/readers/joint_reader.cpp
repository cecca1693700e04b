#include "harness/readers/joint_reader.h"

#include <cmath>
#include <numbers>

#include "harness/readers/field_reader.h"
#include "harness/readers/option_reader.h"

namespace trammel::harness {
namespace {

solver::Index find_node_by_name(const std::string& word, const JsonView& place,
                                const solver::Model& built) {
  const solver::Index found = word.empty() ? -1 : built.find_node(word);
  if (found >= 0) return found;
  std::vector<std::string> names;
  for (const solver::Node& node : built.nodes) {
    if (!node.name.empty()) names.push_back(node.name);
  }
  throw place.error(unknown_name("the name of a node", word, names));
}

solver::large_motion::TimeFunction spin_up(double speed, double duration) {
  return [speed, duration](double t) {
    const double w = 2 * std::numbers::pi / duration;
    if (t >= duration) return std::array<double, 3>{speed * (t - duration / 2), speed, 0};
    // 1 - cos by its half angle: early on it is all there is.
    const double half = std::sin(w * t / 2);
    const double turned = t * t / 2 - 2 * half * half / (w * w);
    return std::array<double, 3>{speed / duration * turned,
                                 speed / duration * (t - std::sin(w * t) / w),
                                 speed / duration * 2 * half * half};
  };
}

solver::large_motion::TimeFunction rest_to_rest(double travel, double duration) {
  return [travel, duration](double t) {
    if (t >= duration) return std::array<double, 3>{travel, 0, 0};
    const double u = std::max(0.0, t / duration);
    return std::array<double, 3>{travel * u * u * u * (10 - u * (15 - 6 * u)),
                                 travel / duration * 30 * u * u * (1 - u) * (1 - u),
                                 travel / (duration * duration) * 60 * u * (1 - u) * (1 - 2 * u)};
  };
}

}  // namespace

solver::large_motion::TimeFunction read_law(const JsonView& law) {
  if (const auto place = law.find("constant_speed")) {
    const double speed = place->number("speed_per_s");
    return [speed](double t) { return std::array<double, 3>{speed * t, speed, 0}; };
  }
  if (const auto place = law.find("spin_up")) {
    return spin_up(place->number("speed_per_s"), place->number("duration_s"));
  }
  if (const auto place = law.find("rest_to_rest")) {
    return rest_to_rest(place->number("travel"), place->number("duration_s"));
  }
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

void read_drives(const JsonView& analysis, const solver::Model& built,
                 solver::large_motion::LargeMotionModel& large_motion) {
  for (const auto& [name, place] : analysis.entries("drives")) {
    const auto direction = static_cast<int>(place["motion"].get<NodeMotion>());
    large_motion.drives.push_back(
        {name, find_node(place["node"], built), direction, read_law(place["law"])});
  }
}

void read_history(const JsonView& analysis, const solver::Model& built,
                  solver::large_motion::LargeMotionModel& large_motion) {
  large_motion.mass_damping = analysis.get("mass_damping_per_s", 0.0);
  large_motion.strain_rate_damping = analysis.get("strain_rate_damping_s", 0.0);
  if (const auto ramp = analysis.find("load_ramp_s")) {
    const solver::large_motion::TimeFunction law = rest_to_rest(1, ramp->get<double>());
    large_motion.load_history = [law](double t) { return law(t)[0]; };
  }
  if (const auto stated = analysis.find("load_history")) {
    if (analysis.has("load_ramp_s")) throw stated->error("expected it without 'load_ramp_s'");
    const solver::LoadHistory history = read_load_history(analysis);
    for (std::size_t i = 1; i < history.time.size(); ++i) {
      if (history.time[i] > history.time[i - 1]) continue;
      throw(*stated)["time_s"][i].error("expected no jump: the integrators see none within a step");
    }
    large_motion.load_history = [history](double t) { return history.at(t); };
    large_motion.load_breakpoints = history.bends();
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
