#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "harness/readers/discretization.h"
#include "harness/readers/field_reader.h"
#include "harness/readers/model_reader.h"
#include "solver/elements/frame_element.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

/// Area A [m^2], second moment of area I [m^4] and half depth c [m] of a cross-section.
struct Shape {
  double area = 0, second_moment = 0, half_depth = 0;
};

Shape read_shape(const JsonView& section) {
  const bool plain = section.has("area_m2") || section.has("second_moment_m4");
  const int ways =
      (section.has("rectangle") ? 1 : 0) + (section.has("circle") ? 1 : 0) + (plain ? 1 : 0);
  if (ways != 1 || (plain && !(section.has("area_m2") && section.has("second_moment_m4"))))
    throw section.error(
        "expected exactly one of 'rectangle', 'circle', and 'area_m2' with 'second_moment_m4' "
        "(got none, several or an incomplete pair)");
  if (!plain && section.has("half_depth_m"))
    throw section["half_depth_m"].error(
        "'half_depth_m' requires 'area_m2' (got 'rectangle' or 'circle')");
  if (section.has("rectangle")) {
    const double t = section["rectangle"].number("thickness_m");
    const double w = section["rectangle"].number("width_m");
    return {t * w, w * t * t * t / 12, t / 2};
  }
  if (section.has("circle")) {
    const double d = section["circle"].number("diameter_m");
    return {std::numbers::pi * d * d / 4, std::numbers::pi * d * d * d * d / 64, d / 2};
  }
  // A bar has no bending stress. If the case does not state the half depth, the stress is not
  // finite and is omitted from the quantities.
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

solver::Taper read_taper(const JsonView& place, const SymbolTable& symbols) {
  const auto taper = place.get("taper", solver::Taper::linear_depth_and_width);
  if (taper != solver::Taper::linear_depth_and_width) return taper;
  const std::string& first = symbols.section_shape.at(place.text("section"));
  const std::string& second = symbols.section_shape.at(place.text("end_section"));
  if (first != second || first.empty())
    throw place["end_section"].error(
        "expected two rectangles or two circles, or 'taper' as 'linear-area-and-inertia' or "
        "'exponential': other sections have no depth and width that could vary");
  return taper;
}

solver::Member read_member(const std::string& name, const JsonView& place,
                           const SymbolTable& symbols, const std::vector<solver::Node>& nodes,
                           solver::Index elements) {
  solver::Member member;
  member.name = name;
  member.elements = elements;
  const FieldReader reader(place, &symbols);
  visit_fields(reader, member);
  const Eigen::Vector2d span = nodes[solver::to_size(member.nodes[1])].position -
                               nodes[solver::to_size(member.nodes[0])].position;
  if (!(span.norm() > 0))
    throw place["nodes"].error("expected two nodes at different positions (got the same position)");
  member.end_section = member.section;
  if (place.has("taper") && !place.has("end_section"))
    throw place["taper"].error("'taper' requires 'end_section' (section at the second node)");
  if (place.has("end_section")) {
    reader.optional("end_section", member.end_section);
    member.taper = read_taper(place, symbols);
  }
  return member;
}

void read_members(const JsonView& model, const SymbolTable& symbols, solver::Model& structure) {
  for (const auto& [name, place] : model.entries("members")) {
    const solver::Member member = read_member(name, place, symbols, structure.nodes,
                                              element_count_of(model.document(), name));
    MemberChain chain;
    const FieldReader reader(place);
    if (place.has("arc_center_m")) reader.optional("arc_center_m", chain.arc_center.emplace());
    reader.optional("restrained_motions", chain.held);
    if (!chain.needs_chain()) {
      structure.members.push_back(member);
      continue;
    }
    const auto at = [&](std::size_t end) -> Eigen::Vector2d {
      return structure.nodes[solver::to_size(member.nodes[end])].position;
    };
    try {
      add_member_chain(member, chain, at(0), at(1), std::ssize(structure.nodes), structure);
    } catch (const solver::ModelError& error) {
      throw place["arc_center_m"].error(error.what());
    }
  }
}

void require_other_reference(const JsonView& place, const solver::RigidBody& body) {
  const auto same = std::ranges::find(body.attached, body.reference);
  if (same == body.attached.end()) return;
  throw place["nodes"][static_cast<std::size_t>(same - body.attached.begin())].error(
      "the reference node of a rigid body cannot be among its 'nodes'; expected another node");
}

void add_pin(const JsonView& place, const Pin& pin, solver::Model& model) {
  const double apart = (model.nodes[solver::to_size(pin.nodes[0])].position -
                        model.nodes[solver::to_size(pin.nodes[1])].position)
                           .norm();
  constexpr double kRoundoff = 1e-12;  // round-off error of coordinates / size of the model
  if (apart > kRoundoff * solver::box_diagonal(model))
    throw place["nodes"].error("the nodes of a pin require the same position (got a distance of " +
                               shortest_decimal(apart) + " m)");
  solver::add_pin(model, pin.name, pin.nodes);
}

void require_force_in_load(const JsonView& load) {
  if (!load.has("force_N") && !load.has("moment_N_m"))
    throw load.error("the load is empty; expected 'force_N', 'moment_N_m' or both");
}

/// Adds a support to every node on an edge, except for motions that are already supported.
void support_nodes_on_edge(const JsonView& place, const solver::Support& all, const Edge& edge,
                           solver::Model& model) {
  if (all.fixed[2])
    throw place.error(
        "an edge cannot support 'rotation', because nodes of plates have no rotation; expected "
        "'x' or 'y'");
  for (const solver::Index node : nodes_on_edge(edge)) {
    solver::Support support{all.name, node, all.fixed};
    for (const solver::Support& other : model.supports) {
      if (other.node != node) continue;
      for (std::size_t k = 0; k < 3; ++k) support.fixed[k] = support.fixed[k] && !other.fixed[k];
    }
    model.supports.push_back(support);
  }
}

/// Reads supports of nodes before those of edges. Supported nodes on a supported edge therefore
/// keep separate reactions.
void read_supports(const JsonView& model, const SymbolTable& symbols, solver::Model& structure) {
  for (const bool of_edges : {false, true})
    for (const auto& [name, place] : model.entries("supports")) {
      const auto edge = symbols.edge.find(name);
      if (of_edges != (edge != symbols.edge.end())) continue;
      solver::Support support{name};
      FieldReader::read(place, support.fixed);
      if (of_edges) {
        support_nodes_on_edge(place, support, edge->second, structure);
      } else {
        const char* what = symbols.edge.empty() ? "a node" : "a node or edge";
        support.node = look_up(symbols.node, name, place, what);
        structure.supports.push_back(support);
      }
    }
}

void read_load(const JsonView& place, const SymbolTable& symbols, solver::Model& model) {
  if (place.has("node") == place.has("edge"))
    throw place.error("expected exactly one of 'node' and 'edge' (got both or neither)");
  const bool on_edge = place.has("edge");
  for (const char* key : {"force_N", "moment_N_m", "traction_Pa", "normal_Pa"}) {
    const bool of_edge = std::string(key).ends_with("_Pa");
    if (!place.has(key) || of_edge == on_edge) continue;
    throw place[key].error("'" + std::string(key) + "' requires '" + (of_edge ? "edge" : "node") +
                           "'; expected forces on a 'node' or tractions on an 'edge'");
  }
  if (on_edge && !place.has("traction_Pa") && !place.has("normal_Pa"))
    throw place.error("the load is empty; expected 'traction_Pa' or 'normal_Pa'");
  if (on_edge) return read_edge_load(place, symbols, model);
  model.loads.push_back(read_part<solver::NodalLoad>(place, &symbols));
  require_force_in_load(place);
}

SymbolTable read_symbols(const JsonView& model, solver::Model& structure) {
  SymbolTable symbols;
  const auto add = [&](std::size_t node) {
    return symbols.node.emplace(structure.nodes[node].name, static_cast<solver::Index>(node))
        .second;
  };
  for (std::size_t i = 0; i < structure.nodes.size(); ++i) add(i);
  for (const auto& [name, place] : model.entries("nodes")) {
    if (name.empty()) throw place.error("the name of the node is empty; expected a name");
    structure.nodes.push_back({name, read_point(place)});
    if (!add(structure.nodes.size() - 1))
      throw place.error("the manipulator already has a node of this name; expected another name");
  }
  symbols.node.erase("");
  for (const auto& [name, place] : model.entries("materials"))
    symbols.material.emplace(name, read_material(place));
  for (const auto& [name, place] : model.entries("sections")) {
    symbols.section.emplace(name, read_section(place, symbols));
    symbols.section_shape[name] = place.has("rectangle") ? "rectangle"
                                  : place.has("circle")  ? "circle"
                                                         : "";
  }
  return symbols;
}

solver::large_motion::LargeMotionModel read_joint_elements(const JsonView& model,
                                                           const SymbolTable& symbols) {
  using namespace solver::large_motion;
  LargeMotionModel joints;
  joints.sliders = read_parts<Slider>(
      model, "sliders", symbols, [](const JsonView& place, const Slider& slider) {
        if (slider.rail == slider.node)
          throw place["rail"].error("'rail' and 'node' are equal; expected two different nodes");
      });
  joints.line_springs = read_parts<LineSpring>(model, "axial_springs", symbols);
  joints.follower_loads = read_parts<FollowerLoad>(
      model, "follower_loads", symbols, [](const JsonView& place, const FollowerLoad&) {
        if (!place.has("node")) throw place.error("the follower load requires the key 'node'");
        require_force_in_load(place);
      });
  return joints;
}

}  // namespace

