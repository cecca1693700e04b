#include "tests/support/reports/sample.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace trammel::testing {

namespace {

using Json = nlohmann::ordered_json;
using Point = std::pair<double, double>;
constexpr double pi = 3.14159265358979323846;
constexpr std::size_t kCirclePoints = 631;

Json check(const std::string& name, const std::string& quantity, int index, double computed,
           double expected, const std::string& unit, const std::string& reference,
           const std::string& role, double tolerance, const std::string& why) {
  const double difference = computed / expected - 1;
  return {{"name", name},
          {"quantity", quantity},
          {"index", index},
          {"computed", computed},
          {"expected", expected},
          {"unit", unit},
          {"reference", reference},
          {"role", role},
          {"measure", "relative"},
          {"difference", difference},
          {"tolerance", tolerance},
          {"why", why},
          {"expectation", "agrees"},
          {"verdict", std::abs(difference) <= tolerance ? "pass" : "fail"},
          {"message", ""}};
}

Json discrepancy(Json check, double low, double high, const std::string& why) {
  const double d = check["difference"];
  check["tolerance"] = {low, high};
  check["why"] = why;
  check["expectation"] = "known-discrepancy";
  check["verdict"] = d >= low && d <= high ? "pass" : "fail";
  return check;
}

Json bound(const std::string& name, const std::string& quantity, int index, double computed,
           double most, const std::string& unit, const std::string& why) {
  return {{"name", name},
          {"quantity", quantity},
          {"index", index},
          {"computed", computed},
          {"expected", nullptr},
          {"unit", unit},
          {"reference", ""},
          {"role", "verification"},
          {"measure", "bound"},
          {"difference", computed},
          {"tolerance", {nullptr, most}},
          {"why", why},
          {"expectation", "agrees"},
          {"verdict", computed <= most ? "pass" : "fail"},
          {"message", ""}};
}

Json cost(double wall, int evaluations) {
  return {{"wall_s", wall},
          {"cpu_s", 0.96 * wall},
          {"counters",
           {{"element_evaluations", evaluations},
            {"factorizations", evaluations / 24},
            {"solves", evaluations / 4}}}};
}

Json run(const std::string& case_id, const std::string& variant) {
  return {{"case", case_id},
          {"variant", variant},
          {"status", "solved"},
          {"reason", ""},
          {"quantities", Json::object()},
          {"checks", Json::array()},
          {"convergence", Json::array()},
          {"cost", cost(0.02, 96)}};
}

// ---- beams ----------------------------------------------------------------------------------

/// Error of a beam mode with n elements: (beta h)^4 / 1440, and round-off that grows as n^2.
double beam_error(double beta_length, double elements) {
  return std::pow(beta_length / elements, 4) / 1440 / (1 + std::pow(beta_length / elements, 2));
}

double beam_noise(double elements, int mode) {
  return 3e-16 * elements * elements * (1 + 0.5 * std::cos(7.0 * elements + mode));
}

Json beam_sweep(double beta_length, double exact, int mode) {
  Json sweep = {{"sweep", "elements"}, {"quantity", "frequency_Hz"},
                {"index", mode},       {"reference", "cantilever-frequencies"},
                {"exact", exact},      {"theory_order", 4}};
  double previous = 0, sum = 0;
  int fitted = 0;
  for (double n = mode < 2 ? 1 : 2; n <= 128; n *= 2) {
    const double error = beam_error(beta_length, n) + beam_noise(n, mode);
    const double floor = 1e-15 * n * n;
    const bool inside = beta_length / n <= 1 && error > 100 * floor;
    sweep["parameter"].push_back(n);
    sweep["values"].push_back(exact * (1 + error));
    sweep["error"].push_back(error);
    sweep["roundoff"].push_back(floor);
    sweep["gci"].push_back(1.25 * error);
    sweep["safety_factor"].push_back(1.25);
    sweep["at_roundoff_floor"].push_back(false);
    sweep["in_asymptotic_range"].push_back(inside);
    sweep["order"].push_back(previous > 0 ? Json(std::log2(previous / error)) : Json());
    if (inside && previous > 0) sum += std::log2(previous / error), ++fitted;
    previous = error;
  }
  sweep["fitted_order"] = fitted ? Json(sum / fitted) : Json();
  sweep["richardson"] = exact * (1 + 1e-11);
  return sweep;
}

Json beam_drawing(const std::vector<double>& beta_lengths, const std::vector<double>& frequencies) {
  Json drawing = {{"triangles", Json::array()}, {"shapes", Json::array()}};
  for (int i = 0; i <= 16; ++i) drawing["nodes_m"].push_back({i / 16.0, 0.0});
  for (int i = 0; i < 16; ++i) drawing["members"].push_back({i, i + 1});
  drawing["joints"] = {{{"node", 0}, {"kind", "support"}, {"name", "A"}}};
  for (std::size_t m = 0; m < beta_lengths.size(); ++m) {
    const double b = beta_lengths[m];
    const double s = (std::cosh(b) + std::cos(b)) / (std::sinh(b) + std::sin(b));
    Json shape = {{"label", "mode " + std::to_string(m + 1) + ", " +
                                std::to_string(frequencies[m]).substr(0, 5) + " Hz"}};
    for (int i = 0; i <= 16; ++i) {
      const double x = b * i / 16.0;
      shape["displacement_m"].push_back(
          {0.0, std::cosh(x) - std::cos(x) - s * (std::sinh(x) - std::sin(x))});
    }
    drawing["shapes"].push_back(shape);
  }
  return drawing;
}

void add_beams(Json& results) {
  const std::vector<double> roots = {1.87510406871196, 4.69409113297417, 7.85475743823761,
                                     10.9955407348755, 14.1371683910465, 17.2787595320882};
  std::vector<double> exact;
  for (const double root : roots) exact.push_back(0.8166 * root * root);
  results["references"]["cantilever-frequencies"] = {
      {"title", "Cantilever, modes 1-6, exact"},
      {"kind", "exact"},
      {"unit", "Hz"},
      {"values", exact},
      {"uncertainty", std::vector<double>(6, 1e-14)},
      {"citation", "R. D. Blevins, Formulas for Natural Frequency and Mode Shape, 1979."},
      {"place", "Table 8-1, case 3"},
      {"derivation", "beam-frequencies {\"ends\": \"clamped-free\"}"},
      {"notes", "Roots of 1 + cos x cosh x = 0."}};
  results["references"]["cantilever-printed"] = {{"title", "Cantilever, mode 2, as printed"},
                                                 {"kind", "code"},
                                                 {"unit", "Hz"},
                                                 {"values", {17.9}},
                                                 {"printed", {"17.9"}},
                                                 {"uncertainty", {0.05}},
                                                 {"citation", "A manual."},
                                                 {"place", "p. 1"}};
  results["numerical_uncertainty"] = {{"levels", 126},           {"covered", 125},
                                      {"coverage", 125.0 / 126}, {"min_coverage", 0.95},
                                      {"median_ratio", 1.25},    {"max_median_ratio", 3},
                                      {"min_levels", 100},       {"passes", true}};
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"cantilever", "Cantilever, six modes"},
      {"pinned-pinned", "Pinned-pinned beam, six modes"},
      {"free-free", "Free-free beam <b>&\"quoted\"</b> 'it' `date` {{x}}, six modes"}};
  for (const auto& [id, title] : cases) {
    results["cases"][id] = {{"title", title},
                            {"description",
                             "A uniform Euler-Bernoulli beam with 16 elements & consistent mass, "
                             "refined from 1 to 128 elements. Error of theory: (βh)⁴/1440."},
                            {"family", "beam-modes"},
                            {"labels", {"verification", "element", "modes"}},
                            {"figures", Json::object()},
                            {"variants", {{"base", {{"title", "consistent mass"}}}}}};
    Json beam = run(id, "base");
    for (int mode = 0; mode < 6; ++mode) {
      const double computed = exact[mode] * (1 + beam_error(roots[mode], 16));
      beam["quantities"]["frequency_Hz"].push_back(computed);
      beam["checks"].push_back(check("exact", "frequency_Hz", mode, computed, exact[mode], "Hz",
                                     "cantilever-frequencies", "verification", 1e-3,
                                     "16 elements, error (βh)⁴/1440, 9.4 × 10⁻⁴ in mode 6"));
      beam["convergence"].push_back(beam_sweep(roots[mode], exact[mode], mode));
    }
    if (id == "pinned-pinned") {
      results["cases"][id]["labels"].push_back("benchmark");
      beam["checks"].push_back(
          discrepancy(check("printed", "frequency_Hz", 1, exact[1] * (1 + beam_error(roots[1], 16)),
                            17.9, "Hz", "cantilever-printed", "validation", 0, ""),
                      0.004, 0.006, "chart read"));
    }
    beam["drawing"] = beam_drawing(roots, exact);
    results["runs"].push_back(beam);
  }
}

