/// Adapter for Simbody 3.7: motions of rigid bodies with pins, and motions of the rigid manipulator
/// along its path.
///
/// A body that is pinned to the ground has one rotation as its coordinate. All other bodies move
/// freely in the plane. Each pin of a free body is a pair of constraints that keep a point of one
/// body in two planes of the other body. The Runge-Kutta-Merson method integrates motions with an
/// accuracy of 2e-10. Torques of the manipulator are the motion forces that Simbody computes for
/// prescribed accelerations of the proximal links.
#include <Simbody.h>

#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace {

using Json = nlohmann::json;
using SimTK::MobilizedBody;
using SimTK::Motion;
using SimTK::Real;
using SimTK::State;
using SimTK::Vec3;

constexpr double kAccuracy = 2e-10;

struct Cannot : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the JSON object under a key, or an empty object.
const Json& section(const Json& json, const char* key) {
  static const Json empty = Json::object();
  return json.contains(key) && json.at(key).is_object() ? json.at(key) : empty;
}

Vec3 point(const Json& at) {
  return {at.at(0).get<double>(), at.at(1).get<double>(), 0};
}

/// Point of a mobilized body, in the frame of the body.
struct Place {
  MobilizedBody body;
  Vec3 station;
};

struct System {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};

  /// Returns a planar body with a given center of mass. Its initial axes are those of the ground.
  static SimTK::Body::Rigid rigid(double mass, const Vec3& center, double inertia) {
    const SimTK::Inertia about_center(inertia, inertia, inertia);
    return SimTK::Body::Rigid(
        SimTK::MassProperties(mass, center, about_center.shiftFromMassCenter(center, mass)));
  }

  /// Adds a pin, which makes a point of one body coincide with a point of another body.
  void pin(Place first, Place second) {
    for (const int axis : {0, 1}) {
      const SimTK::UnitVec3 normal{SimTK::CoordinateAxis(axis)};
      SimTK::Constraint::PointInPlane(first.body, normal, first.station[axis], second.body,
                                      second.station);
    }
  }

  void add_weight(const Json& model) {
    const Json g = model.value("gravity_m_s2", Json{0, 0});
    if (g.is_array() && point(g).norm() > 0) SimTK::Force::UniformGravity(forces, matter, point(g));
  }
  void add_load(const Json& load, const Place& place) {
    SimTK::Force::ConstantForce(forces, place.body, place.station,
                                point(load.value("force_N", Json{0, 0})));
    SimTK::Force::ConstantTorque(forces, place.body, Vec3(0, 0, load.value("moment_N_m", 0.0)));
  }

  MobilizedBody turning(const SimTK::Body& body, const Vec3& in_ground) {
    return MobilizedBody::Pin(matter.Ground(), in_ground, body, Vec3(0));
  }
  MobilizedBody moving(const SimTK::Body& body, const Vec3& in_ground) {
    return MobilizedBody::Planar(matter.Ground(), in_ground, body, Vec3(0));
  }
};

double turn(const MobilizedBody& body, const State& state) {
  return body.isGround() ? 0 : body.getOneQ(state, 0);
}

double rate(const MobilizedBody& body, const State& state) {
  return body.isGround() ? 0 : body.getOneU(state, 0);
}

void require_known_keys(const Json& json, const std::set<std::string>& known, const char* what) {
  for (const auto& item : json.items())
    if (known.count(item.key()) == 0 && item.value() != Json(false))
      throw Cannot(std::string("no ") + what + " '" + item.key() + "'");
}

/// Mechanism of a case: nodes, rigid bodies, masses, supports, pins, springs and loads.
struct Mechanism : System {
  static constexpr std::size_t kMaxBodies = 20;  // closed loops of more bodies take minutes
  std::map<std::string, Place> places;

  Vec3 at(const Json& model, const std::string& node) { return point(model.at("nodes").at(node)); }

