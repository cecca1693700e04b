// ctest: labels=program timeout=600
#include <boost/test/unit_test.hpp>
#include <iostream>
#include <random>
#include <sstream>

#include "harness/base/json_file.h"
#include "harness/cli/command_line.h"
#include "tests/support/harness/support.h"

using namespace trammel;
using namespace trammel::harness;
using testing::Folder;

// Two hundred case files broken by a seeded generator. Those that are invalid by construction are
// all answered with a place; no other crashes or counts as our own fault.

namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

template <class T>
const T& any_of(Random& random, const std::vector<T>& choices) {
  return choices[below(random, choices.size())];
}

/// Whole cases with all that a check, a sweep and a variant can say.
std::vector<Json> sound_cases() {
  Json frame = testing::cantilever();
  frame["analysis"] = {{"modes", {{"count", 2}}}};
  frame["model"]["nodes"]["C"] = {2, 1};
  frame["model"]["members"]["BC"] = {{"nodes", {"B", "C"}}, {"section", "bar"}};
  frame["model"]["point_masses"]["m"] = {{"node", "C"}, {"mass_kg", 2}, {"offset_m", {0.1, 0.2}}};
  frame["model"]["springs"]["k"] = {{"nodes", {"C"}}, {"stiffness_N_per_m", {400, 500}}};
  frame["sweeps"]["refined"] = {
      {"pointers", {"/model/elements"}}, {"values", {1, 2, 4}}, {"theory_order", 4}};
  frame["checks"]["c"] = {{"quantity", "frequency_Hz"},
                          {"role", "verification"},
                          {"bound", {{"at_least", 0}, {"why", "w"}}}};
  frame["variants"]["v"] = {{"title", "V"}, {"model", {{"elements", 2}}}};
  Json robot = testing::manipulator();
  robot["model"]["manipulator"]["platform"]["kind"] = "triangles";
  Json statics = testing::manipulator();
  statics["analysis"] = {{"statics", Json::object()}};
  statics["model"].erase("pose");
  statics["model"]["trajectory"]["circle"] = {
      {"center_m", {0.25, 0.144}}, {"radius_m", 0.01}, {"points", 3}, {"step_s", 0.5}};
  Json motion = testing::cantilever();
  motion["analysis"]["transient"] = {
      {"duration_s", 0.01},
      {"step_s", 0.001},
      {"method", {{"newmark", {{"beta", 0.25}, {"gamma", 0.5}}}}},
      {"damping", {{"modal", {{"ratio", 0.02}, {"modes", 3}}}}},
      {"load_history", {{"time_s", {0, 0.002, 0.002}}, {"factor", {0, 1, 0}}}},
      {"initial_state", {{"velocity_m_per_s", {0, 1}}}},
      {"outputs", {"displacement_y_m:B", "bending_moment_N_m:AB.start"}}};
  motion["analysis"].erase("statics");
  Json response = testing::cantilever();
  response["analysis"] = {
      {"harmonic",
       {{"from_Hz", 1},
        {"to_Hz", 40},
        {"points", 5},
        {"damping", {{"rayleigh", {{"mass_per_s", 1}, {"stiffness_s", 0.001}}}}},
        {"outputs", {"stress_Pa:AB"}}}}};
  response["model"]["members"]["AB"]["arc_center_m"] = {1, -3};
  response["model"]["members"]["AB"]["nodes"] = {"B", "A"};
  response["analysis"]["harmonic"]["outputs"] = {"stress_Pa:AB.1"};
  Json rotor = testing::cantilever();
  rotor["analysis"] = {
      {"modes",
       {{"count", 2}, {"rotating", {{"angular_speed_rad_s", {0, 10}}, {"axis", "normal"}}}}}};
  return {frame, robot, statics, motion, response, rotor};
}

std::vector<JsonPointer> places(const Json& json, bool (*wanted)(const Json&)) {
  std::vector<JsonPointer> found;
  const Json flat = json.flatten();
  for (const auto& item : flat.items()) {
    const JsonPointer leaf(item.key());
    if (wanted(json.at(leaf))) found.push_back(leaf);
  }
  return found;
}

