#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "harness/base/errors.h"
#include "harness/base/json.h"
#include "harness/base/json_file.h"
#include "harness/input/case.h"

namespace trammel::testing {

using namespace harness;

/// Returns the path of the program under test. The environment variable TRAMMEL_PROGRAM can name
/// another program, such as that of tests/mutation.
inline std::string trammel_program() {
  const char* other = std::getenv("TRAMMEL_PROGRAM");
  return other != nullptr ? other : TRAMMEL_PROGRAM;
}

/// Temporary folder that is deleted at the end of its scope.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("trammel-test-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  /// Writes a case to the file <id>.json.
  [[nodiscard]] std::filesystem::path write(const Json& json) const {
    return write(json.at("id").get<std::string>() + ".json", json.dump(1));
  }
  /// Adds a reference with one value to references.json.
  void write_reference(const std::string& id, const char* unit, double value,
                       const Json& uncertainty, const char* kind = "paper") const {
    write_reference({{"id", id},
                     {"title", id},
                     {"kind", kind},
                     {"unit", unit},
                     {"source", "me"},
                     {"values", {value}},
                     {"uncertainty", uncertainty},
                     {"place", "here"}});
  }
  /// Adds a reference to references.json, which is next to the cases.
  void write_reference(Json reference) const {
    const std::filesystem::path file = path_ / "references.json";
    Json family = std::filesystem::exists(file) ? harness::read_json(file) : Json::object();
    const auto id = reference.at("id").get<std::string>();
    reference.erase("id");
    family[id] = std::move(reference);
    (void)write("references.json", family.dump(1));
  }

 private:
  std::filesystem::path path_;
};

/// Returns the message of the InputError that `work` throws, or an empty text.
template <class Work>
std::string input_error_message(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Returns a steel cantilever of 2 m along x, 0.1 m deep and 0.05 m wide, with a transverse force
/// of 100 N at its tip.
inline Json cantilever() {
  return Json::parse(R"({
    "id": "cantilever", "title": "Cantilever with a force at its tip",
    "model": {
      "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}},
      "sections": {"bar": {"material": "steel", "rectangle": {"thickness_m": 0.1, "width_m": 0.05}}},
      "elements": 4,
      "nodes": {"A": [0, 0], "B": [2, 0]},
      "members": {"AB": {"nodes": ["A", "B"], "section": "bar"}},
      "supports": {"A": ["x", "y", "rotation"]},
      "loads": {"tip": {"node": "B", "force_N": [0, 100]}}
    },
    "analysis": {"statics": {}}
  })");
}

/// Returns a motion of the cantilever with ten million time steps, whose computation takes minutes.
inline Json endless() {
  Json json = cantilever();
  json["id"] = "endless";
  json["model"]["elements"] = 40;
  json["analysis"] = Json::parse(R"({"transient": {"duration_s": 1000, "step_s": 1e-4,
    "samples": 10, "outputs": ["displacement_y_m:B"]}})");
  return json;
}

/// Returns a quarter of a ring between the radii 1 m and 2 m. Its straight edges cannot move normal
/// to themselves. A pressure of 0.3 MPa acts on the outer edge.
inline Json quarter_ring() {
  return Json::parse(R"({
    "id": "ring", "title": "A quarter of a ring under pressure",
    "model": {
      "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}},
      "nodes": {"A": [1, 0], "B": [2, 0], "C": [0, 2], "D": [0, 1],
                "M": [1.414213562373095, 1.414213562373095]},
      "edges": {"inner": {"nodes": ["D", "A"], "circle": {"center_m": [0, 0], "radius_m": 1}},
                "outer": {"nodes": ["B", "C"], "circle": {"center_m": [0, 0], "radius_m": 2}},
                "bottom": {"nodes": ["A", "B"]}, "left": {"nodes": ["D", "C"]}},
      "plates": {"ring": {"material": "steel", "thickness_m": 0.01, "element": "six-node",
                          "divisions": 2,
                          "blocks": {"b": {"corners": ["A", "B", "C", "D"], "cells": [1, 2]}}}},
      "supports": {"bottom": ["y"], "left": ["x"]},
      "loads": {"p": {"edge": "outer", "normal_Pa": -3e5}}
    },
    "analysis": {"statics": {}}
  })");
}

/// Returns the manipulator of Table 1 of Varalakshmi and Srinivas (2017), with the platform in the
/// center of the base.
inline Json manipulator() {
  return Json::parse(R"({
    "id": "robot", "title": "A 3-RRR manipulator",
    "model": {
      "manipulator": {
        "base_side_m": 0.5,
        "links": {"proximal_length_m": 0.2, "distal_length_m": 0.2, "thickness_m": 0.0015,
                  "width_m": 0.03, "mass_kg": "from-density", "beam": "euler-bernoulli",
                  "mass_matrix": "consistent", "elements": 2},
        "platform": {"kind": "rigid", "side_m": 0.2, "thickness_m": 0.0015,
                     "mass_kg": "from-density"},
        "material": {"E_Pa": 6.9e10, "rho_kg_m3": 2700, "nu": 0.33},
        "joints": {"active": "locked", "elbow": "welded", "platform": "hinged"},
        "working_mode": [-1, -1, -1]
      },
      "pose": {"x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
      "loads": {"P": {"node": "P", "force_N": [10, 0]}}
    },
    "analysis": {"modes": {"count": 6}}
  })");
}

/// Returns a crank of 1 m, a rod of 2 m and a slider that moves along x.
inline Json slider_crank() {
  return Json::parse(R"({
    "id": "slider-crank", "title": "A slider-crank",
    "model": {
      "materials": {"steel": {"E_Pa": 2e11, "rho_kg_m3": 7800, "nu": 0.3}},
      "sections": {"bar": {"material": "steel", "rectangle": {"thickness_m": 0.1, "width_m": 0.05}}},
      "nodes": {"O": [0, 0], "A": [0, 1], "S": [1.7320508075688772, 0]},
      "members": {
        "crank": {"nodes": ["O", "A"], "section": "bar"},
        "rod": {"nodes": ["A", "S"], "section": "bar", "ends": ["hinged", "hinged"]}
      },
      "supports": {"O": ["x", "y"]},
      "sliders": {"S": {"node": "S", "direction_rad": 0}},
      "loads": {"push": {"node": "S", "force_N": [-1000, 0]}}
    },
    "analysis": {"large-motion": {
      "end_time_s": 1, "step_s": 0.01,
      "drives": {"motor": {"node": "O", "motion": "rotation",
                           "law": {"rest_to_rest": {"travel": 1, "duration_s": 1}}}}
    }}
  })");
}

/// Writes a case into `folder` and reads it.
inline Case read(const Folder& folder, const Json& json) {
  return load_case(folder.write(json));
}

/// Returns the base variant of a case that requires no other files.
inline Document document_of(const Json& json) {
  const Folder folder;
  return patched(read(folder, json), kBaseVariant);
}

}  // namespace trammel::testing