  explicit Mechanism(const Json& model) {
    require_known_keys(model,
                       {"nodes", "rigid_bodies", "point_masses", "supports", "pins",
                        "axial_springs", "loads", "gravity_m_s2"},
                       "part");
    std::map<std::string, std::set<std::string>> groups;
    std::set<std::string> grouped;
    for (const auto& item : section(model, "rigid_bodies").items()) {
      std::set<std::string>& nodes = groups[item.key()];
      nodes = item.value().at("nodes").get<std::set<std::string>>();
      nodes.insert(item.value().at("reference").get<std::string>());
      grouped.insert(nodes.begin(), nodes.end());
    }
    for (const auto& item : model.at("nodes").items())
      if (grouped.count(item.key()) == 0) groups["node " + item.key()] = {item.key()};
    if (groups.size() > kMaxBodies) throw Cannot("models of more than 20 bodies are not supported");
    for (const auto& [name, nodes] : groups) add_group(model, nodes);
    for (const auto& item : section(model, "pins").items())
      pin(places.at(item.value().at("nodes").at(0)), places.at(item.value().at("nodes").at(1)));
    add_forces(model);
  }

  /// Adds nodes that move as one body: fixed to the ground, pinned at a supported node, or free.
  void add_group(const Json& model, const std::set<std::string>& nodes) {
    std::string held;
    bool fixed = false;
    for (const std::string& node : nodes) {
      const Json taken = section(model, "supports").value(node, Json::array());
      if (taken.empty()) continue;
      if (taken.size() == 1 || !held.empty())
        throw Cannot("sliding supports and several supports of a body are not supported");
      held = node;
      fixed = taken.size() == 3 || nodes.size() == 1;
    }
    const Vec3 origin = held.empty() ? at(model, *nodes.begin()) : at(model, held);
    double mass = 0;
    Vec3 moment(0);
    std::vector<std::pair<double, Vec3>> parts;
    double inertia = 0;
    for (const auto& item : section(model, "point_masses").items()) {
      const Json& part = item.value();
      if (nodes.count(part.at("node")) == 0) continue;
      const Vec3 arm =
          at(model, part.at("node")) + point(part.value("offset_m", Json{0, 0})) - origin;
      mass += part.at("mass_kg").get<double>();
      moment += part.at("mass_kg").get<double>() * arm;
      parts.emplace_back(part.at("mass_kg").get<double>(), arm);
      inertia += part.value("inertia_kg_m2", 0.0);
    }
    if (mass == 0 && !fixed) throw Cannot("bodies without mass are not supported");
    const Vec3 center = mass > 0 ? Vec3(moment / mass) : Vec3(0);
    for (const auto& [m, arm] : parts) inertia += m * (arm - center).normSqr();
    MobilizedBody body = matter.Ground();
    if (!fixed && held.empty() && inertia == 0)
      throw Cannot("bodies that move freely require a moment of inertia");
    if (!fixed) {
      const SimTK::Body::Rigid solid = rigid(mass, center, inertia);
      body = held.empty() ? moving(solid, origin) : turning(solid, origin);
    }
    for (const std::string& node : nodes)
      places[node] = {body, fixed ? at(model, node) : at(model, node) - origin};
  }

  void add_forces(const Json& model) {
    add_weight(model);
    for (const auto& item : section(model, "axial_springs").items()) {
      const Json& spring = item.value();
      require_known_keys(spring, {"nodes", "stiffness_N_per_m", "rest_length_m"}, "spring with");
      const Place& a = places.at(spring.at("nodes").at(0));
      const Place& b = places.at(spring.at("nodes").at(1));
      SimTK::Force::TwoPointLinearSpring(forces, a.body, a.station, b.body, b.station,
                                         spring.at("stiffness_N_per_m").get<double>(),
                                         spring.at("rest_length_m").get<double>());
    }
    for (const auto& item : section(model, "loads").items()) {
      const Json& load = item.value();
      require_known_keys(load, {"node", "force_N", "moment_N_m"}, "load with");
      const Place& place = places.at(load.at("node"));
      if (!place.body.isGround()) add_load(load, place);
    }
  }

  /// Sets the given initial velocities, and computes all other velocities from the constraints.
  void start(const Json& given, State& state) {
    std::vector<std::pair<MobilizedBody, Real>> known;
    for (const auto& item : given.items()) {
      require_known_keys(item.value(), {"x_m_per_s", "rotation_rad_per_s"}, "initial");
      const Place& place = places.at(item.key());
      if (place.body.isGround() || place.body.getNumU(state) != 1)
        throw Cannot("initial velocities require a body that is pinned to the ground");
      known.emplace_back(place.body,
                         item.value().contains("x_m_per_s")
                             ? -item.value()["x_m_per_s"].get<double>() / place.station[1]
                             : item.value()["rotation_rad_per_s"].get<double>());
    }
    for (auto& [body, value] : known) body.lockAt(state, value, Motion::Velocity);
    system.realize(state, SimTK::Stage::Position);
    system.prescribe(state);
    system.projectU(state, kAccuracy);
    for (auto& [body, value] : known) body.unlock(state);
  }
};