// ---- the manipulator ------------------------------------------------------------------------

/// An entry after ASME V&V 20.
Json compared(const std::string& name, const std::string& reference, int index, double simulation,
              double expected, double u_val, const std::string& verdict) {
  return {{"check", name},
          {"quantity", "frequency_Hz"},
          {"index", index},
          {"unit", "Hz"},
          {"reference", reference},
          {"simulation", simulation},
          {"expected", expected},
          {"u_num", nullptr},
          {"u_input", nullptr},
          {"u_input_sampled", nullptr},
          {"u_reference", nullptr},
          {"contributions", Json::object()},
          {"spread", Json::array()},
          {"interval", {nullptr, nullptr}},
          {"all_inputs",
           {{"u_input", nullptr},
            {"u_input_sampled", nullptr},
            {"u_val", nullptr},
            {"interval", {nullptr, nullptr}},
            {"verdict", "undecided"},
            {"conclusion", ""}}},
          {"difference", simulation - expected},
          {"u_val", u_val},
          {"dominant_input", "link-thickness"},
          {"dominant_share", 0.987},
          {"verdict", verdict},
          {"conclusion", "the difference & its \"noise\" <b>"}};
}

struct Mechanism {
  std::vector<Point> nodes;
  Json members = Json::array(), triangles = Json::array(), joints = Json::array();
};

