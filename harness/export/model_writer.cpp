#include "harness/export/model_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "harness/export/section_table.h"
#include "harness/readers/member_chain.h"
#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using solver::Index;
using solver::Model;

Json point(const Eigen::Vector2d& p) {
  return {p.x(), p.y()};
}

/// Parts of one kind, by name. (Json would look through all of them at each.)
class Parts {
 public:
  explicit Parts(const char* kind) : kind_(kind) {}

  /// Under the name, or the kind with the next number where there is none.
  void add(std::string name, Json part) {
    if (name.empty()) name = kind_ + ("-" + std::to_string(json_.size() + 1));
    solver::require(names_.insert(name).second,
                    std::string("two of its ") + kind_ + " have the name '" + name + "'");
    json_.get_ref<Json::object_t&>().emplace_back(std::move(name), std::move(part));
  }
  void put_into(Json& model) {
    if (!json_.empty()) model[kind_] = std::move(json_);
  }

 private:
  const char* kind_;
  Json json_ = Json::object();
  std::set<std::string> names_;
};

const char* name_of(solver::BeamTheory theory) {
  return std::array{"euler-bernoulli", "rayleigh", "shear",
                    "timoshenko"}[static_cast<std::size_t>(theory)];
}

Json end_json(const solver::MemberEnd& end) {
  if (end.fixity == solver::EndFixity::sprung) return {{"spring_N_m_per_rad", end.stiffness}};
  return end.fixity == solver::EndFixity::hinged ? "hinged" : "welded";
}

/// Tapered members become chains of members of one element, which keep what the element has.
void cut_tapers(Model& model) {
  const std::vector<solver::Member> members = std::exchange(model.members, {});
  for (const solver::Member& member : members) {
    const std::size_t first = model.members.size();
    if (!is_tapered(member) || member.elements == 1) {
      model.members.push_back(member);
    } else {
      const auto at = [&](std::size_t end) -> Eigen::Vector2d {
        return model.nodes[solver::to_size(member.nodes[end])].position;
      };
      add_chain(member, {}, at(0), at(1), std::ssize(model.nodes), model);
    }
    for (std::size_t i = first; i < model.members.size(); ++i) {
      solver::Member& piece = model.members[i];
      if (is_tapered(piece)) piece.section = piece.end_section = solver::section_at(piece, 0.5);
    }
  }
}

