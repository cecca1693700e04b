#include "harness/readers/frame_reader.h"

#include <iterator>
#include <limits>
#include <numbers>

#include "harness/readers/material_reader.h"
#include "harness/readers/member_chain.h"
#include "harness/readers/plate_reader.h"
#include "harness/readers/symbol_table.h"
#include "solver/large/large_motion_model.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

/// A, I and c of one of the three ways to give a cross-section.
struct Shape {
  double area = 0, second_moment = 0, half_depth = 0;
};

Shape read_shape(const JsonView& section) {
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

solver::Section read_section(const JsonView& section, const SymbolTable& symbols) {
  const solver::Material material = look_up(symbols.material, section["material"], "a material");
  const Shape shape = read_shape(section);
  const double shear_modulus = material.E / (2 * (1 + material.nu));
  solver::Section read;
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

solver::MemberEnd read_end(const JsonView& end) {
  if (end.json().is_object()) {
    return {solver::EndFixity::sprung, end.number("spring_N_m_per_rad"), 0};
  }
  return {
      end.get<std::string>() == "hinged" ? solver::EndFixity::hinged : solver::EndFixity::welded, 0,
      0};
}

solver::Taper read_taper(const JsonView& place, const SymbolTable& symbols) {
  const auto name = place.get<std::string>("taper", "linear-depth-and-width");
  if (name == "exponential") return solver::Taper::exponential;
  if (name == "linear-area-and-inertia") return solver::Taper::linear_area_and_inertia;
  const std::string& first = symbols.section_shape.at(place.text("section"));
  const std::string& second = symbols.section_shape.at(place.text("end_section"));
  if (first != second || first.empty()) {
    throw place["end_section"].error(
        "expected two rectangles or two circles, or 'taper' as 'linear-area-and-inertia' or "
        "'exponential' beside it: no depth and width are known that could vary");
  }
  return solver::Taper::linear_depth_and_width;
}

solver::Member read_member(const std::string& name, const JsonView& place,
                           const SymbolTable& symbols, const std::vector<solver::Node>& nodes,
                           solver::Index elements) {
  solver::Member member;
  member.name = name;
  member.nodes = {symbols.find_node(place["nodes"][0]), symbols.find_node(place["nodes"][1])};
  const Eigen::Vector2d span = nodes[solver::to_size(member.nodes[1])].position -
                               nodes[solver::to_size(member.nodes[0])].position;
  if (!(span.norm() > 0)) {
    throw place["nodes"].error("expected two nodes apart from each other (got the same place)");
  }
  member.section = look_up(symbols.section, place["section"], "a section");
  member.end_section = member.section;
  if (place.has("taper") && !place.has("end_section")) {
    throw place["taper"].error("expected an 'end_section' beside it");
  }
  if (place.has("end_section")) {
    member.end_section = look_up(symbols.section, place["end_section"], "a section");
    member.taper = read_taper(place, symbols);
  }
  member.theory = read_beam_theory(place);
  member.mass = read_mass_matrix(place);
  member.elements = place.get<solver::Index>("elements", elements);
  member.axially_flexible = read_axial(place);
  if (place.has("ends")) member.ends = {read_end(place["ends"][0]), read_end(place["ends"][1])};
  if (const auto inertia = place.find("end_inertia_kg_m2")) {
    for (std::size_t end = 0; end < 2; ++end)
      member.ends[end].inertia = (*inertia)[end].get<double>();
  }
  if (place.has("load_N_per_m")) member.load = read_point(place["load_N_per_m"]);
  return member;
}

std::array<bool, 3> read_motions(const JsonView& place) {
  std::array<bool, 3> fixed{};
  for (const auto& entry : place.entries()) {
    const auto motion = entry.second.get<std::string>();
    fixed[motion == "x" ? 0 : motion == "y" ? 1 : 2] = true;
  }
  return fixed;
}

MemberChain read_chain(const JsonView& place) {
  MemberChain chain;
  if (const auto center = place.find("arc_center_m")) chain.arc_center = read_point(*center);
  if (const auto held = place.find("restrained_motions")) chain.held = read_motions(*held);
  return chain;
}

void read_members(const JsonView& members, const SymbolTable& symbols, solver::Index elements,
                  solver::Model& structure) {
  for (const auto& [name, place] : members.entries()) {
    const solver::Member member = read_member(name, place, symbols, structure.nodes, elements);
    const MemberChain chain = read_chain(place);
    if (!chain.needed()) {
      structure.members.push_back(member);
      continue;
    }
    const auto at = [&](std::size_t end) -> Eigen::Vector2d {
      return structure.nodes[solver::to_size(member.nodes[end])].position;
    };
    try {
      add_chain(member, chain, at(0), at(1), std::ssize(structure.nodes), structure);
    } catch (const solver::ModelError& error) {
      throw place["arc_center_m"].error(error.what());
    }
  }
}

solver::RigidBody read_rigid_body(const std::string& name, const JsonView& place,
                                  const SymbolTable& symbols) {
  solver::RigidBody body{name, symbols.find_node(place["reference"]), {}};
  for (const auto& entry : place["nodes"].entries()) {
    body.attached.push_back(symbols.find_node(entry.second));
    if (body.attached.back() == body.reference) {
      throw entry.second.error("expected a node other than the reference");
    }
  }
  return body;
}

solver::PointMass read_point_mass(const JsonView& place, const SymbolTable& symbols) {
  solver::PointMass mass;
  mass.node = symbols.find_node(place["node"]);
  mass.mass = place.number("mass_kg");
  mass.inertia = place.get("inertia_kg_m2", 0.0);
  if (place.has("offset_m")) mass.offset = read_point(place["offset_m"]);
  return mass;
}

solver::Spring read_spring(const std::string& name, const JsonView& place,
                           const SymbolTable& symbols) {
  solver::Spring spring;
  spring.name = name;
  for (std::size_t i = 0; i < place["nodes"].size(); ++i) {
    spring.nodes[i] = symbols.find_node(place["nodes"][i]);
  }
  if (const auto along = place.find("stiffness_N_per_m")) {
    spring.stiffness.head<2>() = read_point(*along);
  }
  spring.stiffness.z() = place.get("rotational_stiffness_N_m_per_rad", 0.0);
  return spring;
}

void read_pin(const std::string& name, const JsonView& place, const SymbolTable& symbols,
              solver::Model& model) {
  std::array<solver::Index, 2> nodes{};
  for (std::size_t i = 0; i < 2; ++i) nodes[i] = symbols.find_node(place["nodes"][i]);
  const double apart = (model.nodes[solver::to_size(nodes[0])].position -
                        model.nodes[solver::to_size(nodes[1])].position)
                           .norm();
  constexpr double kRoundoff = 1e-12;  // of coordinates that were computed, over the model's size
  if (apart > kRoundoff * solver::box_diagonal(model)) {
    throw place["nodes"].error("expected two nodes in one place (got " + shortest(apart) +
                               " m between them)");
  }
  solver::add_pin(model, name, nodes);
}

/// Calls `read(name, place)` for every entry of an object that may be missing.
template <class Read>
void each(const JsonView& model, const char* key, const Read& read) {
  const auto places = model.find(key);
  if (!places) return;
  for (const auto& [name, place] : places->entries()) read(name, place);
}

/// Every node on an edge; motions that are already taken away are left out.
void support_edge(const std::string& name, const JsonView& place, const Edge& edge,
                  solver::Model& model) {
  const std::array<bool, 3> fixed = read_motions(place);
  if (fixed[2]) throw place.error("expected x and y alone: a plate's nodes have no rotation");
  for (const solver::Index node : nodes_of(edge)) {
    solver::Support support{name, node, fixed};
    for (const solver::Support& other : model.supports) {
      if (other.node != node) continue;
      for (std::size_t k = 0; k < 3; ++k) support.fixed[k] = support.fixed[k] && !other.fixed[k];
    }
    model.supports.push_back(support);
  }
}

/// Those of nodes first: they keep their reactions where an edge is supported as well.
void read_supports(const JsonView& model, const SymbolTable& symbols, solver::Model& structure) {
  each(model, "supports", [&](const std::string& name, const JsonView& place) {
    if (symbols.edge.count(name) > 0) return;
    const char* what = symbols.edge.empty() ? "a node" : "a node or edge";
    structure.supports.push_back(
        {name, look_up(symbols.node, name, place, what), read_motions(place)});
  });
  each(model, "supports", [&](const std::string& name, const JsonView& place) {
    const auto edge = symbols.edge.find(name);
    if (edge != symbols.edge.end()) support_edge(name, place, edge->second, structure);
  });
}

void read_load(const JsonView& place, const SymbolTable& symbols, solver::Model& model) {
  if (place.has("node") == place.has("edge")) {
    throw place.error("expected exactly one of 'node' and 'edge'");
  }
  const bool on_edge = place.has("edge");
  for (const char* key : {"force_N", "moment_N_m", "traction_Pa", "normal_Pa"}) {
    const bool of_edge = std::string(key).ends_with("_Pa");
    if (!place.has(key) || of_edge == on_edge) continue;
    throw place[key].error(std::string("expected it beside '") + (of_edge ? "edge" : "node") +
                           "' only");
  }
  if (on_edge && !place.has("traction_Pa") && !place.has("normal_Pa"))
    throw place.error("the load is empty; expected 'traction_Pa' or 'normal_Pa'");
  if (on_edge) return read_edge_load(place, symbols, model);
  model.loads.push_back({symbols.find_node(place["node"]), read_force(place)});
}

SymbolTable read_symbols(const JsonView& model, solver::Model& structure) {
  SymbolTable symbols;
  const auto add = [&](std::size_t node) {
    return symbols.node.emplace(structure.nodes[node].name, static_cast<solver::Index>(node))
        .second;
  };
  for (std::size_t i = 0; i < structure.nodes.size(); ++i) add(i);
  each(model, "nodes", [&](const std::string& name, const JsonView& place) {
    if (name.empty()) throw place.error("the name of the node is empty; expected a name");
    structure.nodes.push_back({name, read_point(place)});
    if (!add(structure.nodes.size() - 1)) {
      throw place.error("expected another name: the manipulator has a node of that name");
    }
  });
  each(model, "materials", [&](const std::string& name, const JsonView& place) {
    symbols.material.emplace(name, read_material(place));
  });
  each(model, "sections", [&](const std::string& name, const JsonView& place) {
    symbols.section.emplace(name, read_section(place, symbols));
    symbols.section_shape[name] = place.has("rectangle") ? "rectangle"
                                  : place.has("circle")  ? "circle"
                                                         : "";
  });
  return symbols;
}

}  // namespace

solver::Model read_structure(const JsonView& model, const std::vector<solver::Node>& before) {
  solver::Model structure;
  structure.nodes = before;
  SymbolTable symbols = read_symbols(model, structure);
  const solver::Index elements = model.get<solver::Index>("elements", 1);
  if (const auto members = model.find("members"))
    read_members(*members, symbols, elements, structure);
  read_plates(model, symbols, structure);
  each(model, "rigid_bodies", [&](const std::string& name, const JsonView& place) {
    structure.rigid_bodies.push_back(read_rigid_body(name, place, symbols));
  });
  each(model, "point_masses", [&](const std::string&, const JsonView& place) {
    structure.masses.push_back(read_point_mass(place, symbols));
  });
  each(model, "springs", [&](const std::string& name, const JsonView& place) {
    structure.springs.push_back(read_spring(name, place, symbols));
  });
  read_supports(model, symbols, structure);
  each(model, "pins", [&](const std::string& name, const JsonView& place) {
    read_pin(name, place, symbols, structure);
  });
  each(model, "loads",
       [&](const std::string&, const JsonView& place) { read_load(place, symbols, structure); });
  if (model.has("gravity_m_s2")) structure.gravity = read_point(model["gravity_m_s2"]);
  check_meshed_nodes(model, before.size(), structure);
  structure.nodes.erase(structure.nodes.begin(),
                        structure.nodes.begin() + static_cast<solver::Index>(before.size()));
  return structure;
}

}  // namespace trammel::harness