Mechanism mechanism(Point centre) {
  Mechanism m;
  const std::array<Point, 3> base = {{{0, 0}, {0.5, 0}, {0.25, 0.433}}};
  const std::array<double, 3> vertex = {210 * pi / 180, 330 * pi / 180, 90 * pi / 180};
  std::vector<int> platform;
  for (int limb = 0; limb < 3; ++limb) {
    const auto [ax, ay] = base[limb];
    const double cx = centre.first + 0.2 / std::sqrt(3) * std::cos(vertex[limb]);
    const double cy = centre.second + 0.2 / std::sqrt(3) * std::sin(vertex[limb]);
    const double d = std::hypot(cx - ax, cy - ay);
    const double angle = std::atan2(cy - ay, cx - ax) - std::acos(d / 0.4);
    const Point elbow = {ax + 0.2 * std::cos(angle), ay + 0.2 * std::sin(angle)};
    const auto line = [&](Point from, Point to, bool with_first) {
      for (int i = with_first ? 0 : 1; i <= 4; ++i) {
        m.nodes.emplace_back(from.first + (to.first - from.first) * i / 4,
                             from.second + (to.second - from.second) * i / 4);
        const int n = static_cast<int>(m.nodes.size());
        if (i > 0) m.members.push_back({n - 2, n - 1});
      }
    };
    const int start = static_cast<int>(m.nodes.size());
    const std::string number = std::to_string(limb + 1);
    line({ax, ay}, elbow, true);
    line(elbow, {cx, cy}, false);
    m.joints.push_back({{"node", start}, {"kind", "active"}, {"name", "A" + number}});
    m.joints.push_back({{"node", start + 4}, {"kind", "welded"}, {"name", "B" + number}});
    m.joints.push_back({{"node", start + 8}, {"kind", "hinged"}, {"name", "C" + number}});
    platform.push_back(start + 8);
  }
  m.nodes.push_back(centre);
  const int p = static_cast<int>(m.nodes.size()) - 1;
  m.joints.push_back({{"node", p}, {"kind", "point"}, {"name", "P"}});
  for (int i = 0; i < 3; ++i) m.triangles.push_back({platform[i], platform[(i + 1) % 3], p});
  return m;
}

