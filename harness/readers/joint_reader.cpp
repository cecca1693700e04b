#include "harness/readers/joint_reader.h"

#include <cmath>
#include <numbers>

#include "harness/base/text.h"
#include "harness/readers/material_reader.h"
#include "harness/readers/time_reader.h"

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
  throw place.error("expected the name of a node (got '" + printable(word) + "')" +
                    did_you_mean(word, names));
}

solver::large_motion::Slider read_slider(const std::string& name, const JsonView& place,
                                         const solver::Model& built) {
  solver::large_motion::Slider slider{name, find_node(place["node"], built), -1,
                                      place.number("direction_rad"),
                                      place.get("keeps_angle", false)};
  if (place.has("rail")) {
    slider.rail = find_node(place["rail"], built);
    if (slider.rail == slider.node) throw place["rail"].error("expected another node");
  }
  return slider;
}

solver::large_motion::LineSpring read_line_spring(const std::string& name, const JsonView& place,
                                                  const solver::Model& built) {
  solver::large_motion::LineSpring spring;
  spring.name = name;
  for (std::size_t i = 0; i < 2; ++i) spring.nodes[i] = find_node(place["nodes"][i], built);
  spring.stiffness = place.number("stiffness_N_per_m");
  spring.rest_length = place.get("rest_length_m", spring.rest_length);
  return spring;
}

solver::large_motion::FollowerLoad read_follower(const JsonView& place,
                                                 const solver::Model& built) {
  if (!place.has("node")) throw place.error("expected 'node'");
  return {find_node(place["node"], built), read_force(place)};
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

solver::large_motion::LargeMotionModel read_joint_elements(const JsonView& model,
                                                           const solver::Model& built) {
  solver::large_motion::LargeMotionModel large_motion;
  if (const auto sliders = model.find("sliders")) {
    for (const auto& [name, place] : sliders->entries()) {
      large_motion.sliders.push_back(read_slider(name, place, built));
    }
  }
  if (const auto springs = model.find("axial_springs")) {
    for (const auto& [name, place] : springs->entries()) {
      large_motion.line_springs.push_back(read_line_spring(name, place, built));
    }
  }
  if (const auto loads = model.find("follower_loads")) {
    for (const auto& entry : loads->entries()) {
      large_motion.follower_loads.push_back(read_follower(entry.second, built));
    }
  }
  return large_motion;
}

void read_drives(const JsonView& analysis, const solver::Model& built,
                 solver::large_motion::LargeMotionModel& large_motion) {
  const auto drives = analysis.find("drives");
  if (!drives) return;
  for (const auto& [name, place] : drives->entries()) {
    const std::string motion = place.text("motion");
    const int direction = motion == "x" ? 0 : motion == "y" ? 1 : 2;
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
  const auto starts = analysis.find("initial_velocities");
  if (!starts) return;
  for (const auto& [name, place] : starts->entries()) {
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
