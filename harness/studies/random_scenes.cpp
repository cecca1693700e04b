#include "harness/studies/random_scenes.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace trammel::harness {
namespace {

/// Numbers drawn in an order that the scene fixes; std distributions differ between libraries.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double logarithmic(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  Json direction(double size) {
    const double angle = uniform(-std::numbers::pi, std::numbers::pi);
    return {size * std::cos(angle), size * std::sin(angle)};
  }

 private:
  std::mt19937_64 engine_;
};

constexpr double kE = 7e10, kDensity = 2700, kPoisson = 0.33;

Json material() {
  return {{"E_Pa", kE}, {"rho_kg_m3", kDensity}, {"nu", kPoisson}};
}

/// Stiffness of a joint, over E I / L of a link: from one that is felt to one that is not.
Json joint(Draw& draw, const char* otherwise, double thickness, double width, double length) {
  if (!draw.chance(0.4)) return otherwise;
  const double bending = kE * width * std::pow(thickness, 3) / 12 / length;
  return {{"spring_N_m_per_rad", bending * draw.logarithmic(1e-2, 1e6)}};
}

/// A load that would turn a link of that bending stiffness by about so much [N].
double bending_load(Draw& draw, double thickness, double width, double length) {
  const double bending = kE * width * std::pow(thickness, 3) / 12;
  return draw.logarithmic(1e-5, 0.3) * bending / (length * length);
}

Json analysis(bool modes, Draw& draw) {
  if (!modes) return {{"statics", Json::object()}};
  return {{"modes", {{"count", draw.chance(0.5) ? 1 : 3}}}};
}

/// Three equal limbs of Timoshenko links, and what joins and carries them.
Json manipulator_of(double length, double thickness, double width, int elements,
                    const Json& platform, const Json& joints) {
  return {{"base_side_m", 0.5},
          {"links",
           {{"proximal_length_m", length},
            {"distal_length_m", length},
            {"thickness_m", thickness},
            {"width_m", width},
            {"beam", "timoshenko"},
            {"elements", elements}}},
          {"platform", platform},
          {"material", material()},
          {"joints", joints}};
}

Json manipulator(bool modes, Draw& draw) {
  const double length = draw.uniform(0.17, 0.25);
  const double thickness = length * draw.logarithmic(0.003, 0.3);
  const double width = length * draw.logarithmic(0.03, 0.3);
  const bool soft = draw.chance(0.7);
  Json platform = {{"kind", soft ? "triangles" : "rigid"},
                   {"side_m", draw.uniform(0.12, 0.22)},
                   {"thickness_m", width * draw.logarithmic(0.003, 3)}};
  if (soft) platform["refinements"] = 1;
  platform["mass_kg"] = kDensity * thickness * width * length * draw.logarithmic(1e-4, 1e4);
  Json joints = {{"active", joint(draw, "locked", thickness, width, length)},
                 {"elbow", joint(draw, "welded", thickness, width, length)},
                 {"platform", "hinged"}};
  Json model = {{"manipulator", manipulator_of(length, thickness, width, 4, platform, joints)},
                {"pose",
                 {{"x_m", draw.uniform(0.23, 0.27)},
                  {"y_m", draw.uniform(0.125, 0.165)},
                  {"phi_rad", draw.uniform(-0.2, 0.2)}}}};
  if (!modes) {
    model["loads"] = {
        {"P",
         {{"node", "P"},
          {"force_N", draw.direction(bending_load(draw, thickness, width, length))}}}};
    if (draw.chance(0.5)) model["gravity_m_s2"] = draw.direction(draw.logarithmic(0.001, 10));
  }
  return model;
}

Json member(const char* from, const char* to) {
  return {{"nodes", {from, to}}, {"section", "s"}, {"beam", "timoshenko"}};
}
/// @param joint  at its first node
Json member(const char* from, const char* to, const Json& joint) {
  Json jointed = member(from, to);
  jointed["ends"] = {joint, "welded"};
  return jointed;
}

/// Members of one section; clamped at A.
Json frame(double thickness, double width, int elements, const Json& nodes) {
  return {{"materials", {{"alloy", material()}}},
          {"sections",
           {{"s",
             {{"material", "alloy"},
              {"rectangle", {{"thickness_m", thickness}, {"width_m", width}}}}}}},
          {"elements", elements},
          {"nodes", nodes},
          {"members", Json::object()},
          {"supports", {{"A", {"x", "y", "rotation"}}}}};
}

