#include "solver/large_motion/elements/large_motion_model.h"

#include "solver/model/labels.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

void require(bool holds, const std::string& part, const std::string& what) {
  if (!holds) throw ModelError(part + ' ' + what);
}

bool exists(Index node, const Model& model) {
  return node >= 0 && node < static_cast<Index>(model.nodes.size());
}

void require_node(Index node, const Model& model, const std::string& part) {
  require(exists(node, model), part, "names a node that does not exist");
}

void validate_drives(const LargeMotionModel& large_motion, const Model& model) {
  for (std::size_t i = 0; i < large_motion.drives.size(); ++i) {
    const Drive& drive = large_motion.drives[i];
    const std::string part = part_label("drive", drive.name, i);
    require_node(drive.node, model, part);
    if (drive.from != -1) require_node(drive.from, model, part);
    require(drive.direction >= 0 && drive.direction <= 2, part, "has no direction 0, 1 or 2");
    require(static_cast<bool>(drive.law), part, "has no law of motion");
  }
}

void validate_sliders(const LargeMotionModel& large_motion, const Model& model) {
  for (std::size_t i = 0; i < large_motion.sliders.size(); ++i) {
    const Slider& slider = large_motion.sliders[i];
    const std::string part = part_label("slider", slider.name, i);
    require_node(slider.node, model, part);
    if (slider.rail != -1) require_node(slider.rail, model, part);
    require(slider.rail != slider.node, part, "slides along itself");
    require(std::isfinite(slider.direction), part, "has no direction");
  }
}

void validate_line_springs(const LargeMotionModel& large_motion, const Model& model) {
  for (std::size_t i = 0; i < large_motion.line_springs.size(); ++i) {
    const LineSpring& spring = large_motion.line_springs[i];
    const std::string part = part_label("line spring", spring.name, i);
    for (const Index node : spring.nodes) require_node(node, model, part);
    require(std::isfinite(spring.stiffness) && spring.stiffness > 0, part,
            "must have a positive stiffness");
    const Vector2d offset = model.nodes[to_size(spring.nodes[1])].position -
                            model.nodes[to_size(spring.nodes[0])].position;
    require(offset.norm() > 0, part, "joins nodes in one place, so it has no direction");
  }
}

}  // namespace

void validate(const LargeMotionModel& large_motion, const Model& model) {
  validate_drives(large_motion, model);
  for (const Torque& torque : large_motion.torques) {
    require_node(torque.node, model, "a torque");
    require(static_cast<bool>(torque.law), "a torque", "has no law");
  }
  validate_sliders(large_motion, model);
  validate_line_springs(large_motion, model);
  for (const FollowerLoad& load : large_motion.follower_loads) {
    require_node(load.node, model, "a follower load");
    require(load.force.allFinite(), "a follower load", "is not a finite number");
  }
  for (const InitialVelocity& initial : large_motion.initial_velocities) {
    require_node(initial.node, model, "a start velocity");
    require(initial.direction >= 0 && initial.direction <= 2, "a start velocity",
            "has no direction 0, 1 or 2");
    require(std::isfinite(initial.value), "a start velocity", "is not a finite number");
  }
  require(std::isfinite(large_motion.mass_damping) && large_motion.mass_damping >= 0,
          "mass damping", "must not be negative");
  require(std::isfinite(large_motion.strain_rate_damping) && large_motion.strain_rate_damping >= 0,
          "strain-rate damping", "must not be negative");
}

}  // namespace trammel::solver::large_motion
