#include "references/frames/frame_arguments.h"

#include "references/frames/frame_json.h"
#include "references/frames/manipulator_design.h"
#include "references/frames/manipulator_frame.h"

namespace trammel::references {

namespace {

void add_loads(const Arguments& arguments, Frame& frame) {
  if (!arguments.has("loads")) return;
  const Arguments loads(arguments["loads"], "/loads");
  for (const std::string& name : loads.keys()) {
    const Arguments load = loads.object(name, {"node", "force_N", "moment_N_m"});
    const int node = frame.find_node(load.text("node"));
    if (node < 0) load.fail("node", "expected the name of a node");
    const auto force = load.point_or_origin("force_N");
    frame.loads.push_back({node, {force[0], force[1], load.number("moment_N_m", 0)}});
  }
}

}  // namespace

Frame frame_from_arguments(const Arguments& arguments) {
  if (arguments.has("model")) {
    for (const char* key : {"manipulator", "pose", "loads", "gravity_m_s2"}) {
      if (arguments.has(key)) arguments.fail(key, "does not go with a model");
    }
    return read_frame(arguments["model"], "/model");
  }
  const Arguments pose = arguments.object("pose", {"x_m", "y_m", "phi_rad"});
  Frame frame = manipulator_frame(manipulator_arguments(arguments), pose);
  add_loads(arguments, frame);
  if (arguments.has("gravity_m_s2")) frame.gravity = arguments.point("gravity_m_s2");
  return frame;
}

}  // namespace trammel::references