class ModelWriter {
 public:
  ModelWriter(const Model& model, const WrittenNames& names)
      : model_(model), names_(names), table_(names.materials) {
    std::set<std::string> taken;
    for (const solver::Node& node : model.nodes) taken.insert(node.name);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      std::string name = model.nodes[i].name;
      if (name.empty()) name = "n" + std::to_string(i + 1);
      while (model.nodes[i].name.empty() && !taken.insert(name).second) name += "'";
      node_.push_back(std::move(name));
    }
  }

  Json write(const solver::large_motion::LargeMotionModel& joints) {
    Json parts = Json::object();
    nodes(parts);
    members(parts);
    plates(parts);
    bodies(parts);
    supports(parts);
    pins(parts);
    large_motion(joints, parts);
    loads(parts);
    if (!model_.gravity.isZero(0)) parts["gravity_m_s2"] = point(model_.gravity);
    Json model = {{"materials", table_.materials()}, {"sections", table_.sections()}};
    for (const char* key : {"materials", "sections"})
      if (model[key].empty()) model.erase(key);
    model.update(parts);
    return model;
  }

 private:
  [[nodiscard]] const std::string& name(Index node) const { return node_[solver::to_size(node)]; }

  void nodes(Json& model) const {
    Parts nodes("nodes");
    for (std::size_t i = 0; i < node_.size(); ++i)
      nodes.add(node_[i], point(model_.nodes[i].position));
    nodes.put_into(model);
  }

  void members(Json& model) {
    Parts members("members");
    for (const solver::Member& m : model_.members) {
      Json member = {{"nodes", {name(m.nodes[0]), name(m.nodes[1])}},
                     {"section", table_.name_of(m.section)},
                     {"beam", name_of(m.theory)},
                     {"elements", m.elements},
                     {"ends", {end_json(m.ends[0]), end_json(m.ends[1])}}};
      if (m.mass == solver::MassMatrix::lumped) member["mass_matrix"] = "lumped";
      if (!m.axially_flexible) member["axial"] = "inextensible";
      if (!m.load.isZero(0)) member["load_N_per_m"] = point(m.load);
      if (m.ends[0].inertia != 0 || m.ends[1].inertia != 0)
        member["end_inertia_kg_m2"] = {m.ends[0].inertia, m.ends[1].inertia};
      members.add(m.name, std::move(member));
    }
    members.put_into(model);
  }

  void plates(Json& model) {
    std::vector<Json> triangles(model_.plates.size(), Json::array());
    for (const solver::Triangle& triangle : model_.triangles) {
      Json names = Json::array();
      for (const Index node : triangle.nodes)
        if (node >= 0) names.push_back(name(node));
      triangles[solver::to_size(triangle.plate)].push_back(std::move(names));
    }
    Parts plates("plates");
    for (std::size_t i = 0; i < model_.plates.size(); ++i) {
      const solver::Plate& plate = model_.plates[i];
      if (triangles[i].empty()) continue;
      plates.add(plate.name, {{"material", table_.name_of(plate.material)},
                              {"thickness_m", plate.thickness},
                              {"triangles", std::move(triangles[i])}});
    }
    plates.put_into(model);
  }

  void bodies(Json& model) const {
    Parts bodies("rigid_bodies"), masses("point_masses"), springs("springs");
    for (const solver::RigidBody& body : model_.rigid_bodies) {
      Json attached = Json::array();
      for (const Index node : body.attached) attached.push_back(name(node));
      bodies.add(body.name, {{"reference", name(body.reference)}, {"nodes", attached}});
    }
    for (const solver::PointMass& mass : model_.masses) {
      masses.add("", {{"node", name(mass.node)},
                      {"mass_kg", mass.mass},
                      {"inertia_kg_m2", mass.inertia},
                      {"offset_m", point(mass.offset)}});
    }
    for (const solver::Spring& spring : model_.springs) {
      Json nodes = {name(spring.nodes[0])};
      if (spring.nodes[1] >= 0) nodes.push_back(name(spring.nodes[1]));
      springs.add(spring.name, {{"nodes", nodes},
                                {"stiffness_N_per_m", point(spring.stiffness.head<2>())},
                                {"rotational_stiffness_N_m_per_rad", spring.stiffness.z()}});
    }
    bodies.put_into(model);
    masses.put_into(model);
    springs.put_into(model);
  }

  /// Of each node what all its supports hold together.
  void supports(Json& model) const {
    std::map<Index, std::array<bool, 3>> held;
    for (const solver::Support& support : model_.supports)
      for (std::size_t k = 0; k < 3; ++k) held[support.node][k] |= support.fixed[k];
    Parts supports("supports");
    for (const auto& [node, fixed] : held) {
      Json motions = Json::array();
      for (std::size_t k = 0; k < 3; ++k)
        if (fixed[k]) motions.push_back(std::array{"x", "y", "rotation"}[k]);
      if (!motions.empty()) supports.add(name(node), std::move(motions));
    }
    supports.put_into(model);
  }

  /// u_a = u_b in x, and then in y.
  void pins(Json& model) const {
    using Kind = solver::Coordinate::Kind;
    const auto ties = [](const solver::LinearConstraint& tie, Kind kind) {
      return tie.terms.size() == 2 && tie.terms[0].first.kind == kind &&
             tie.terms[1].first.kind == kind && tie.terms[0].second == 1 &&
             tie.terms[1].second == -1;
    };
    Parts pins("pins");
    const std::vector<solver::LinearConstraint>& all = model_.constraints;
    for (std::size_t i = 0; i < all.size(); i += 2) {
      const bool is_pin = i + 1 < all.size() && ties(all[i], Kind::x) &&
                          ties(all[i + 1], Kind::y) &&
                          all[i].terms[0].first.node == all[i + 1].terms[0].first.node &&
                          all[i].terms[1].first.node == all[i + 1].terms[1].first.node;
      solver::require(is_pin, "a case file has no words for its constraint '" + all[i].name + "'");
      pins.add(all[i].name,
               {{"nodes", {name(all[i].terms[0].first.node), name(all[i].terms[1].first.node)}}});
    }
    pins.put_into(model);
  }

  [[nodiscard]] Json load_json(Index node, const Eigen::Vector3d& force) const {
    Json load = {{"node", name(node)}, {"force_N", point(force.head<2>())}};
    if (force.z() != 0) load["moment_N_m"] = force.z();
    return load;
  }

  void large_motion(const solver::large_motion::LargeMotionModel& joints, Json& model) const {
    Parts sliders("sliders"), springs("axial_springs"), followers("follower_loads");
    for (const solver::large_motion::Slider& one : joints.sliders) {
      Json slider = {{"node", name(one.node)},
                     {"direction_rad", one.direction},
                     {"keeps_angle", one.keeps_angle}};
      if (one.rail >= 0) slider["rail"] = name(one.rail);
      sliders.add(one.name, std::move(slider));
    }
    for (const solver::large_motion::LineSpring& one : joints.line_springs) {
      Json spring = {{"nodes", {name(one.nodes[0]), name(one.nodes[1])}},
                     {"stiffness_N_per_m", one.stiffness}};
      if (!std::isnan(one.rest_length)) spring["rest_length_m"] = one.rest_length;
      springs.add(one.name, std::move(spring));
    }
    for (const solver::large_motion::FollowerLoad& one : joints.follower_loads)
      followers.add("", load_json(one.node, one.force));
    sliders.put_into(model);
    springs.put_into(model);
    followers.put_into(model);
  }

  void loads(Json& model) const {
    Parts loads("loads");
    for (std::size_t i = 0; i < model_.loads.size(); ++i) {
      const std::string written = i < names_.loads.size() ? names_.loads[i] : "";
      loads.add(written, load_json(model_.loads[i].node, model_.loads[i].force));
    }
    std::map<Index, Eigen::Vector3d> of_edges;
    for (const solver::EdgeLoad& load : model_.edge_loads) {
      const std::array<Eigen::Vector2d, 3> forces = solver::edge_forces(model_, load);
      for (std::size_t i = 0; i < 3; ++i) {
        if (load.nodes[i] < 0) continue;
        of_edges.try_emplace(load.nodes[i], Eigen::Vector3d::Zero()).first->second.head<2>() +=
            forces[i];
      }
    }
    for (const auto& [node, force] : of_edges) loads.add("", load_json(node, force));
    loads.put_into(model);
  }

  const Model& model_;
  const WrittenNames& names_;
  SectionTable table_;
  std::vector<std::string> node_;  ///< names, each its own
};

}  // namespace

bool is_tapered(const solver::Member& member) {
  const auto numbers = [](const solver::Section& s) {
    return std::array{
        s.EA, s.EI, s.kappa_GA, s.mass_per_length, s.inertia_per_length, s.area, s.section_modulus};
  };
  const auto a = numbers(member.section), b = numbers(member.end_section);
  return !std::ranges::equal(
      a, b, [](double x, double y) { return x == y || std::abs(x - y) <= 1e-14 * std::abs(x); });
}

Json model_json(Model model, const solver::large_motion::LargeMotionModel& joints,
                const WrittenNames& names) {
  cut_tapers(model);
  return ModelWriter(model, names).write(joints);
}

}  // namespace trammel::harness