Structure read_structure(const JsonView& model, const std::vector<solver::Node>& given_nodes) {
  Structure read;
  solver::Model& structure = read.model;
  structure.nodes = given_nodes;
  SymbolTable symbols = read_symbols(model, structure);
  read_members(model, symbols, structure);
  read_plates(model, symbols, structure);
  structure.rigid_bodies =
      read_parts<solver::RigidBody>(model, "rigid_bodies", symbols, require_other_reference);
  structure.masses = read_parts<solver::PointMass>(model, "point_masses", symbols);
  structure.springs = read_parts<solver::Spring>(model, "springs", symbols);
  read_supports(model, symbols, structure);
  (void)read_parts<Pin>(model, "pins", symbols, [&](const JsonView& place, const Pin& pin) {
    add_pin(place, pin, structure);
  });
  for (const auto& [name, place] : model.entries("loads")) read_load(place, symbols, structure);
  FieldReader(model).optional("gravity_m_s2", structure.gravity);
  require_connected_nodes(model, given_nodes.size(), structure);
  read.joints = read_joint_elements(model, symbols);
  structure.nodes.erase(structure.nodes.begin(),
                        structure.nodes.begin() + static_cast<solver::Index>(given_nodes.size()));
  return read;
}

namespace {

/// Positions along a chain of members (straight line or arc), for a parameter s from 0 at its start
/// to 1 at its end.
class ChainPath {
 public:
  ChainPath(const MemberChain& chain, const Eigen::Vector2d& start, const Eigen::Vector2d& end)
      : center_(chain.arc_center), start_(start), end_(end) {
    if (!center_) return;
    const Eigen::Vector2d a = start - *center_;
    const Eigen::Vector2d b = end - *center_;
    if (!(std::abs(a.norm() - b.norm()) <= 1e-9 * a.norm()))
      throw solver::ModelError(
          "the center of an arc requires equal distances from both nodes (got " +
          std::to_string(a.norm()) + " m and " + std::to_string(b.norm()) + " m)");
    radius_ = a.norm();
    angle_ = std::atan2(a.y(), a.x());
    turn_ = std::atan2(solver::cross(a, b), a.dot(b));
    if (turn_ <= 0) turn_ += 2 * std::numbers::pi;
  }

