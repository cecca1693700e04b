#include <algorithm>
#include <map>

#include "references/frames/manipulator_design.h"

namespace trammel::references {

namespace {

using Sections = std::map<std::string, FrameSection>;

Arguments object_at_key(const Arguments& parent, const std::string& key) {
  return {parent.has(key) ? parent[key] : Json::object(), parent.pointer(key)};
}

/// Returns the objects in the JSON object parent[key], each with its name.
std::vector<std::pair<std::string, Arguments>> objects_of(const Arguments& parent,
                                                          const std::string& key,
                                                          const std::vector<std::string>& known) {
  const Arguments all = object_at_key(parent, key);
  std::vector<std::pair<std::string, Arguments>> objects;
  for (const std::string& name : all.keys()) objects.emplace_back(name, all.object(name, known));
  return objects;
}

FrameSection read_section(const Arguments& materials, const Arguments& section) {
  const std::string name = section.text("material");
  if (!materials.has(name)) section.fail("material", "there is no material '" + name + "'");
  const FrameMaterial material = read_material(materials, name);
  const Real shear_coefficient = section.number("shear_coefficient", Real(5) / 6);
  if (section.has("rectangle")) {
    const Arguments r = section.object("rectangle", {"thickness_m", "width_m"});
    return rectangular_section(material, r.positive("thickness_m"), r.positive("width_m"),
                               shear_coefficient);
  }
  if (section.has("circle")) {
    const Real diameter = section.object("circle", {"diameter_m"}).positive("diameter_m");
    const Real area = pi<Real>() * diameter * diameter / 4;
    return timoshenko_section(material, area, area * diameter * diameter / 16, diameter / 2,
                              shear_coefficient);
  }
  return timoshenko_section(material, section.positive("area_m2"),
                            section.positive("second_moment_m4"), section.number("half_depth_m", 0),
                            shear_coefficient);
}

Sections read_sections(const Arguments& model) {
  const Arguments materials = object_at_key(model, "materials");
  Sections result;
  for (const auto& [name, section] :
       objects_of(model, "sections",
                  {"material", "rectangle", "circle", "area_m2", "second_moment_m4", "half_depth_m",
                   "shear_coefficient"}))
    result[name] = read_section(materials, section);
  return result;
}

/// Returns the indices of the nodes that object[key] names, as one name or a list of names.
std::vector<int> nodes_named_by_key(const Frame& frame, const Arguments& object,
                                    const std::string& key) {
  const Json& names = object[key];
  std::vector<int> nodes;
  for (const Json& name : names.is_array() ? names : Json::array({names})) {
    nodes.push_back(name.is_string() ? frame.find_node(name.get<std::string>()) : -1);
    if (nodes.back() < 0) object.fail(key, "expected the name of a node");
  }
  return nodes;
}

FrameMember read_member(const Frame& frame, const Sections& sections, const std::string& name,
                        const Arguments& object) {
  FrameMember member;
  member.name = name;
  const std::vector<int> nodes = nodes_named_by_key(frame, object, "nodes");
  if (nodes.size() != 2) object.fail("nodes", "expected two names of nodes");
  member.nodes = {nodes[0], nodes[1]};
  const auto section = sections.find(object.text("section"));
  if (section == sections.end()) object.fail("section", "expected the name of a section");
  member.section = section_for_beam_theory(section->second, object);
  member.section.tension = object.number("axial_force_N", 0);
  if (member.section.shear_compliance > 0 && member.section.tension != 0)
    object.fail("axial_force_N", "requires an Euler-Bernoulli member");
  if (object.has("ends")) {
    const Json& ends = object["ends"];
    if (!ends.is_array() || ends.size() != 2) object.fail("ends", "expected two ends");
    for (std::size_t i = 0; i < 2; ++i) member.ends[i] = read_end_fixity(ends[i], object, "ends");
  }
  member.load = object.point_or_origin("load_N_per_m");
  return member;
}

void read_nodes(const Arguments& model, Frame& frame) {
  const Arguments nodes(model["nodes"], model.pointer("nodes"));
  for (const std::string& name : nodes.keys()) frame.nodes.push_back({name, nodes.point(name)});
}

void read_members(const Arguments& model, Frame& frame) {
  const Sections sections = read_sections(model);
  for (const auto& [name, object] :
       objects_of(model, "members",
                  {"nodes", "section", "beam", "axial", "ends", "load_N_per_m", "axial_force_N",
                   "elements", "mass_matrix"}))
    frame.members.push_back(read_member(frame, sections, name, object));
}

void read_bodies(const Arguments& model, Frame& frame) {
  for (const auto& [name, object] : objects_of(model, "rigid_bodies", {"reference", "nodes"}))
    frame.bodies.push_back({nodes_named_by_key(frame, object, "reference")[0],
                            nodes_named_by_key(frame, object, "nodes")});
}

void read_masses(const Arguments& model, Frame& frame) {
  for (const auto& [name, object] :
       objects_of(model, "point_masses", {"node", "mass_kg", "inertia_kg_m2", "offset_m"})) {
    frame.masses.push_back(
        {nodes_named_by_key(frame, object, "node")[0], object.not_negative("mass_kg", 0),
         object.not_negative("inertia_kg_m2", 0), object.point_or_origin("offset_m")});
  }
}

void read_springs(const Arguments& model, Frame& frame) {
  for (const auto& [name, object] : objects_of(
           model, "springs", {"nodes", "stiffness_N_per_m", "rotational_stiffness_N_m_per_rad"})) {
    FrameSpring spring;
    const std::vector<int> nodes = nodes_named_by_key(frame, object, "nodes");
    if (nodes.empty() || nodes.size() > 2)
      object.fail("nodes", "expected one or two names of nodes");
    std::ranges::copy(nodes, spring.nodes.begin());
    const auto k = object.point_or_origin("stiffness_N_per_m");
    spring.stiffness = {k[0], k[1], object.not_negative("rotational_stiffness_N_m_per_rad", 0)};
    frame.springs.push_back(spring);
  }
}

void read_supports(const Arguments& model, Frame& frame) {
  const Arguments supports = object_at_key(model, "supports");
  for (const std::string& name : supports.keys()) {
    FrameSupport support{frame.find_node(name), {}};
    if (support.node < 0) supports.fail(name, "expected the name of a node");
    for (const std::string& motion : supports.texts(name)) {
      if (motion != "x" && motion != "y" && motion != "rotation")
        supports.fail(name, "expected x, y or rotation");
      support.fixed[motion == "x" ? 0 : motion == "y" ? 1 : 2] = true;
    }
    frame.supports.push_back(support);
  }
}

void read_loads(const Arguments& model, Frame& frame) {
  for (const auto& [name, object] : objects_of(model, "loads", {"node", "force_N", "moment_N_m"})) {
    const auto force = object.point_or_origin("force_N");
    frame.loads.push_back({nodes_named_by_key(frame, object, "node")[0],
                           {force[0], force[1], object.number("moment_N_m", 0)}});
  }
}

Frame read_frame(const Json& json, const std::string& pointer) {
  const Arguments model(
      json, pointer,
      {"materials", "sections", "nodes", "members", "rigid_bodies", "point_masses", "springs",
       "supports", "loads", "gravity_m_s2", "elements"});
  Frame frame;
  read_nodes(model, frame);
  read_members(model, frame);
  read_bodies(model, frame);
  read_masses(model, frame);
  read_springs(model, frame);
  read_supports(model, frame);
  read_loads(model, frame);
  frame.gravity = model.point_or_origin("gravity_m_s2");
  return frame;
}

}  // namespace

Frame frame_from_arguments(const Arguments& arguments) {
  if (arguments.has("model")) {
    for (const char* key : {"manipulator", "pose", "loads", "gravity_m_s2"}) {
      if (arguments.has(key)) arguments.fail(key, "is not allowed together with a model");
    }
    return read_frame(arguments["model"], "/model");
  }
  const Arguments pose = arguments.object("pose", {"x_m", "y_m", "phi_rad"});
  Frame frame = manipulator_frame(manipulator_arguments(arguments), pose);
  read_loads(arguments, frame);
  frame.gravity = arguments.point_or_origin("gravity_m_s2");
  return frame;
}

}  // namespace trammel::references