bool is_leaf(const Json& value) {
  return value.is_primitive();
}
bool is_number(const Json& value) {
  return value.is_number();
}

/// Keys that no case of these kinds can do without, or that must be above zero.
std::vector<JsonPointer> keys_among(const Json& json, const std::vector<std::string>& names) {
  std::vector<JsonPointer> found;
  for (JsonPointer at : places(json, is_leaf)) {
    for (; !at.empty(); at.pop_back()) {
      const bool known = std::find(names.begin(), names.end(), at.back()) != names.end();
      if (known && std::find(found.begin(), found.end(), at) == found.end()) found.push_back(at);
    }
  }
  return found;
}

void erase(Json& json, const JsonPointer& at) {
  json.at(at.parent_pointer()).erase(at.back());
}

const std::vector<std::string> required = {"id",        "title",
                                           "analysis",  "links",
                                           "material",  "joints",
                                           "platform",  "thickness_m",
                                           "width_m",   "E_Pa",
                                           "rho_kg_m3", "nu",
                                           "kind",      "proximal_length_m",
                                           "x_m",       "y_m",
                                           "phi_rad",   "section",
                                           "mass_kg",   "role",
                                           "quantity",  "why",
                                           "values",    "points",
                                           "center_m",  "radius_m",
                                           "step_s",    "duration_s",
                                           "outputs",   "from_Hz",
                                           "to_Hz",     "angular_speed_rad_s",
                                           "time_s",    "factor",
                                           "ratio",     "velocity_m_per_s",
                                           "beta"};
const std::vector<std::string> positive = {
    "thickness_m", "width_m",  "E_Pa",   "elements", "side_m",
    "count",       "radius_m", "points", "step_s",   "proximal_length_m",
    "duration_s",  "to_Hz",    "modes"};
/// Keys of the format itself; names of nodes and the like may be anything.
const std::vector<std::string> fixed_keys = {
    "id",        "title",    "model",        "analysis", "manipulator", "links",     "platform",
    "material",  "joints",   "thickness_m",  "width_m",  "E_Pa",        "nu",        "elements",
    "materials", "sections", "nodes",        "members",  "supports",    "loads",     "springs",
    "checks",    "sweeps",   "variants",     "pose",     "trajectory",  "circle",    "role",
    "bound",     "pointers", "theory_order", "count",    "force_N",     "rectangle", "transient",
    "harmonic",  "rotating", "damping",      "outputs",  "duration_s"};

/// Text that is invalid by construction, and in what way.
std::string broken(Random& random, Json json, std::string& how) {
  switch (below(random, 6)) {
    case 0: {
      std::vector<JsonPointer> needed;
      for (const JsonPointer& at : keys_among(json, required)) {
        const std::string text = at.to_string();
        const bool optional =
            testing::contains(text, "/variants/") || testing::contains(text, "/joints/") ||
            testing::contains(text, "/platform/mass_kg") ||
            testing::contains(text, "/links/mass") || testing::contains(text, "/harmonic/points");
        if (!optional) needed.push_back(at);
      }
      const JsonPointer at = any_of(random, needed);
      how = "deleted " + at.to_string();
      erase(json, at);
      return json.dump(1);
    }
    case 1: {
      const auto at = any_of(random, places(json, is_leaf));
      how = "retyped " + at.to_string();
      json[at] = true;
      return json.dump(1);
    }
    case 2: {
      auto numbers = keys_among(json, positive);
      numbers.erase(std::remove_if(numbers.begin(), numbers.end(),
                                   [&](const JsonPointer& at) { return !json[at].is_number(); }),
                    numbers.end());
      const JsonPointer at = any_of(random, numbers);
      how = "negated " + at.to_string();
      json[at] = -json[at].get<double>();
      return json.dump(1);
    }
    case 3: {
      const auto at = any_of(random, places(json, is_number));
      how = "NaN at " + at.to_string();
      json[at] = "@";
      std::string text = json.dump(1);
      return text.replace(text.find("\"@\""), 3, "NaN");
    }
    case 4: {
      const auto at = any_of(random, keys_among(json, fixed_keys));
      how = "renamed " + at.to_string();
      const Json value = json[at];
      erase(json, at);
      json.at(at.parent_pointer())[at.back() + "x"] = value;
      return json.dump(1);
    }
    default: {
      const std::string text = json.dump(1);
      const std::size_t length = below(random, text.size());
      how = "cut to " + std::to_string(length) + " bytes";
      return text.substr(0, length);
    }
  }
}