using Answer = std::map<std::string, std::vector<double>>;

/// Appends the components of a vector along x and y to the answer, under the names `head` + "x" or
/// "y" + `tail`.
void append_xy(Answer& answer, const std::string& head, const std::string& tail, const Vec3& v) {
  answer[head + "x" + tail].push_back(v[0]);
  answer[head + "y" + tail].push_back(v[1]);
}

void append_nodes(const Mechanism& mechanism, const Json& angles, const State& state,
                  Answer& answer) {
  for (const auto& [name, place] : mechanism.places) {
    append_xy(answer, "position_", "_m:" + name,
              place.body.findStationLocationInGround(state, place.station));
    append_xy(answer, "velocity_", "_m_per_s:" + name,
              place.body.findStationVelocityInGround(state, place.station));
  }
  for (const auto& item : angles.items()) {
    const MobilizedBody& body = mechanism.places.at(item.value().at("node")).body;
    double angle = item.value().value("initial_rad", 0.0) + turn(body, state),
           speed = rate(body, state);
    if (item.value().contains("from")) {
      const MobilizedBody& from = mechanism.places.at(item.value()["from"]).body;
      angle -= turn(from, state);
      speed -= rate(from, state);
    }
    answer["angle_rad:" + item.key()].push_back(angle);
    answer["angle_rate_rad_per_s:" + item.key()].push_back(speed);
  }
}

Answer motion(const Json& model, const Json& options) {
  require_known_keys(options,
                     {"end_time_s", "step_s", "output_step_s", "extrapolated", "nodes",
                      "initial_velocities", "angles", "integrator", "spectral_radius", "tolerance"},
                     "option");
  Mechanism mechanism(model);
  SimTK::State state = mechanism.system.realizeTopology();
  mechanism.system.realizeModel(state);
  mechanism.start(section(options, "initial_velocities"), state);
  SimTK::RungeKuttaMersonIntegrator integrator(mechanism.system);
  integrator.setAccuracy(kAccuracy);
  integrator.setConstraintTolerance(kAccuracy);
  integrator.initialize(state);
  const Json& angles = section(options, "angles");
  Answer answer;
  const double end = options.at("end_time_s").get<double>();
  const double step = options.value("output_step_s", options.at("step_s").get<double>());
  for (int i = 0; i * step < end * (1 + 1e-12); ++i) {
    while (integrator.getTime() < i * step) integrator.stepTo(i * step);
    mechanism.system.realize(integrator.getState(), SimTK::Stage::Velocity);
    append_nodes(mechanism, angles, integrator.getState(), answer);
  }
  return answer;
}

/// Rigid manipulator of the object "mechanism" of an exported case: three chains of two links, and
/// the platform.
struct Manipulator : System {
  std::map<std::string, MobilizedBody> bodies;
  std::map<std::string, Vec3> centers;  ///< centers of mass from body origins, in ground axes
  Json mechanism;

  explicit Manipulator(const Json& exported) : mechanism(exported) {
    for (const char* i : {"1", "2", "3"}) {
      const std::string n(i);
      const Vec3 a = joint("A" + n), b = joint("B" + n);
      const std::string low = "A" + n + "-B" + n, high = "B" + n + "-C" + n;
      bodies[low] = turning(solid(low, a), a);
      bodies[high] = MobilizedBody::Pin(bodies[low], b - a, solid(high, b), Vec3(0));
    }
    const Vec3 p = point(mechanism["path"]["pose_m_rad"][0]);  // P, not the mass center
    bodies["platform"] = moving(solid("platform", p), p);
    for (const char* i : {"1", "2", "3"}) {
      const std::string n(i);
      const Vec3 c = joint("C" + n);
      pin({bodies["platform"], c - p}, {bodies["B" + n + "-C" + n], c - joint("B" + n)});
    }
  }