/// A lump at a node, and where there are loads a force there and gravity.
/// @param mass  of the frame
void add_lump_and_loads(Json& model, bool modes, const std::string& node, double mass,
                        double thickness, double width, double length, Draw& draw) {
  if (modes || draw.chance(0.5)) {
    model["point_masses"] = {
        {"lump", {{"node", node}, {"mass_kg", mass * draw.logarithmic(1e-4, 1e4)}}}};
  }
  const double load = bending_load(draw, thickness, width, length);
  if (modes) return;
  model["loads"] = {{"force", {{"node", node}, {"force_N", draw.direction(load)}}}};
  if (draw.chance(0.5)) {
    model["gravity_m_s2"] = draw.direction(draw.logarithmic(1e-4, 1) * load / mass);
  }
}

/// A beam: a cantilever, or clamped at both ends, with a lump on it.
Json beam(bool modes, Draw& draw) {
  const double length = draw.logarithmic(0.2, 5);
  const double thickness = length * draw.logarithmic(0.002, 0.3);
  const double width = thickness * draw.logarithmic(0.5, 5);
  const bool clamped = draw.chance(0.4);
  Json model = frame(thickness, width, 8, {{"A", {0, 0}}, {"B", {length, 0}}});
  const Json root = joint(draw, "welded", thickness, width, length);
  if (clamped) {
    model["nodes"]["C"] = {length * draw.uniform(0.3, 0.7), 0};
    model["members"]["AC"] = member("A", "C", root);
    model["members"]["CB"] = member("C", "B");
    model["supports"]["B"] = {"x", "y", "rotation"};
  } else {
    model["members"]["AB"] = member("A", "B", root);
  }
  add_lump_and_loads(model, modes, clamped ? "C" : "B", kDensity * thickness * width * length,
                     thickness, width, length, draw);
  return model;
}

Json portal(bool modes, Draw& draw) {
  const double height = draw.uniform(0.5, 2), span = draw.uniform(0.5, 3);
  const double thickness = height * draw.logarithmic(0.003, 0.2);
  const double width = thickness * draw.logarithmic(0.5, 3);
  Json model = frame(thickness, width, 4,
                     {{"A", {0, 0}}, {"B", {0, height}}, {"C", {span, height}}, {"D", {span, 0}}});
  model["supports"]["D"] = {"x", "y", "rotation"};
  model["members"]["AB"] = member("A", "B", joint(draw, "welded", thickness, width, height));
  model["members"]["BC"] = member("B", "C", joint(draw, "welded", thickness, width, height));
  model["members"]["DC"] = member("D", "C", joint(draw, "welded", thickness, width, height));
  add_lump_and_loads(model, modes, "B", kDensity * thickness * width * (2 * height + span),
                     thickness, width, height, draw);
  return model;
}

/// A column or a tie, clamped at its foot, its head free or guided: up to 0.99 of its buckling load
/// and back, and as far in tension.
Json column(bool modes, Draw& draw) {
  const double length = draw.logarithmic(0.2, 5);
  const double thickness = length * draw.logarithmic(0.002, 0.05);
  const double width = thickness * draw.logarithmic(0.5, 5);
  const bool guided = draw.chance(0.3);
  const double bending = kE * width * std::pow(thickness, 3) / 12;
  const double effective = guided ? length : 2 * length;
  const double buckling = std::pow(std::numbers::pi / effective, 2) * bending;
  const double share = 1 - draw.logarithmic(0.01, 1);
  Json model = frame(thickness, width, 8, {{"A", {0, 0}}, {"B", {length, 0}}});
  model["members"]["AB"] = member("A", "B");
  if (guided) model["supports"]["B"] = {"rotation"};
  const double across = modes ? 0 : draw.logarithmic(1e-5, 0.1) * bending / (length * length);
  model["loads"] = {
      {"head",
       {{"node", "B"}, {"force_N", {(draw.chance(0.7) ? -share : share) * buckling, across}}}}};
  return model;
}