/// Text with random bytes or values, which may be anything.
std::string disturbed(Random& random, Json json, std::string& how) {
  if (below(random, 2) == 0) {
    std::string text = json.dump(1);
    for (std::size_t n = 1 + below(random, 3); n > 0; --n) {
      text[below(random, text.size())] = static_cast<char>(below(random, 256));
    }
    how = "random bytes";
    return text;
  }
  const std::vector<Json> values = {0,
                                    1,
                                    -1,
                                    3,
                                    7,
                                    1e-300,
                                    1e300,
                                    -1e300,
                                    0.5,
                                    5e-324,
                                    1e-9,
                                    1e9,
                                    "hinged",
                                    "x",
                                    nullptr,
                                    Json::array(),
                                    Json::object(),
                                    Json::array({1, 2}),
                                    0.99,
                                    1.7976931348623157e308};
  for (std::size_t n = 1 + below(random, 2); n > 0; --n) {
    const auto at = any_of(random, places(json, is_leaf));
    json[at] = any_of(random, values);
    how += at.to_string() + " = " + json[at].dump() + " ";
  }
  return json.dump(1);
}

struct Answer {
  int status = 0;
  std::string error;
};

/// The program's own entry, with what it says kept.
Answer answer(const Folder& folder, const std::string& text) {
  const auto file = folder.write("x.json", text);
  std::ostringstream out, error;
  auto* const kept_out = std::cout.rdbuf(out.rdbuf());
  auto* const kept_error = std::cerr.rdbuf(error.rdbuf());
  const int status = run_command_line(
      {"run", file.string(), "--jobs", "1", "--out", (folder.path() / "out").string()}, {});
  std::cout.rdbuf(kept_out);
  std::cerr.rdbuf(kept_error);
  return {status, error.str()};
}

Json sound(Random& random) {
  static const std::vector<Json> all = sound_cases();
  Json json = any_of(random, all);
  json["id"] = "x";
  return json;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(broken_cases)

BOOST_AUTO_TEST_CASE(the_cases_to_break_are_sound) {
  const Folder folder;
  for (Json json : sound_cases()) {
    json["id"] = "x";
    const Answer given = answer(folder, json.dump());
    BOOST_TEST(given.status == 0, given.error);
  }
}

BOOST_AUTO_TEST_CASE(a_hundred_invalid_cases_are_answered_with_a_place) {
  Random random(20170204);
  const Folder folder;
  for (int i = 0; i < 100; ++i) {
    std::string how;
    const std::string text = broken(random, sound(random), how);
    const Answer given = answer(folder, text);
    BOOST_TEST(given.status == 2, how);
    const bool has_place = testing::contains(given.error, "x.json: /") ||
                           testing::contains(given.error, "x.json: line ");
    BOOST_TEST(has_place, how << ": " << given.error);
    BOOST_TEST(std::count(given.error.begin(), given.error.end(), '\n') == 1,
               how << ": " << given.error);
  }
}

BOOST_AUTO_TEST_CASE(a_hundred_disturbed_cases_are_run_or_refused) {
  Random random(379631);
  const Folder folder;
  for (int i = 0; i < 100; ++i) {
    std::string how;
    const std::string text = disturbed(random, sound(random), how);
    const Answer given = answer(folder, text);
    BOOST_TEST((given.status >= 0 && given.status <= 2), how << given.error);
  }
}

BOOST_AUTO_TEST_SUITE_END()