Json manipulator_drawing(Point centre, const std::vector<double>& frequencies) {
  const Mechanism m = mechanism(centre);
  Json drawing = {{"nodes_m", m.nodes},
                  {"members", m.members},
                  {"triangles", m.triangles},
                  {"joints", m.joints},
                  {"shapes", Json::array()}};
  for (std::size_t mode = 0; mode < frequencies.size(); ++mode) {
    Json shape = {{"label", "mode " + std::to_string(mode + 1) + ", " +
                                std::to_string(frequencies[mode]).substr(0, 5) + " Hz"}};
    const double k = 1.0 + static_cast<double>(mode);
    for (const auto& [x, y] : m.nodes) {
      const double fade = std::exp(-40 * std::pow(std::hypot(x - 0.25, y - 0.144) - 0.1, 2));
      shape["displacement_m"].push_back(
          {0.01 * fade * std::sin(8 * k * y + mode), 0.01 * fade * std::cos(7 * k * x + mode)});
    }
    drawing["shapes"].push_back(shape);
  }
  return drawing;
}

void add_table_2(Json& results) {
  const std::vector<double> program = {12.768, 15.115, 16.935, 31.888, 44.971, 46.206};
  const std::vector<double> ansys = {13.644, 16.973, 18.631, 38.462, 54.58, 64.514};
  const auto reference = [&](const std::string& row, const std::vector<double>& values) {
    return Json{
        {"title", "Table 2, row \"" + row + "\""},
        {"kind", "paper"},
        {"unit", "Hz"},
        {"values", values},
        {"uncertainty", std::vector<double>(6, 5e-4)},
        {"citation",
         "K. V. Varalakshmi, J. Srinivas, Dynamic Analysis of Flexible-Link Planar Parallel "
         "Manipulator with Platform Rigidity Considerations, American Journal of Mechanical "
         "and Industrial Engineering 2(4), 2017, pp. 174-188."},
        {"doi", "10.11648/j.ajmie.20170204.13"},
        {"place", "Table 2, row '" + row + "'"},
        {"derivation", ""},
        {"errata", row == "ANSYS" ? Json::array({"The printed differences of modes 5 and 6 "
                                                 "(21.853 and 37.46 %) do not follow from "
                                                 "the rows: 21.367 and 39.623 %."})
                                  : Json::array()},
        {"notes", "Neither the pose nor the joints of the model are stated."}};
  };
  results["references"]["table-2-fe-program"] = reference("FE program", program);
  results["references"]["table-2-ansys"] = reference("ANSYS", ansys);

  const std::vector<double> locked = {15.9, 15.9, 35.2, 61.3, 61.3, 70.4};
  const std::array<const char*, 4> elbows = {"welded", "hinged", "sprung", "welded-all"};
  const std::array<const char*, 4> others = {"platform-triangles", "platform-rigid",
                                             "masses-as-printed", "free-actuators"};
  const std::vector<std::pair<std::string, Point>> poses = {{"centred", {0.25, 0.1443}},
                                                            {"start", {0.26, 0.144}}};
  for (const auto& [pose, centre] : poses) {
    const std::string id = "manipulator-modes-" + pose;
    Json variants;
    Json runs = Json::array();
    for (std::size_t e = 0; e < elbows.size(); ++e) {
      for (std::size_t o = 0; o < others.size(); ++o) {
        const std::string variant = e + o == 0 ? "base" : std::string(elbows[e]) + "-" + others[o];
        variants[variant] = {{"title", "elbow " + std::string(elbows[e]) + ", " + others[o]}};
        Json solved = run(id, variant);
        std::vector<double> frequencies;
        for (std::size_t mode = 0; mode < 6; ++mode) {
          const double f = locked[mode] * (1 - 0.11 * static_cast<double>(e)) *
                               (1 - 0.06 * static_cast<double>(o)) +
                           (pose == "start" ? 0.3 * static_cast<double>(mode) : 0);
          frequencies.push_back(f);
          solved["checks"].push_back(discrepancy(
              check("fe-program", "frequency_Hz", static_cast<int>(mode), f, program[mode], "Hz",
                    "table-2-fe-program", "validation", 0, ""),
              -0.75, 1.15,
              "Pose and joints of the printed model are not stated; no reading of them reaches "
              "modes 4 to 6."));
        }
        for (std::size_t mode = 0; mode < 6; ++mode)
          solved["checks"].push_back(discrepancy(
              check("ansys", "frequency_Hz", static_cast<int>(mode), frequencies[mode], ansys[mode],
                    "Hz", "table-2-ansys", "validation", 0, ""),
              -0.7, 1.0, "The row probably holds motion out of the plane in modes 1, 5 and 6."));
        if (o == 0) {
          solved["uncertainty"] = {
              {"inputs", Json::array()}, {"samples", 0},           {"failed", 0},
              {"samples_all_inputs", 0}, {"failed_all_inputs", 0}, {"numerical", Json::array()}};
          solved["uncertainty"]["comparisons"] = {
              compared("ansys", "table-2-ansys", 0, frequencies[0], ansys[0], 0.35, "model-error"),
              compared("ansys", "table-2-ansys", 1, frequencies[1], ansys[1], 9,
                       "within-uncertainty")};
        }
        solved["quantities"]["frequency_Hz"] = frequencies;
        solved["drawing"] = manipulator_drawing(centre, frequencies);
        solved["cost"] = cost(0.004 * static_cast<double>(1 + e + o), 480);
        runs.push_back(solved);
      }
    }
    variants["free-everything"] = {{"title", "free actuators, hinged elbows"}};
    Json singular = run(id, "free-everything");
    singular["status"] = "singular";
    singular["reason"] = "rotation of the platform about the common point of the three limbs";
    singular["checks"].push_back({{"name", "status"},
                                  {"title", "The free mechanism has no stiffness"},
                                  {"quantity", "status"},
                                  {"index", nullptr},
                                  {"computed", nullptr},
                                  {"expected", nullptr},
                                  {"unit", "1"},
                                  {"role", "verification"},
                                  {"measure", "status"},
                                  {"difference", nullptr},
                                  {"tolerance", nullptr},
                                  {"why", "The three limb lines meet in one point."},
                                  {"expectation", "agrees"},
                                  {"verdict", "pass"},
                                  {"message", "singular: rotation of the platform"}});
    runs.push_back(singular);
    results["cases"][id] = {{"title", "Modes 1-6 of the Table 1 manipulator, " + pose + " pose"},
                            {"description",
                             "The model choices that the paper leaves open, each as a variant, in "
                             "ascending order against both rows of Table 2."},
                            {"family", "manipulator-modes"},
                            {"labels", {"manipulator", "modes", "validation"}},
                            {"figures", Json::object()},
                            {"variants", variants}};
    for (const Json& run : runs) results["runs"].push_back(run);
  }
}

