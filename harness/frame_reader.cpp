#include "harness/frame_reader.h"

#include <iterator>
#include <limits>
#include <map>
#include <numbers>

#include "harness/material_reader.h"
#include "harness/member_chain.h"
#include "harness/words.h"

namespace trammel {
namespace {

template <class T>
std::vector<std::string> names_of(const std::map<std::string, T>& named) {
  std::vector<std::string> names;
  for (const auto& item : named) names.push_back(item.first);
  return names;
}

template <class T>
const T& look_up(const std::map<std::string, T>& named, const Cursor& name, const char* what) {
  const auto word = name.get<std::string>();
  const auto found = named.find(word);
  if (found != named.end()) return found->second;
  throw name.error(std::string("expected the name of a ") + what + " (got '" + printable(word) +
                   "')" + did_you_mean(word, names_of(named)));
}

/// What the parts of a model are looked up by.
struct Names {
  std::map<std::string, Index> node;
  std::vector<Vector2d> position;
  std::map<std::string, Material> material;
  std::map<std::string, Section> section;
  Index count_before = 0;  ///< nodes that the manipulator has

  [[nodiscard]] Index find_node(const Cursor& name) const { return look_up(node, name, "node"); }
};

/// A, I and c of one of the three ways to give a cross-section.
struct Shape {
  double area = 0, second_moment = 0, half_depth = 0;
};

Shape read_shape(const Cursor& section) {
  const bool plain = section.has("area_m2") || section.has("second_moment_m4");
  const int ways =
      (section.has("rectangle") ? 1 : 0) + (section.has("circle") ? 1 : 0) + (plain ? 1 : 0);
  if (ways != 1 || (plain && !(section.has("area_m2") && section.has("second_moment_m4")))) {
    throw section.error(
        "expected exactly one of 'rectangle', 'circle', and 'area_m2' with 'second_moment_m4'");
  }
  if (!plain && section.has("half_depth_m")) {
    throw section["half_depth_m"].error("expected it beside 'area_m2' only");
  }
  if (section.has("rectangle")) {
    const double t = section["rectangle"].number("thickness_m");
    const double w = section["rectangle"].number("width_m");
    return {t * w, w * t * t * t / 12, t / 2};
  }
  if (section.has("circle")) {
    const double d = section["circle"].number("diameter_m");
    return {std::numbers::pi * d * d / 4, std::numbers::pi * d * d * d * d / 64, d / 2};
  }
  // A bar has no bending stress; where the outermost fibre is not known, the stress is not finite
  // and is left out of the quantities.
  const double second_moment = section.number("second_moment_m4");
  const double unknown = second_moment > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return {section.number("area_m2"), second_moment, section.get("half_depth_m", unknown)};
}

Section read_section(const Cursor& section, const Names& names) {
  const Material material = look_up(names.material, section["material"], "material");
  const Shape shape = read_shape(section);
  const double shear_modulus = material.E / (2 * (1 + material.nu));
  Section read;
  read.EA = material.E * shape.area;
  read.EI = material.E * shape.second_moment;
  read.kappa_GA = section.get("shear_coefficient", 5.0 / 6.0) * shear_modulus * shape.area;
  read.mass_per_length = material.rho * shape.area;
  read.inertia_per_length = material.rho * shape.second_moment;
  read.area = shape.area;
  read.section_modulus = shape.second_moment > 0 ? shape.second_moment / shape.half_depth
                                                 : std::numeric_limits<double>::infinity();
  return read;
}

MemberEnd read_end(const Cursor& end) {
  if (end.json().is_object()) {
    return {EndFixity::sprung, end.number("spring_N_m_per_rad"), 0};
  }
  return {end.get<std::string>() == "hinged" ? EndFixity::hinged : EndFixity::welded, 0, 0};
}

Member read_member(const std::string& name, const Cursor& place, const Names& names,
                   Index elements) {
  Member member;
  member.name = name;
  member.nodes = {names.find_node(place["nodes"][0]), names.find_node(place["nodes"][1])};
  const Vector2d span = names.position[static_cast<std::size_t>(member.nodes[1])] -
                        names.position[static_cast<std::size_t>(member.nodes[0])];
  if (!(span.norm() > 0)) {
    throw place["nodes"].error("expected two nodes apart from each other (got the same place)");
  }
  member.section = look_up(names.section, place["section"], "section");
  member.end_section = place.has("end_section")
                           ? look_up(names.section, place["end_section"], "section")
                           : member.section;
  member.theory = read_beam_theory(place);
  member.mass = read_mass_matrix(place);
  member.elements = place.get<Index>("elements", elements);
  member.axially_flexible = read_axial(place);
  if (place.has("ends")) member.ends = {read_end(place["ends"][0]), read_end(place["ends"][1])};
  if (place.has("load_N_per_m")) member.load = read_point(place["load_N_per_m"]);
  return member;
}

bool tapers(const Cursor& place) {
  if (!place.has("taper")) return false;
  if (!place.has("end_section")) throw place["taper"].error("expected an 'end_section' beside it");
  return place.text("taper") == "exponential";
}

MemberChain read_chain(const Cursor& place) {
  MemberChain chain;
  if (const auto center = place.find("arc_center_m")) chain.arc_center = read_point(*center);
  if (const auto held = place.find("held")) {
    for (const auto& entry : held->entries()) {
      const auto motion = entry.second.get<std::string>();
      chain.held[motion == "x" ? 0 : motion == "y" ? 1 : 2] = true;
    }
  }
  chain.exponential = tapers(place);
  return chain;
}

void read_members(const Cursor& members, const Names& names, Index elements, Model& parts) {
  for (const auto& [name, place] : members.entries()) {
    const Member member = read_member(name, place, names, elements);
    const MemberChain chain = read_chain(place);
    if (!chain.needed()) {
      parts.members.push_back(member);
      continue;
    }
    const auto at = [&](std::size_t end) {
      return names.position[static_cast<std::size_t>(member.nodes[end])];
    };
    try {
      add_chain(member, chain, at(0), at(1), names.count_before + std::ssize(parts.nodes), parts);
    } catch (const ModelError& error) {
      throw place["arc_center_m"].error(error.what());
    }
  }
}

double twice_area(const Names& names, const Triangle& triangle) {
  const auto corner = [&](std::size_t i) {
    return names.position[static_cast<std::size_t>(triangle.nodes[i])];
  };
  const Vector2d a = corner(1) - corner(0);
  const Vector2d b = corner(2) - corner(0);
  return a.x() * b.y() - a.y() * b.x();
}

Triangle read_triangle(const Cursor& place, const Names& names, Index plate) {
  if (place.size() != 3 && place.size() != 6) {
    throw place.error("expected 3 or 6 names (got " + std::to_string(place.size()) + ")");
  }
  Triangle triangle;
  triangle.plate = plate;
  for (std::size_t i = 0; i < place.size(); ++i) triangle.nodes[i] = names.find_node(place[i]);
  const double area = twice_area(names, triangle);
  if (area == 0) throw place.error("expected a triangle with an area (got three points in line)");
  if (area < 0) {  // clockwise: swap two corners, and the sides with them
    std::swap(triangle.nodes[1], triangle.nodes[2]);
    std::swap(triangle.nodes[3], triangle.nodes[5]);
  }
  return triangle;
}

void read_plates(const Cursor& plates, const Names& names, Model& model) {
  for (const auto& [name, place] : plates.entries()) {
    const auto plate = static_cast<Index>(model.plates.size());
    model.plates.push_back({name, look_up(names.material, place["material"], "material"),
                            place.number("thickness_m")});
    for (const auto& entry : place["triangles"].entries()) {
      model.triangles.push_back(read_triangle(entry.second, names, plate));
    }
  }
}

RigidBody read_rigid_body(const std::string& name, const Cursor& place, const Names& names) {
  RigidBody body{name, names.find_node(place["reference"]), {}};
  for (const auto& entry : place["nodes"].entries()) {
    body.attached.push_back(names.find_node(entry.second));
    if (body.attached.back() == body.reference) {
      throw entry.second.error("expected a node other than the reference");
    }
  }
  return body;
}

PointMass read_point_mass(const Cursor& place, const Names& names) {
  PointMass mass;
  mass.node = names.find_node(place["node"]);
  mass.mass = place.number("mass_kg");
  mass.inertia = place.get("inertia_kg_m2", 0.0);
  if (place.has("offset_m")) mass.offset = read_point(place["offset_m"]);
  return mass;
}

Spring read_spring(const std::string& name, const Cursor& place, const Names& names) {
  Spring spring;
  spring.name = name;
  for (std::size_t i = 0; i < place["nodes"].size(); ++i) {
    spring.nodes[i] = names.find_node(place["nodes"][i]);
  }
  if (const auto along = place.find("stiffness_N_per_m")) {
    spring.stiffness.head<2>() = read_point(*along);
  }
  spring.stiffness.z() = place.get("rotational_stiffness_N_m_per_rad", 0.0);
  return spring;
}

Support read_support(const std::string& node, const Cursor& place, const Names& names) {
  const auto found = names.node.find(node);
  if (found == names.node.end()) {
    throw place.error("expected the name of a node (got '" + printable(node) + "')" +
                      did_you_mean(node, names_of(names.node)));
  }
  Support support{node, found->second, {}};
  for (const auto& entry : place.entries()) {
    const auto motion = entry.second.get<std::string>();
    support.fixed[motion == "x" ? 0 : motion == "y" ? 1 : 2] = true;
  }
  return support;
}

NodalLoad read_load(const Cursor& place, const Names& names) {
  NodalLoad load{names.find_node(place["node"]), Vector3d::Zero()};
  if (const auto force = place.find("force_N")) load.force.head<2>() = read_point(*force);
  load.force.z() = place.get("moment_N_m", 0.0);
  return load;
}

/// Calls `read(name, place)` for every entry of an object that may be missing.
template <class Read>
void each(const Cursor& model, const char* key, const Read& read) {
  const auto places = model.find(key);
  if (!places) return;
  for (const auto& [name, place] : places->entries()) read(name, place);
}

Names read_names(const Cursor& model, const std::vector<Node>& before, Model& parts) {
  Names names;
  const auto add = [&](const std::string& name, const Vector2d& position) {
    const bool fresh = names.node.emplace(name, static_cast<Index>(names.position.size())).second;
    names.position.push_back(position);
    return fresh;
  };
  names.count_before = std::ssize(before);
  for (const Node& node : before) add(node.name, node.position);
  each(model, "nodes", [&](const std::string& name, const Cursor& place) {
    parts.nodes.push_back({name, read_point(place)});
    if (!add(name, parts.nodes.back().position)) {
      throw place.error("expected another name: the manipulator has a node of that name");
    }
  });
  each(model, "materials", [&](const std::string& name, const Cursor& place) {
    names.material.emplace(name, read_material(place));
  });
  each(model, "sections", [&](const std::string& name, const Cursor& place) {
    names.section.emplace(name, read_section(place, names));
  });
  return names;
}

}  // namespace

Model read_parts(const Cursor& model, const std::vector<Node>& before) {
  Model parts;
  const Names names = read_names(model, before, parts);
  const Index elements = model.get<Index>("elements", 1);
  if (const auto members = model.find("members")) read_members(*members, names, elements, parts);
  if (const auto plates = model.find("plates")) read_plates(*plates, names, parts);
  each(model, "rigid_bodies", [&](const std::string& name, const Cursor& place) {
    parts.rigid_bodies.push_back(read_rigid_body(name, place, names));
  });
  each(model, "point_masses", [&](const std::string&, const Cursor& place) {
    parts.masses.push_back(read_point_mass(place, names));
  });
  each(model, "springs", [&](const std::string& name, const Cursor& place) {
    parts.springs.push_back(read_spring(name, place, names));
  });
  each(model, "supports", [&](const std::string& name, const Cursor& place) {
    parts.supports.push_back(read_support(name, place, names));
  });
  each(model, "loads", [&](const std::string&, const Cursor& place) {
    parts.loads.push_back(read_load(place, names));
  });
  if (model.has("gravity_m_s2")) parts.gravity = read_point(model["gravity_m_s2"]);
  return parts;
}

}  // namespace trammel