  Vec3 joint(const std::string& name) const {
    return point(mechanism["joints"][name]["position_m"]);
  }
  Vec3 center(const std::string& name) const {
    return point(mechanism["bodies"][name]["center_m"]);
  }
  SimTK::Body::Rigid solid(const std::string& name, const Vec3& origin) {
    const Json& body = mechanism["bodies"][name];
    centers[name] = center(name) - origin;
    return rigid(body["mass_kg"].get<double>(), centers[name], body["inertia_kg_m2"].get<double>());
  }
};

SimTK::Vector planar(const Json& row) {  // Simbody's order: angle, x, y
  SimTK::Vector v(3);
  v[0] = row[2].get<double>();
  v[1] = row[0].get<double>();
  v[2] = row[1].get<double>();
  return v;
}

/// Computes the state at point i of the path. The motion of the platform is prescribed; the motion
/// of the links follows from the constraints.
void follow(Manipulator& m, const Json& path, std::size_t i, const SimTK::Vector& q0,
            State& state) {
  const MobilizedBody platform = m.bodies["platform"];
  platform.lockAt(state, SimTK::Vector(planar(path["pose_m_rad"][i]) - q0), Motion::Position);
  m.system.realize(state, SimTK::Stage::Time);
  m.system.prescribe(state);
  m.system.projectQ(state, 1e-13);
  platform.unlock(state);
  platform.lockAt(state, planar(path["velocity_per_s"][i]), Motion::Velocity);
  m.system.realize(state, SimTK::Stage::Position);
  m.system.prescribe(state);
  m.system.projectU(state, 1e-13);
  platform.unlock(state);
  platform.lockAt(state, planar(path["acceleration_per_s2"][i]), Motion::Acceleration);
  m.system.realize(state, SimTK::Stage::Acceleration);
}

/// Appends angles, angular velocities and angular accelerations of the links, and the motion of all
/// centers of mass, to the answer.
void append_motion(const Manipulator& m, const State& state, Answer& answer) {
  for (const auto& [name, body] : m.bodies) {
    const double start = m.mechanism["bodies"][name]["angle_rad"].get<double>();
    const bool proximal = name[0] == 'A';
    if (name != "platform") {
      const std::string kind = proximal ? "active_" : "passive_", end = ":" + name.substr(0, 2);
      const double below = proximal ? 0 : turn(body.getParentMobilizedBody(), state);
      answer[kind + "angle_rad" + end].push_back(start + below + turn(body, state));
      answer[kind + "velocity_rad_per_s" + end].push_back(body.getBodyAngularVelocity(state)[2]);
      answer[kind + "acceleration_rad_per_s2" + end].push_back(
          body.getBodyAngularAcceleration(state)[2]);
    }
    const Vec3& at = m.centers.at(name);
    append_xy(answer, "center_", "_m:" + name, body.findStationLocationInGround(state, at));
    append_xy(answer, "center_velocity_", "_m_per_s:" + name,
              body.findStationVelocityInGround(state, at));
    append_xy(answer, "center_acceleration_", "_m_per_s2:" + name,
              body.findStationAccelerationInGround(state, at));
  }
  answer["kinetic_energy_J"].push_back(m.system.calcKineticEnergy(state));
}

/// Appends to the answer the torques that cause the accelerations of the proximal links along the
/// path.
void append_torques(Manipulator& m, State& state, Answer& answer) {
  std::vector<MobilizedBody> active;
  std::vector<SimTK::Vector> accelerations;
  for (const char* name : {"A1-B1", "A2-B2", "A3-B3"}) {
    active.push_back(m.bodies[name]);
    accelerations.push_back(active.back().getUDotAsVector(state));
  }
  m.bodies["platform"].unlock(state);
  for (std::size_t i = 0; i < 3; ++i)
    active[i].lockAt(state, accelerations[i], Motion::Acceleration);
  m.system.realize(state, SimTK::Stage::Acceleration);
  SimTK::Vector torques;
  m.matter.findMotionForces(state, torques);
  double power = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double torque = -active[i].getOneFromUPartition(state, 0, torques);
    power += torque * rate(active[i], state);
    answer["torque_N_m:A" + std::to_string(i + 1)].push_back(torque);
    active[i].unlock(state);
  }
  answer["actuator_power_W"].push_back(power);
}

