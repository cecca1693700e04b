// Invalid arguments of derivations, and the pointer or text that the error message must contain.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <string>

#include "references/programs/program.h"

BOOST_AUTO_TEST_SUITE(refusals)

using namespace trammel::references;

namespace {

struct Refusal {
  const char *program, *arguments, *message;
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
  return out << refusal.program << " " << refusal.arguments;
}

const Refusal kRefusals[] = {
    {"no-such", "{}", "no-such"},
    {"beam-roots", R"({"count": 3})", "/ends: is missing"},
    {"beam-roots", R"({"ends": "clamped-free", "count": 0})",
     "/count: expected a whole number from 1 to 1000"},
    {"beam-roots", R"({"ends": "clamped-free", "count": 3, "mass": 1})", "/mass: no such"},
    {"beam-roots", R"({"ends": "free-free", "count": 3, "tip_mass_ratio": 1})", "/tip_mass"},
    {"rotating-beam-roots", R"({"eta": 50, "hub_ratio": 5, "plane": "flap", "count": 1})",
     "digits"},
    {"frame-frequencies", R"({"count": 1, "pose": {"x_m": 3, "y_m": 0.144, "phi_rad": 0},
      "manipulator": {"base_side_m": 0.5, "links": {"proximal_length_m": 0.2,
      "distal_length_m": 0.2, "thickness_m": 0.0015, "width_m": 0.03},
      "platform": {"kind": "rigid", "side_m": 0.2, "thickness_m": 0.0015},
      "material": {"E_Pa": 6.9e10, "rho_kg_m3": 2700, "nu": 0.33},
      "joints": {"active": "locked", "elbow": "welded", "platform": "hinged"}}})",
     "cannot reach"},
    {"frame-statics", R"({"outputs": ["displacement_y_m:B"], "model": {
      "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800}}, "sections": {"bar": {
      "material": "steel", "rectangle": {"thickness_m": 0.01, "width_m": 0.03}}},
      "nodes": {"A": [0, 0], "B": [1, 0]}, "members": {"AB": {"nodes": ["A", "B"],
      "section": "none"}}}})",
     "/model/members/AB/section: expected the name of a section"},
    {"frame-statics", R"({"outputs": ["displacement_y_m:B"], "model": {
      "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800}}, "sections": {"bar": {
      "material": "steel", "rectangle": {"thickness_m": 0.01, "width_m": 0.03}}},
      "nodes": {"A": [0, 0], "B": [1, 0]}, "supports": {"A": ["x", "y"]},
      "members": {"AB": {"nodes": ["A", "B"], "section": "bar"}},
      "loads": {"tip": {"node": "B", "force_N": [0, 1]}}}})",
     "the frame can move freely"}};

}  // namespace

BOOST_DATA_TEST_CASE(invalid_arguments_are_refused, kRefusals, refusal) {
  std::string message = "accepted";
  try {
    static_cast<void>(derive_values(refusal.program, Json::parse(refusal.arguments)));
  } catch (const DerivationError& error) {
    message = error.what();
  }
  BOOST_TEST(message.find(refusal.message) != std::string::npos, message);
}

BOOST_AUTO_TEST_SUITE_END()