// ---- the circle -----------------------------------------------------------------------------

Json circle_run(const std::string& variant, double compliance) {
  Json solved = run("circle-load", variant);
  Json& q = solved["quantities"];
  for (std::size_t i = 0; i < kCirclePoints; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    q["time_s"].push_back(t);
    q["displacement_x_m:P"].push_back(compliance * (0.0123 + 0.0004 * std::cos(t)));
    q["displacement_y_m:P"].push_back(compliance * 0.0007 * std::sin(2 * t));
    for (int limb = 1; limb <= 3; ++limb)
      q["reaction_x_N:A" + std::to_string(limb)].push_back(
          -3.33 + 0.4 * std::cos(t + 2 * pi * limb / 3) * compliance);
    const double residual = 4e-11 * std::abs(std::sin(3 * t));
    q["equilibrium_residual_N"].push_back(residual);
    solved["checks"].push_back(bound("equilibrium", "equilibrium_residual_N", static_cast<int>(i),
                                     residual, 1e-7, "N",
                                     "Round-off of a solve with condition number 10⁸ and 10 N."));
  }
  solved["cost"] = cost(1.6, 15144);
  solved["drawing"] = manipulator_drawing({0.26, 0.144}, {});
  return solved;
}

void add_circle(Json& results) {
  results["cases"]["circle-load"] = {
      {"title", "10 N in x along the circle"},
      {"description", "Quasi-static load at P at each of the 631 points of the circle."},
      {"family", "circle-load"},
      {"labels", {"manipulator", "statics"}},
      {"figures",
       {{"fig-7",
         {{"title", "x displacement of P along the circle (counterpart of Figure 7)"},
          {"x", "time_s"},
          {"y", {"displacement_x_m:P"}},
          {"variants", {"base", "rigid-platform"}},
          {"caption", "The platform's own flexibility hardly counts."}}},
        {"fig-7-y",
         {{"title", "Both displacements of P"},
          {"x", "time_s"},
          {"y", {"displacement_x_m:P", "displacement_y_m:P"}},
          {"variants", {"base"}},
          {"caption", "x exceeds y under a force in x."}}},
        {"fig-8",
         {{"title", "x reactions at the active joints (counterpart of Figure 8)"},
          {"x", "time_s"},
          {"y", {"reaction_x_N:A1", "reaction_x_N:A2", "reaction_x_N:A3"}},
          {"variants", {"base", "rigid-platform"}},
          {"caption", "Reactions are very much close between the two platforms."}}},
        {"fig-missing",
         {{"title", "A figure whose quantity is missing"},
          {"x", "time_s"},
          {"y", {"stress_Pa:A1-B1"}},
          {"variants", {"base"}},
          {"caption", ""}}}}},
      {"variants",
       {{"base", {{"title", "flexible platform"}}},
        {"rigid-platform", {{"title", "rigid platform"}}}}}};
  Json base = circle_run("base", 1);
  Json claim = {{"name", "claim-3"},
                {"quantity", "displacement_x_m:P"},
                {"statistic", "max_abs"},
                {"against_variant", "rigid-platform"},
                {"index", 0},
                {"computed", 1.004},
                {"expected", nullptr},
                {"unit", "1"},
                {"reference", ""},
                {"role", "validation"},
                {"measure", "ratio"},
                {"difference", 1.004},
                {"tolerance", {1.0, 1.1}},
                {"why",
                 "The paper calls the rigid platform's displacements relatively small; ours "
                 "differ by less than one per cent."},
                {"expectation", "known-discrepancy"},
                {"verdict", "pass"},
                {"message", ""}};
  base["checks"].push_back(claim);
  results["runs"].push_back(base);
  results["runs"].push_back(circle_run("rigid-platform", 0.996));
}