/// A manipulator along a path that comes to within a thousandth to a tenth of a singularity, of a
/// limb that is stretched out or of distal links that meet in P.
Json near_singular(Draw& draw) {
  const double length = draw.uniform(0.18, 0.22);
  const double thickness = length * draw.logarithmic(0.004, 0.1);
  const double width = length * draw.logarithmic(0.05, 0.3);
  const double side = draw.uniform(0.15, 0.22), near = draw.logarithmic(1e-3, 0.1);
  constexpr double kBase = 0.5;
  constexpr int kPoints = 13;
  const double arm = side / std::numbers::sqrt3, centre = kBase / std::numbers::sqrt3;
  const Json platform = {{"kind", "rigid"}, {"side_m", side}, {"thickness_m", width}};
  const Json joints = {{"active", joint(draw, "locked", thickness, width, length)},
                       {"elbow", draw.chance(0.5) ? "welded" : "hinged"},
                       {"platform", "hinged"}};
  Json model = {{"manipulator", manipulator_of(length, thickness, width, 4, platform, joints)}};
  const int nearest = static_cast<int>(draw.uniform(1, kPoints - 1));
  const auto pose = [&](double from_A1, double phi) {
    return Json{{"x_m", from_A1 * std::cos(std::numbers::pi / 6)},
                {"y_m", from_A1 * std::sin(std::numbers::pi / 6)},
                {"phi_rad", phi}};
  };
  const auto load = [&] {
    return draw.direction(bending_load(draw, thickness, width, length) * draw.logarithmic(1e-3, 1));
  };
  model["loads"] = {{"P", {{"node", "P"}, {"force_N", load()}}}};
  if (draw.chance(0.5)) {  // out along the first limb and back
    const double reach = 2 * length * (1 - near) + arm;
    const double radius = (reach - centre) / 2;
    const Json middle = pose(centre + radius, 0);
    model["trajectory"] = {{"circle",
                            {{"center_m", {middle["x_m"], middle["y_m"]}},
                             {"radius_m", radius},
                             {"points", kPoints},
                             {"step_s", 2 * std::numbers::pi / 12},
                             {"phi_rad", 0}}}};
    return model;
  }
  const double out = arm + length;
  const double singular =
      std::acos((centre * centre + out * out - length * length) / (2 * centre * out));
  const double sign = draw.chance(0.5) ? 1 : -1;
  const double step = 0.25 / kPoints, at = sign * singular + near;
  model["trajectory"] = {{"line",
                          {{"from", pose(centre, at - nearest * step)},
                           {"to", pose(centre, at + (kPoints - 1 - nearest) * step)},
                           {"duration_s", 1},
                           {"points", kPoints},
                           {"step_s", 1.0 / (kPoints - 1)}}}};
  return model;
}

/// A manipulator that swings as it follows a circle, slow or fast, damped or not.
Json moving_manipulator(Draw& draw, Json& scene) {
  const double length = draw.uniform(0.18, 0.22);
  const double thickness = length * draw.logarithmic(0.004, 0.1);
  const double width = length * draw.logarithmic(0.05, 0.3);
  const bool soft = draw.chance(0.5);
  Json platform = {{"kind", soft ? "triangles" : "rigid"},
                   {"side_m", 0.2},
                   {"thickness_m", width * draw.logarithmic(0.003, 1)}};
  platform["mass_kg"] = kDensity * thickness * width * length * draw.logarithmic(0.1, 1e3);
  constexpr int kPoints = 33;
  const double speed = draw.logarithmic(0.3, 60);
  const double step = 2 * std::numbers::pi / speed / (kPoints - 1);
  const Json joints = {{"active", joint(draw, "locked", thickness, width, length)},
                       {"elbow", draw.chance(0.5) ? "welded" : "hinged"},
                       {"platform", "hinged"}};
  Json model = {{"manipulator", manipulator_of(length, thickness, width, 2, platform, joints)},
                {"trajectory",
                 {{"circle",
                   {{"center_m", {0.25, 0.144}},
                    {"radius_m", draw.logarithmic(0.002, 0.015)},
                    {"points", kPoints},
                    {"step_s", step},
                    {"angular_speed_rad_s", speed},
                    {"phi_rad", 0}}}}}};
  if (draw.chance(0.6)) {
    const double load = 0.1 * bending_load(draw, thickness, width, length);
    model["loads"] = {{"P", {{"node", "P"}, {"force_N", draw.direction(load)}}}};
  }
  if (draw.chance(0.3)) model["gravity_m_s2"] = {0, -draw.logarithmic(0.01, 10)};
  Json motion = {{"scheme", {{"generalized-alpha", {{"spectral_radius", 0.8}}}}},
                 {"step_s", step / 16},
                 {"initial_state", draw.chance(0.75) ? "quasi-static" : "at-rest"}};
  if (draw.chance(0.75)) {
    motion["damping"] = {{"mass_per_s", draw.logarithmic(1e-3, 1)},
                         {"stiffness_s", draw.logarithmic(1e-6, 3e-3)}};
  }
  scene["analysis"] = {{"elastodynamics", motion}};
  return model;
}

