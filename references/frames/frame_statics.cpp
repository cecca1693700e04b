#include "references/frames/frame_statics.h"

#include <algorithm>
#include <string>

#include "references/frames/frame_arguments.h"
#include "references/frames/frame_coordinates.h"
#include "references/frames/unit_load.h"

namespace trammel::references {

namespace {

struct Name {
  std::string quantity, item, end;
};

/// "reaction_x_N:A" or "axial_force_N:AB.start" in its parts.
Name split(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw DerivationError("/outputs: '" + text + "' names no item");
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
    const Name name = split(text);
    if (!name.end.empty()) return member_output(text, name);
    const int node = frame_.find_node(name.item);
    if (node < 0) throw DerivationError("/outputs: '" + text + "': there is no such node");
    static const std::array<const char*, 3> displacements = {"displacement_x_m", "displacement_y_m",
                                                             "rotation_rad"};
    static const std::array<const char*, 3> reactions = {"reaction_x_N", "reaction_y_N",
                                                         "reaction_moment_N_m"};
    for (int motion = 0; motion < 3; ++motion) {
      if (name.quantity == displacements[motion])
        return statics_.displacement[coordinate(text, node, motion)];
      if (name.quantity == reactions[motion]) return reaction(text, node, motion);
    }
    throw DerivationError("/outputs: '" + text + "': there is no such quantity");
  }

 private:
  [[nodiscard]] int coordinate(const std::string& text, int node, int motion) const {
    const int index = coordinates_.node_index(node, motion);
    if (index < 0) throw DerivationError("/outputs: '" + text + "': this node has no rotation");
    return index;
  }

  [[nodiscard]] Real reaction(const std::string& text, int node, int motion) const {
    for (const FrameBody& body : frame_.bodies) {
      if (body.reference == node ||
          std::find(body.attached.begin(), body.attached.end(), node) != body.attached.end()) {
        throw DerivationError("/outputs: '" + text + "': this node belongs to a rigid body");
      }
    }
    return -statics_.residual_force[coordinate(text, node, motion)];
  }

  [[nodiscard]] Real member_output(const std::string& text, const Name& name) const {
    const int member = frame_.find_member(name.item);
    if (member < 0) throw DerivationError("/outputs: '" + text + "': there is no such member");
    const int end = name.end == "start" ? 0 : 1;
    if (name.quantity == "axial_force_N") return statics_.members[member].N[end];
    if (name.quantity == "bending_moment_N_m") return statics_.members[member].M[end];
    if (name.quantity == "end_rotation_rad") {
      return statics_.displacement[coordinates_.end_index(member, end)];
    }
    throw DerivationError("/outputs: '" + text + "': there is no such quantity");
  }

  const Frame& frame_;
  FrameCoordinates coordinates_;
  FrameStatics statics_;
};

}  // namespace

std::vector<double> frame_statics_program(const Json& json) {
  const Arguments arguments(json, "", {"model", "manipulator", "pose", "loads", "outputs"});
  const Frame frame = frame_from_arguments(arguments);
  const Outputs outputs(frame);
  std::vector<double> values;
  for (const std::string& name : arguments.texts("outputs")) {
    values.push_back(static_cast<double>(outputs.value(name)));
  }
  return values;
}

}  // namespace trammel::references