// ---- what goes wrong ------------------------------------------------------------------------

void add_audit(Json& results) {
  results["cases"]["table-1-audit"] = {{"title", "Table 1 against itself"},
                                       {"description",
                                        "Masses and inertias that follow from "
                                        "lengths and density."},
                                       {"family", "audit"},
                                       {"labels", {"validation"}},
                                       {"figures", Json::object()},
                                       {"variants", {{"base", {{"title", "as printed"}}}}}};
  results["references"]["table-1"] = {{"title", "Table 1, as printed"},
                                      {"kind", "paper"},
                                      {"unit", "kg"},
                                      {"values", {0.0234, 0.1205}},
                                      {"printed", {"0.0234", "0.1205"}},
                                      {"uncertainty", {5e-5, 5e-5}},
                                      {"citation", "K. V. Varalakshmi, J. Srinivas, 2017."},
                                      {"doi", "10.11648/j.ajmie.20170204.13"},
                                      {"place", "Table 1"}};
  Json audit = run("table-1-audit", "base");
  audit["quantities"]["link_mass_kg"] = {0.0243};
  audit["checks"].push_back(check("link-mass", "link_mass_kg", 0, 0.0243, 0.0234, "kg", "table-1",
                                  "validation", 0.01, "printed to three digits"));
  audit["checks"].push_back(discrepancy(check("platform-mass", "platform_mass_kg", 0, 0.0701,
                                              0.1205, "kg", "table-1", "validation", 0, ""),
                                        -0.43, -0.41,
                                        "A plate of these dimensions weighs 0.0701 kg."));
  Json error = check("inertia", "platform_inertia_kg_m2", 0, 1, 0.000799, "kg_m2", "table-1",
                     "verification", 1e-6, "closed form");
  error["computed"] = nullptr;
  error["difference"] = nullptr;
  error["verdict"] = "error";
  error["message"] = "platform_inertia_kg_m2[0] is not finite";
  audit["checks"].push_back(error);
  Json recorded = check("span", "link_span_m", 0, 0.2, 0.21, "m", "table-1", "validation", 0, "");
  recorded["tolerance"] = nullptr;
  recorded["expectation"] = "none";
  recorded["verdict"] = "recorded";
  audit["checks"].push_back(recorded);
  Json skipped = error;
  skipped["name"] = "later";
  skipped["verdict"] = "not-run";
  skipped["role"] = "regression";
  skipped["message"] = "";
  audit["checks"].push_back(skipped);
  results["runs"].push_back(audit);

  results["cases"]["broken"] = {{"title", "A run that ends with an error"},
                                {"family", "audit"},
                                {"variants", {{"base", {{"title", "base"}}}}}};
  Json broken = run("broken", "base");
  broken["status"] = "error";
  broken["reason"] = "/model/nodes/B: a member of length 0";
  results["runs"].push_back(broken);
}

