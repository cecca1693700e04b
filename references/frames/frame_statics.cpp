#include <algorithm>
#include <string>

#include "references/frames/frame_coordinates.h"
#include "references/frames/programs.h"
#include "references/frames/unit_load.h"

/// Exact statics of a frame (`unit_load_statics`) by the names of its outputs.
namespace trammel::references {

namespace {

[[noreturn]] void fail(const std::string& output, const std::string& problem) {
  throw DerivationError("/outputs: '" + output + "'" + problem);
}

struct Name {
  std::string quantity, item, end;
};

/// "reaction_x_N:A" or "axial_force_N:AB.start" in its parts.
Name split(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) fail(text, " names no item");
  Name name{text.substr(0, colon), text.substr(colon + 1), ""};
  for (const char* end : {".start", ".end"}) {
    const std::size_t at = name.item.rfind(end);
    if (at != std::string::npos && at + std::string(end).size() == name.item.size()) {
      name.end = end + 1;
      name.item.erase(at);
      break;
    }
  }
  return name;
}

class Outputs {
 public:
  explicit Outputs(const Frame& frame)
      : frame_(frame), coordinates_(frame, false), statics_(unit_load_statics(frame)) {}

  [[nodiscard]] Real value(const std::string& text) const {
    if (text == "strain_energy_J") return work_of_loads() / 2;
    if (text == "load_work_J") return work_of_loads();
    const Name name = split(text);
    if (name.quantity == "stress_Pa") return largest_stress(text, name);
    if (!name.end.empty()) return member_output(text, name);
    const int node = frame_.find_node(name.item);
    if (node < 0) fail(text, ": there is no such node");
    static const std::array<const char*, 3> displacements = {"displacement_x_m", "displacement_y_m",
                                                             "rotation_rad"};
    static const std::array<const char*, 3> reactions = {"reaction_x_N", "reaction_y_N",
                                                         "reaction_moment_N_m"};
    if (name.quantity == "deflection_m") {
      const Real x = statics_.displacement[coordinate(text, node, 0)];
      const Real y = statics_.displacement[coordinate(text, node, 1)];
      return sqrt(x * x + y * y);
    }
    for (int motion = 0; motion < 3; ++motion) {
      if (name.quantity == displacements[motion])
        return statics_.displacement[coordinate(text, node, motion)];
      if (name.quantity == reactions[motion]) return reaction(text, node, motion);
    }
    fail(text, ": there is no such quantity");
  }

 private:
  /// Returns a force or moment on a node.
  [[nodiscard]] Real work_of_loads() const {
    Real work = 0;
    for (const FrameLoad& load : frame_.loads)
      for (int motion = 0; motion < 3; ++motion)
        if (load.force[motion] != 0)
          work += load.force[motion] *
                  statics_.displacement[coordinate("strain_energy_J", load.node, motion)];
    return work;
  }

  [[nodiscard]] int coordinate(const std::string& text, int node, int motion) const {
    const int index = coordinates_.node_index(node, motion);
    if (index < 0) fail(text, ": this node has no rotation");
    return index;
  }

  [[nodiscard]] Real reaction(const std::string& text, int node, int motion) const {
    for (const FrameBody& body : frame_.bodies) {
      if (body.reference == node || std::ranges::find(body.attached, node) != body.attached.end()) {
        fail(text, ": this node belongs to a rigid body");
      }
    }
    return -statics_.residual_force[coordinate(text, node, motion)];
  }

  [[nodiscard]] Real member_output(const std::string& text, const Name& name) const {
    const int member = frame_.find_member(name.item);
    if (member < 0) fail(text, ": there is no such member");
    const int end = name.end == "start" ? 0 : 1;
    if (name.quantity == "axial_force_N") return statics_.members[member].N[end];
    if (name.quantity == "shear_force_N") return statics_.members[member].V[end];
    if (name.quantity == "bending_moment_N_m") return statics_.members[member].M[end];
    if (name.quantity == "end_rotation_rad") {
      return statics_.displacement[coordinates_.end_index(member, end)];
    }
    fail(text, ": there is no such quantity");
  }

  /// |N|/A + |M|/W of a member without a distributed load; the largest value is at an end.
  [[nodiscard]] Real largest_stress(const std::string& text, const Name& name) const {
    const int index = frame_.find_member(name.item);
    if (index < 0) fail(text, ": there is no such member");
    const FrameMember& member = frame_.members[index];
    if (member.section.modulus == 0 || member.load[0] != 0 || member.load[1] != 0)
      fail(text, ": no depth is known, or it is loaded");
    const MemberForces& forces = statics_.members[index];
    const auto stress = [&](int end) {
      return Real(abs(forces.N[end]) / member.section.area +
                  abs(forces.M[end]) / member.section.modulus);
    };
    return std::max(stress(0), stress(1));
  }

  const Frame& frame_;
  FrameCoordinates coordinates_;
  FrameStatics statics_;
};

}  // namespace

std::vector<Real> frame_statics_program(const Arguments& arguments) {
  const Frame frame = frame_from_arguments(arguments);
  const Outputs outputs(frame);
  std::vector<Real> values;
  for (const std::string& name : arguments.texts("outputs")) {
    values.push_back(outputs.value(name));
  }
  return values;
}

}  // namespace trammel::references