void load(Manipulator& m, const Json& model) {
  m.add_weight(model);
  for (const auto& item : section(model, "loads").items()) {
    if (item.value().is_null()) continue;
    require_known_keys(item.value(), {"node", "force_N", "moment_N_m"}, "load with");
    if (item.value().at("node") != "P") throw Cannot("loads are supported on P only");
    m.add_load(item.value(), {m.bodies["platform"], Vec3(0)});
  }
}

/// Integrates the motion from the first point of the path under constant torques.
Answer driven(const Json& model, const Json& mechanism, const Json& options) {
  require_known_keys(options, {"torque_N_m", "tolerance"}, "option");
  if (!options.contains("torque_N_m")) throw Cannot("only constant drive torques are supported");
  Manipulator m(mechanism);
  load(m, model);
  for (const int i : {0, 1, 2}) {
    const std::string n = std::to_string(i + 1);
    SimTK::Force::MobilityConstantForce(m.forces, m.bodies["A" + n + "-B" + n], 0,
                                        options["torque_N_m"][i].get<double>());
  }
  State state = m.system.realizeTopology();
  m.system.realizeModel(state);
  const Json& path = mechanism["path"];
  follow(m, path, 0, planar(path["pose_m_rad"][0]), state);
  const MobilizedBody platform = m.bodies["platform"];
  platform.unlock(state);
  SimTK::RungeKuttaMersonIntegrator integrator(m.system);
  integrator.setAccuracy(kAccuracy / 10);
  integrator.setConstraintTolerance(kAccuracy / 10);
  integrator.initialize(state);
  Answer answer;
  for (const Json& time : path["time_s"]) {
    while (integrator.getTime() < time.get<double>()) integrator.stepTo(time.get<double>());
    const State& now = integrator.getState();
    m.system.realize(now, SimTK::Stage::Velocity);
    append_xy(answer, "motion_", "_m", platform.getBodyOriginLocation(now));
    answer["motion_phi_rad"].push_back(path["pose_m_rad"][0][2].get<double>() +
                                       turn(platform, now));
    append_xy(answer, "motion_velocity_", "_m_per_s", platform.getBodyOriginVelocity(now));
    answer["motion_velocity_phi_rad_per_s"].push_back(rate(platform, now));
    answer["kinetic_energy_J"].push_back(m.system.calcKineticEnergy(now));
  }
  return answer;
}

Answer answer_on_path(const Json& model, const Json& mechanism, const Json& options, bool torques) {
  require_known_keys(options, {"bodies", "torque_residuals"}, "option");
  Manipulator m(mechanism);
  if (torques) load(m, model);
  State state = m.system.realizeTopology();
  m.system.realizeModel(state);
  const Json& path = mechanism["path"];
  const SimTK::Vector start = planar(path["pose_m_rad"][0]);
  Answer answer;
  for (std::size_t i = 0; i < path["time_s"].size(); ++i) {
    follow(m, path, i, start, state);
    append_motion(m, state, answer);
    if (torques) append_torques(m, state, answer);
    m.bodies["platform"].unlock(state);
  }
  return answer;
}

Answer solve(const Json& given) {
  const std::string kind = given["analysis"].begin().key();
  const Json& options = given["analysis"].begin().value();
  if (kind == "large-motion") return motion(given["model"], options);
  if (kind == "inverse-dynamics" || kind == "kinematics")
    return answer_on_path(given["model"], given["export"]["mechanism"], options, kind[0] == 'i');
  if (kind == "forward-dynamics")
    return driven(given["model"], given["export"]["mechanism"], options);
  throw Cannot("unsupported analysis '" + kind + "'");
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "simbody CASE.json RESULT.json\n";
    return 2;
  }
  const Json given = Json::parse(std::ifstream(words[1]));
  Json result = {{"status", "solved"}, {"solver", {{"name", "Simbody"}, {"version", "3.7"}}}};
  int status = 0;
  try {
    const Answer answer = solve(given);
    for (const Json& one : given["export"]["quantities"]) {
      const auto found = answer.find(one["name"].get<std::string>());
      if (found != answer.end())
        result["quantities"][found->first] = {{"unit", one["unit"]}, {"values", found->second}};
    }
    if (!result.contains("quantities"))
      throw Cannot("none of the requested quantities is supported");
  } catch (const Cannot& reason) {
    result["status"] = "cannot";
    result["reason"] = reason.what();
    status = 4;
  }
  std::ofstream(words[2]) << result;
  return status;
}