// ---- what accuracy costs --------------------------------------------------------------------

Json cost_setting(const std::string& curve, double value, double error, double time) {
  const std::string title = curve + ", " + std::to_string(static_cast<int>(value)) + " elements";
  return {{"curve", curve},
          {"curve_title", curve},
          {"title", title},
          {"value", value},
          {"status", "measured"},
          {"reason", ""},
          {"error", {{"max", error}, {"rms", error / 2}, {"mean", error / 3}}},
          {"cpu_s", 1e-3 * time},
          {"relative_time", time},
          {"time",
           {{"cpu_s", {1e-3 * time, 1.1e-3 * time, 0.9e-3 * time}},
            {"relative_low", 0.95 * time},
            {"relative_high", 1.05 * time},
            {"wall_median_s", 1e-3 * time},
            {"runs_per_measurement", 2}}},
          {"counters",
           {{"element_evaluations", static_cast<int>(12 * value)},
            {"factorizations", 2},
            {"solves", 20}}},
          {"pareto_optimal", curve == "sparse"}};
}

Json without_answer(Json setting, const std::string& status, const std::string& reason) {
  setting["status"] = status;
  setting["reason"] = reason;
  setting["pareto_optimal"] = false;
  setting["time"] = nullptr;
  if (status == "failed" || status == "timed-out") setting["error"] = nullptr;
  return setting;
}

void add_cost(Json& results) {
  Json settings = Json::array();
  for (double n = 1; n <= 64; n *= 2) {
    settings.push_back(cost_setting("sparse", n, 0.1 * std::pow(n, -4), 0.5 + n / 4));
  }
  for (double n = 1; n <= 32; n *= 2) {
    settings.push_back(cost_setting("dense", n, 0.1 * std::pow(n, -4), 0.6 + n * n * n / 30));
  }
  settings.push_back(without_answer(cost_setting("dense", 64, 1, 6e4), "timed-out",
                                    "not done after 60 s of processor time"));
  settings.push_back(
      without_answer(cost_setting("dense", 128, 1, 0.3), "failed", "six modes of <three>"));
  Json study = {{"id", "sample-modes"},
                {"family", "modes"},
                {"title", "Frequencies of a sample"},
                {"description", "Made up, with everything that can happen."},
                {"reference_solution", "the exact values"},
                {"scale", "relative to each true value"},
                {"norm", "max"},
                {"baseline", 2},
                {"wall_s", 3.2},
                {"settings", settings},
                {"cheapest", Json::array()},
                {"repeatability",
                 {{"on_both_fronts", 6},
                  {"on_either_front", 7},
                  {"same_cheapest", 4},
                  {"target_errors", 4},
                  {"median_difference", 0.01},
                  {"largest_difference", 0.034}}},
                {"conclusion", "Within 1 %, 'sparse, 2 elements' is cheapest."}};
  const std::vector<std::pair<double, Json>> cheapest = {
      {0.05, 1}, {0.01, 1}, {1e-3, 2}, {1e-6, nullptr}};
  for (const auto& [error, setting] : cheapest)
    study["cheapest"].push_back({{"error", error},
                                 {"setting", setting},
                                 {"tied", error == 0.05 ? Json{0} : Json::array()}});
  results["cost"] = {{"sweep", "quick"},     {"seed", 1},
                     {"repeats", 7},         {"equal_within", 0.05},
                     {"diverged_above", 10}, {"studies", {study}}};
}