/// A link that spins about its root, with a lump at its end.
Json spinning_link(Draw& draw, Json& scene) {
  const double length = draw.logarithmic(0.1, 1);
  const double thickness = length * draw.logarithmic(0.003, 0.2);
  const double width = thickness * draw.logarithmic(0.5, 10);
  const double own = 3.516 * thickness / (length * length) * std::sqrt(kE / (12 * kDensity));
  const double mass = kDensity * thickness * width * length;
  const double hub = length * draw.uniform(0, 1);
  scene["analysis"] = {
      {"modes",
       {{"count", draw.chance(0.5) ? 1 : 3},
        {"rotating", {{"angular_speed_rad_s", own * draw.logarithmic(0.003, 0.6)}}}}}};
  Json model = frame(thickness, width, 8, {{"A", {hub, 0}}, {"B", {hub + length, 0}}});
  model["members"]["AB"] = member("A", "B", joint(draw, "welded", thickness, width, length));
  model["point_masses"] = {
      {"lump", {{"node", "B"}, {"mass_kg", mass * draw.logarithmic(0.01, 1e3)}}}};
  return model;
}

/// The response of a scene of modes to a force, from far below the first frequency of its bare beam
/// or link to beyond it, damped or not.
Json harmonic(Draw& draw, const std::string& kind, Json& model) {
  const bool links = model.contains("manipulator");
  const Json& links_of =
      links ? model["manipulator"]["links"] : model["sections"]["s"]["rectangle"];
  const double thickness = links_of["thickness_m"];
  const Json& nodes = links ? Json() : model["nodes"];
  const double length = links              ? links_of["proximal_length_m"].get<double>()
                        : kind == "portal" ? nodes["B"][1].get<double>()
                                           : nodes["B"][0].get<double>();
  const std::string node = links                                              ? "P"
                           : model["nodes"].contains("C") && kind != "portal" ? "C"
                                                                              : "B";
  const std::string member = links ? "A1-B1" : node == "C" ? "AC" : "AB";
  const double omega = 3.516 * thickness / (length * length) * std::sqrt(kE / (12 * kDensity));
  const double highest = omega / (2 * std::numbers::pi) * draw.logarithmic(0.03, 3);
  model["loads"] = {{"force", {{"node", node}, {"force_N", draw.direction(1)}}}};
  Json response = {{"from_Hz", 0.02 * highest},
                   {"to_Hz", highest},
                   {"points", 41},
                   {"outputs",
                    {"displacement_x_m:" + node, "displacement_y_m:" + node,
                     "bending_moment_N_m:" + member + ".start", "stress_Pa:" + member}}};
  if (draw.chance(0.7)) {
    const double ratio = draw.logarithmic(1e-4, 0.3);
    response["damping"] = {{"rayleigh", {{"stiffness_s", 2 * ratio / omega}}}};
  }
  return {{"harmonic", response}};
}

/// So that neighbours have nothing in common.
constexpr std::uint64_t kSpread = 0x9E3779B97F4A7C15;

Document written(const std::string& name, const Json& scene) {
  Document document;
  document.apply_patch(name, "", scene);
  document.validate("case");
  return document;
}

/// How near the results must come: from a tenth to a ten-thousandth, half of the time a hundredth.
Json effects(Draw& draw) {
  return {{"auto", {{"tolerance", draw.chance(0.5) ? 0.01 : draw.logarithmic(1e-4, 0.1)}}}};
}

}  // namespace

Document random_scene(std::uint64_t seed, std::uint64_t n) {
  Draw draw((seed + 1) * kSpread + n);
  const std::string name = "random-" + std::to_string(seed) + "-" + std::to_string(n);
  const std::uint64_t turn = n % 10;
  Json scene = {{"id", name}, {"effects", effects(draw)}};
  if (turn == 9) {
    const bool spins = draw.chance(0.1);
    scene["title"] = spins ? "spinning link" : "manipulator in motion";
    scene["model"] = spins ? spinning_link(draw, scene) : moving_manipulator(draw, scene);
    return written(name, scene);
  }
  const bool modes = turn >= 5, vibrates = turn == 8;
  const double kind = vibrates ? draw.uniform(0, 0.65) : draw.uniform(0, 1);
  const bool path = !modes && kind >= 0.8;
  const std::string part = path          ? "path near a singularity"
                           : kind < 0.35 ? "manipulator"
                           : kind < 0.5  ? "beam"
                           : kind < 0.65 ? "portal"
                                         : "column";
  scene["title"] = part + (vibrates ? ", harmonic" : modes ? ", modes" : ", statics");
  Json& model = scene["model"];
  model = path          ? near_singular(draw)
          : kind < 0.35 ? manipulator(modes, draw)
          : kind < 0.5  ? beam(modes, draw)
          : kind < 0.65 ? portal(modes, draw)
                        : column(modes, draw);
  scene["analysis"] = vibrates ? harmonic(draw, part, model) : analysis(modes, draw);
  return written(name, scene);
}

}  // namespace trammel::harness