  [[nodiscard]] Eigen::Vector2d at(double s) const {
    if (!center_) return start_ + s * (end_ - start_);
    const double angle = angle_ + s * turn_;
    return *center_ + radius_ * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }

 private:
  std::optional<Eigen::Vector2d> center_;
  Eigen::Vector2d start_, end_;
  double radius_ = 0, angle_ = 0, turn_ = 0;
};

}  // namespace

void add_member_chain(const solver::Member& member, const MemberChain& chain,
                      const Eigen::Vector2d& start, const Eigen::Vector2d& end,
                      solver::Index first_node, solver::Model& structure) {
  const ChainPath path(chain, start, end);
  const bool is_bar = solver::section_at(member, 0.5).EI == 0;
  const solver::MemberEnd inner{is_bar ? solver::EndFixity::hinged : solver::EndFixity::welded, 0,
                                0};
  const bool holds = chain.held[0] || chain.held[1] || chain.held[2];
  const auto count = static_cast<double>(member.elements);
  solver::Member link = member;
  link.elements = 1;
  link.nodes[1] = member.nodes[0];
  for (solver::Index i = 0; i < member.elements; ++i) {
    const bool last = i + 1 == member.elements;
    link.name = member.name + "." + std::to_string(i + 1);
    link.nodes[0] = link.nodes[1];
    link.nodes[1] = last ? member.nodes[1] : first_node + i;
    link.section = solver::section_at(member, static_cast<double>(i) / count);
    link.end_section = solver::section_at(member, static_cast<double>(i + 1) / count);
    link.ends = {i == 0 ? member.ends[0] : inner, last ? member.ends[1] : inner};
    structure.members.push_back(link);
    if (last) break;
    structure.nodes.push_back({"", path.at(static_cast<double>(i + 1) / count)});
    if (holds) structure.supports.push_back({"", link.nodes[1], chain.held});
  }
}

}  // namespace trammel::harness