// ---- claims, and a table of variants ----------------------------------------------------------

Json claim(const char* id, const char* text, const char* verdict, const char* expected,
           const Json& readings) {
  return {{"id", id},
          {"claim", text},
          {"place", "Abstract"},
          {"verdict", verdict},
          {"expected", expected},
          {"conclusion", "What <b>follows</b> & why."},
          {"undecidable", readings.empty() ? "Nothing is published." : ""},
          {"interpretations", readings}};
}

void add_claims(Json& results) {
  const Json ratio = {
      {"description", "flexible over rigid"},
      {"metric", "ratio"},
      {"unit", "1"},
      {"verdict", "contradicts"},
      {"entries",
       {{{"case", "circle-load"}, {"variant", "base"}, {"name", "claim-3"}, {"value", 1.0001}},
        {{"case", "circle-load"}, {"variant", "base"}, {"name", "claim-3"}, {"value", 1.5}}}}};
  const Json unmeasured = {{"description", "sensitivity"},
                           {"metric", "relative"},
                           {"unit", "1"},
                           {"verdict", "not measured"},
                           {"entries", Json::array()}};
  results["claims"] = {
      {"title", "Three claims"},
      {"as_recorded", false},
      {"claims",
       {claim("3", "Displacements are small.", "contradicted", "confirmed", Json::array({ratio})),
        claim("7", "The sensitivity rises.", "not measured", "confirmed",
              Json::array({unmeasured})),
        claim("10", "It matches.", "cannot be decided", "cannot be decided", Json::array())}}};
  results["cases"]["circle-load"]["tables"] = {
      {"side-by-side",
       {{"title", "Largest displacement & time"},
        {"caption", "What to conclude."},
        {"columns",
         {{"x", {{"title", "x [m]"}, {"quantity", "displacement_x_m:P"}, {"statistic", "max_abs"}}},
          {"none", {{"title", "nothing"}, {"quantity", "no_such_m"}}},
          {"time", {{"title", "one solve"}, {"timing", "solve"}}},
          {"ratio",
           {{"title", "over a guess"}, {"timing", "solve"}, {"over_timing", "guess"}}}}}}}};
  for (Json& run : results["runs"]) {
    if (run["case"] != "circle-load") continue;
    run["cost"]["timings"] = {{"solve", {{"per_evaluation_s", 2e-5}, {"evaluations", 631}}},
                              {"guess", {{"per_evaluation_s", 1e-5}, {"evaluations", 631}}}};
  }
}

}  // namespace

nlohmann::ordered_json sample_results() {
  Json results = {{"format", 1},
                  {"environment",
                   {{"trammel", "0.1.0"},
                    {"commit", "abc1234"},
                    {"date", "2026-01-02T03:04:05Z"},
                    {"compiler", "GNU 12.2.0"},
                    {"flags", "-O3 -DNDEBUG"},
                    {"build_type", "Release"},
                    {"libraries", {{"Eigen", "3.4.0"}, {"Spectra", "1.0.1"}}},
                    {"processor", "x86-64, 2.5 GHz"},
                    {"cores", 2},
                    {"system", "Debian GNU/Linux 12"}}},
                  {"cases", Json::object()},
                  {"references", Json::object()},
                  {"runs", Json::array()}};
  add_table_2(results);
  add_circle(results);
  add_beams(results);
  add_audit(results);
  add_cost(results);
  add_claims(results);
  return results;
}

}  // namespace trammel::testing
