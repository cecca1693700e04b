#include "harness/analysis/effect_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/model/model.h"

namespace trammel::harness {
namespace {

/// Returns the y component of the vector whose x component has the name `name`; null for other
/// quantities.
const Quantity* find_y_component(const Quantities& all, const std::string& name) {
  const std::size_t place = name.find("_x_");
  if (place == std::string::npos) return nullptr;
  const auto found = all.find(std::string(name).replace(place, 3, "_y_"));
  return found == all.end() ? nullptr : &found->second;
}

/// Returns the magnitudes of a quantity's values. For the x component of a vector, returns the
/// magnitudes of the vector.
std::vector<double> value_magnitudes(const Quantities& all, const std::string& name) {
  std::vector<double> size = all.at(name).values;
  const Quantity* second = find_y_component(all, name);
  for (std::size_t i = 0; i < size.size(); ++i) {
    const bool paired = second && i < second->values.size();
    size[i] = std::hypot(size[i], paired ? second->values[i] : 0);
  }
  return size;
}

}  // namespace

std::string quantity_group(const std::string& quantity) {
  static const std::vector<std::pair<std::string, std::string>> kinds = {
      {"displacement_", "displacement"},
      {"rotation_rad", "rotation"},
      {"end_rotation_rad", "rotation"},
      {"reaction_moment_", "moment"},
      {"reaction_", "force"},
      {"axial_force_", "force"},
      {"shear_force_", "force"},
      {"bending_moment_", "moment"},
      {"stress_", "stress"},
      {"von_mises_stress_", "stress"},
      {"bending_stress_Pa", "stress"},
      {"position_", "position"},
      {"velocity_", "velocity"},
      {"angular_velocity_", "angular velocity"},
      {"acceleration_", "acceleration"},
      {"angle_rad", "rotation"},
      {"drive_force_N", "force"},
      {"drive_torque_N_m", "moment"},
      {"frequency_Hz", "frequency"}};
  for (const auto& [start, kind] : kinds)
    if (quantity.rfind(start, 0) == 0) return kind;
  return "";
}

std::map<std::string, double> change_scales(const Quantities& full, const ModelScales& model) {
  // Lower limit of the scale of a group of quantities, relative to the magnitude that the other
  // groups imply, such as force times length for moments. Without the limit, round-off errors of a
  // group whose values are all zero would count as large changes. Round-off errors are about 1e-11
  // after thousands of steps. Common tolerances are much larger than 1e-7.
  constexpr double kRoundoff = 1e-7;
  std::map<std::string, double> scale;
  for (const auto& [name, quantity] : full) {
    const std::string kind = quantity_group(name);
    if (!kind.empty()) scale[kind] = std::max(scale[kind], max_abs(value_magnitudes(full, name)));
  }
  const auto floor = [&](const char* kind, double size) {
    const auto found = scale.find(kind);
    if (found != scale.end()) found->second = std::max(found->second, kRoundoff * size);
  };
  const auto known = [&](const char* kind, double otherwise) {
    const auto found = scale.find(kind);
    return std::max(found == scale.end() ? 0 : found->second, otherwise);
  };
  const double length = model.length, displacement = known("displacement", model.displacement);
  const double force = known("force", model.force);
  if (!(length > 0)) return scale;
  const double rotation = known("rotation", 0), moment = known("moment", 0);
  floor("displacement", std::max(displacement, rotation * length));
  floor("rotation", displacement / length);
  floor("force", std::max(force, moment / length));
  floor("moment", force * length);
  const double speed = known("velocity", 0), spin = known("angular velocity", 0);
  floor("velocity", spin * length);
  floor("angular velocity", speed / length);
  // The origin of positions is arbitrary, so that changes of positions are relative to the length
  // of the model.
  if (scale.count("position") > 0) scale["position"] = length;
  return scale;
}

double member_length(const solver::Model& model, const solver::Member& member) {
  return (model.nodes[solver::to_size(member.nodes[1])].position -
          model.nodes[solver::to_size(member.nodes[0])].position)
      .norm();
}

ModelScales typical_model_scales(const solver::Model& model) {
  ModelScales scales;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  for (const solver::Node& node : model.nodes)
    center += node.position / static_cast<double>(model.nodes.size());
  for (const solver::Node& node : model.nodes)
    scales.length = std::max(scales.length, 2 * (node.position - center).norm());
  const double length = scales.length;
  double mass = 0, stiffest = 0;
  for (const solver::Member& member : model.members) {
    const double own = member_length(model, member);
    scales.force += member.load.norm() * own;
    mass += member.section.mass_per_length * own;
    stiffest = std::max(stiffest, member.section.EA);
  }
  for (const solver::Plate& plate : model.plates)
    stiffest = std::max(stiffest, plate.material.E * plate.thickness * length);
  for (const solver::PointMass& point : model.masses) mass += point.mass;
  for (const solver::NodalLoad& load : model.loads) {
    scales.force += load.force.head<2>().norm();
    if (length > 0) scales.force += std::abs(load.force[2]) / length;
  }
  for (const solver::EdgeLoad& edge : model.edge_loads) {
    const double thickness = model.plates[solver::to_size(edge.plate)].thickness;
    const double side = (model.nodes[solver::to_size(edge.nodes[1])].position -
                         model.nodes[solver::to_size(edge.nodes[0])].position)
                            .norm();
    scales.force += (edge.traction.norm() + std::abs(edge.normal)) * thickness * side;
  }
  scales.force += mass * model.gravity.norm();
  if (stiffest > 0) scales.displacement = scales.force * length / stiffest;
  return scales;
}

Changes result_changes(const Quantities& full, const Quantities& other, const ModelScales& model) {
  const auto scale = change_scales(full, model);
  Changes changes;
  for (const auto& [kind, by] : scale) changes[kind] = {};
  for (const auto& [name, quantity] : full) {
    const std::string kind = quantity_group(name);
    if (kind.empty()) continue;
    const auto found = other.find(name);
    LargestDifference& largest = changes[kind];
    if (found == other.end()) {  // The model without the effect may have fewer quantities or
                                 // modes.
      if (kind == "frequency") largest.value = std::numeric_limits<double>::infinity();
      continue;
    }
    const auto by = [&, &quantity = quantity, scale = scale.at(kind)](std::size_t i) {
      return kind == "frequency" ? std::abs(quantity.values[i]) : scale;
    };
    LargestDifference change = largest_difference(quantity.values, found->second.values, by);
    const Quantity* second = find_y_component(full, name);
    const Quantity* other_second = find_y_component(other, name);
    const bool is_vector = second && other_second &&
                           quantity.values.size() == found->second.values.size() &&
                           second->values.size() == quantity.values.size() &&
                           other_second->values.size() == quantity.values.size();
    for (std::size_t i = 0; is_vector && i < quantity.values.size(); ++i) {
      const double difference = std::hypot(quantity.values[i] - found->second.values[i],
                                           second->values[i] - other_second->values[i]);
      if (difference > 0 && difference / by(i) > change.value) change = {difference / by(i), i};
    }
    if (change.value > largest.value) largest = change;
  }
  return changes;
}

LargestDifference max_change(const Changes& changes) {
  LargestDifference largest;
  for (const auto& [kind, change] : changes)
    if (change.value > largest.value) largest = change;
  return largest;
}

}  // namespace trammel::harness
