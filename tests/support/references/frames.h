#pragma once

#include <cmath>
#include <string>

#include "references/numerics/arguments.h"
#include "references/programs/program.h"

/// Frames that several tests of the derivations share.
namespace trammel::testing {

using namespace references;

/// One aluminium beam from A(0, 0) to B(1, 0); `supports` and the rest are merged into the model.
inline Json beam_model(const char* patch) {
  Json model = Json::parse(R"({
    "materials": {"aluminium": {"E_Pa": 6.9e10, "rho_kg_m3": 2700, "nu": 0.33}},
    "sections": {"bar": {"material": "aluminium",
                         "rectangle": {"thickness_m": 0.01, "width_m": 0.03}}},
    "nodes": {"A": [0, 0], "B": [1, 0]},
    "members": {"AB": {"nodes": ["A", "B"], "section": "bar"}}})");
  model.merge_patch(Json::parse(patch));
  return model;
}

/// The manipulator of Table 1 with a rigid platform at the centred pose; `patch` is merged in.
inline Json manipulator(const char* patch) {
  Json arguments = Json::parse(R"({
    "manipulator": {
      "base_side_m": 0.5,
      "links": {"proximal_length_m": 0.2, "distal_length_m": 0.2, "thickness_m": 0.0015,
                "width_m": 0.03},
      "platform": {"kind": "rigid", "side_m": 0.2, "thickness_m": 0.0015},
      "material": {"E_Pa": 6.9e10, "rho_kg_m3": 2700, "nu": 0.33},
      "joints": {"active": "locked", "elbow": "welded", "platform": "hinged"}},
    "pose": {"x_m": 0.25, "y_m": 0.14433756729740643, "phi_rad": 0}})");
  arguments.merge_patch(Json::parse(patch));
  return arguments;
}

inline std::vector<double> frequencies(const Json& model, int count) {
  return derive("frame-frequencies", {{"model", model}, {"count", count}});
}

}  // namespace trammel::testing
