#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "harness/export/exported_case.h"
#include "harness/readers/model_fields.h"
#include "harness/readers/model_reader.h"
#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using solver::Index;
using solver::Model;

/// Returns a quotient and its two adjacent doubles. These include every double x for which
/// x * divisor == product in floating-point arithmetic.
std::array<double, 3> quotients(double product, double divisor) {
  const double x = product / divisor, beyond = std::numeric_limits<double>::infinity();
  return {x, std::nextafter(x, 0), std::nextafter(x, beyond)};
}

/// Returns the first candidate value that satisfies the predicate, or else the first candidate.
template <class Gives>
double first_match(const std::array<double, 3>& candidates, const Gives& gives) {
  for (const double x : candidates)
    if (gives(x)) return x;
  return candidates.front();
}

/// Returns a second moment of area that reproduces both the stiffness and the rotary inertia
/// exactly. If no such value exists, the result reproduces only the stiffness.
double second_moment(const solver::Section& section, const solver::Material& material) {
  const auto candidates = quotients(section.EI, material.E);
  const auto stiff = [&](double I) { return material.E * I == section.EI; };
  for (const double I : candidates)
    if (stiff(I) && material.rho * I == section.inertia_per_length) return I;
  return first_match(candidates, stiff);
}

double shear_coefficient(const solver::Section& section, const solver::Material& material) {
  const double G = material.E / (2 * (1 + material.nu));
  const auto gives = [&](double k) { return k * G * section.area == section.kappa_GA; };
  constexpr double kRectangle = 5.0 / 6.0;
  if (gives(kRectangle)) return kRectangle;
  return first_match(quotients(section.kappa_GA / section.area, G), gives);
}

bool nearly(double a, double b) {
  return std::abs(a - b) <= 4 * solver::kEps * std::abs(b);
}

/// Materials and sections of a built model as objects of a case file, each stored once by name.
class SectionTable {
 public:
  /// @param known  named materials of the case. A section whose properties agree up to round-off
  ///     reuses such a material
  explicit SectionTable(std::vector<std::pair<std::string, solver::Material>> known)
      : materials_(std::move(known)), used_(materials_.size(), false) {}

  /// Returns the name of the section and adds the section if it is new. Area, second moment, shear
  /// coefficient and half depth reproduce the stiffnesses of the section to the last bit if
  /// possible.
  [[nodiscard]] std::string name_of(const solver::Section& section);
  [[nodiscard]] std::string name_of(const solver::Material& material);

  /// Returns the materials that are used by a section or plate.
  [[nodiscard]] std::vector<std::pair<std::string, solver::Material>> materials() const;
  [[nodiscard]] const Json& sections() const { return sections_; }

 private:
  [[nodiscard]] solver::Material material_of(const solver::Section& section) const;

  std::vector<std::pair<std::string, solver::Material>> materials_;
  std::vector<bool> used_;
  Json sections_ = Json::object();
};

solver::Material SectionTable::material_of(const solver::Section& section) const {
  const double A = section.area, mass = section.mass_per_length;
  solver::Material made;
  for (const auto& [name, material] : materials_) {
    if (!nearly(material.E * A, section.EA)) continue;
    const bool exactly = material.E * A == section.EA;
    if (exactly ? material.rho * A == mass : nearly(material.rho * A, mass)) return material;
    made = material;
  }
  if (made.E == 0)
    made.E = first_match(quotients(section.EA, A), [&](double E) { return E * A == section.EA; });
  made.rho = first_match(quotients(mass, A), [&](double rho) { return rho * A == mass; });
  return made;
}

std::string SectionTable::name_of(const solver::Material& material) {
  std::size_t i = 0;
  const auto same = [&](const solver::Material& m) {
    return m.E == material.E && m.rho == material.rho && m.nu == material.nu;
  };
  while (i < materials_.size() && !same(materials_[i].second)) ++i;
  if (i == materials_.size()) {
    materials_.emplace_back("material-" + std::to_string(i + 1), material);
    used_.push_back(false);
  }
  used_[i] = true;
  return materials_[i].first;
}

std::string SectionTable::name_of(const solver::Section& section) {
  const solver::Material material = material_of(section);
  Json made = {{"material", name_of(material)},
               {"area_m2", section.area},
               {"second_moment_m4", second_moment(section, material)},
               {"shear_coefficient", shear_coefficient(section, material)}};
  const double I = made["second_moment_m4"].get<double>(), W = section.section_modulus;
  if (I > 0 && W > 0 && std::isfinite(W))
    made["half_depth_m"] = first_match(quotients(I, W), [&](double c) { return I / c == W; });
  for (const auto& [name, known] : sections_.items())
    if (known == made) return name;
  std::string name = "section-" + std::to_string(sections_.size() + 1);
  sections_[name] = std::move(made);
  return name;
}

std::vector<std::pair<std::string, solver::Material>> SectionTable::materials() const {
  std::vector<std::pair<std::string, solver::Material>> used;
  for (std::size_t i = 0; i < materials_.size(); ++i)
    if (used_[i]) used.push_back(materials_[i]);
  return used;
}

/// Writes the fields of a part of the model as the JSON object that `FieldReader` reads.
struct FieldWriter {
  const std::vector<std::string>& node;  ///< names of the model's nodes, by index
  SectionTable& table;
  Json json = Json::object();

  template <class T>
  void required(const char* key, const T& member) {
    json[key] = json_of(member);
  }
  template <class T>
  void defaulted(const char* key, const T& member) {
    required(key, member);
  }
  template <class T>
  void optional(const char* key, const T& member) {
    if (!is_empty(member)) required(key, member);
  }

  template <class T>
  [[nodiscard]] static bool is_empty(const T& value) {
    return value == T{};
  }
  [[nodiscard]] static bool is_empty(double value) { return value == 0 || std::isnan(value); }
  [[nodiscard]] static bool is_empty(const Eigen::Vector2d& pair) { return pair.isZero(0); }
  [[nodiscard]] static bool is_empty(NodeNames<Index> node) { return node.indices < 0; }

  /// Converts an enumeration to its word in case files, and other types as the JSON library does.
  template <class T>
  [[nodiscard]] static Json json_of(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      return kWords<T>.at(static_cast<std::size_t>(value));
    } else {
      return value;
    }
  }
  [[nodiscard]] static Json json_of(const std::array<solver::MemberEnd, 2>& ends) {
    Json both = Json::array();
    for (const solver::MemberEnd& end : ends) {
      const bool sprung = end.fixity == solver::EndFixity::sprung;
      both.push_back(sprung ? Json{{"spring_N_m_per_rad", end.stiffness}} : json_of(end.fixity));
    }
    return both;
  }
  [[nodiscard]] Json json_of(const solver::Section& section) const {
    return table.name_of(section);
  }
  [[nodiscard]] Json json_of(const solver::Material& material) const {
    return table.name_of(material);
  }
  [[nodiscard]] Json json_of(NodeNames<Index> name) const {
    return node[solver::to_size(name.indices)];
  }
  template <class Indices>
  [[nodiscard]] Json json_of(NodeNames<Indices> nodes) const {
    Json names = Json::array();
    for (const Index index : nodes.indices)
      if (index >= 0) names.push_back(node[solver::to_size(index)]);
    return names;
  }
};

/// JSON objects below one key of a model, such as "members". The set of names speeds up lookups.
class Parts {
 public:
  explicit Parts(const char* kind) : kind_(kind) {}

  /// Adds a part of the model. A part without a name is named by key and number, such as "loads-2".
  void add(std::string name, Json part) {
    if (name.empty()) name = kind_ + ("-" + std::to_string(json_.size() + 1));
    solver::require(names_.insert(name).second,
                    std::string("two ") + kind_ + " have the name '" + name + "'");
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

/// Replaces tapered members by chains of uniform members, one per element. Each uniform member has
/// the section at the middle of the element that it replaces.
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
      add_member_chain(member, {}, at(0), at(1), std::ssize(model.nodes), model);
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
    Parts nodes("nodes");
    for (std::size_t i = 0; i < node_.size(); ++i) nodes.add(node_[i], model_.nodes[i].position);
    nodes.put_into(parts_);
    add("members", model_.members);
    add_plates();
    add("rigid_bodies", model_.rigid_bodies);
    add("point_masses", model_.masses);
    add("springs", model_.springs);
    add_supports();
    add("pins", pins());
    add("sliders", joints.sliders);
    add("axial_springs", joints.line_springs);
    add("follower_loads", joints.follower_loads);
    add("loads", loads(), names_.loads);
    if (!model_.gravity.isZero(0)) parts_["gravity_m_s2"] = model_.gravity;
    Json model = Json::object();
    Parts materials("materials");
    for (const auto& [name, material] : table_.materials()) materials.add(name, json_of(material));
    materials.put_into(model);
    if (!table_.sections().empty()) model["sections"] = table_.sections();
    model.update(parts_);
    return model;
  }

 private:
  template <class T>
  [[nodiscard]] Json json_of(T part) {
    FieldWriter writer{node_, table_};
    visit_fields(writer, part);
    return std::move(writer.json);
  }

  /// @param names  names of the first `parts`. They are used if the C++ type of a part has no
  ///   member `name`
  template <class T>
  void add(const char* kind, const std::vector<T>& parts,
           const std::vector<std::string>& names = {}) {
    Parts written(kind);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      std::string name = i < names.size() ? names[i] : "";
      if constexpr (requires { parts[i].name; }) name = parts[i].name;
      written.add(name, json_of(parts[i]));
    }
    written.put_into(parts_);
  }

  void add_plates() {
    std::vector<Json> triangles(model_.plates.size(), Json::array());
    for (const solver::Triangle& triangle : model_.triangles) {
      Json names = Json::array();
      for (const Index node : triangle.nodes)
        if (node >= 0) names.push_back(node_[solver::to_size(node)]);
      triangles[solver::to_size(triangle.plate)].push_back(std::move(names));
    }
    Parts plates("plates");
    for (std::size_t i = 0; i < model_.plates.size(); ++i) {
      if (triangles[i].empty()) continue;
      Json plate = json_of(model_.plates[i]);
      plate["triangles"] = std::move(triangles[i]);
      plates.add(model_.plates[i].name, std::move(plate));
    }
    plates.put_into(parts_);
  }

  /// Merges all supports of a node into one support per node.
  void add_supports() {
    std::map<Index, std::array<bool, 3>> held;
    for (const solver::Support& support : model_.supports)
      for (std::size_t k = 0; k < 3; ++k) held[support.node][k] |= support.fixed[k];
    Parts supports("supports");
    for (const auto& [node, fixed] : held) {
      Json motions = Json::array();
      for (std::size_t k = 0; k < 3; ++k)
        if (fixed[k]) motions.push_back(kWords<NodeMotion>[k]);
      if (!motions.empty()) supports.add(node_[solver::to_size(node)], std::move(motions));
    }
    supports.put_into(parts_);
  }

  /// Combines each two successive constraints of nodes a and b (u_a = u_b in x, then in y) into a
  /// pin.
  [[nodiscard]] std::vector<Pin> pins() const {
    using Kind = solver::Coordinate::Kind;
    const auto ties = [](const solver::LinearConstraint& tie, Kind kind) {
      return tie.terms.size() == 2 && tie.terms[0].first.kind == kind &&
             tie.terms[1].first.kind == kind && tie.terms[0].second == 1 &&
             tie.terms[1].second == -1;
    };
    std::vector<Pin> pins;
    const std::vector<solver::LinearConstraint>& all = model_.constraints;
    for (std::size_t i = 0; i < all.size(); i += 2) {
      const bool is_pin = i + 1 < all.size() && ties(all[i], Kind::x) &&
                          ties(all[i + 1], Kind::y) &&
                          all[i].terms[0].first.node == all[i + 1].terms[0].first.node &&
                          all[i].terms[1].first.node == all[i + 1].terms[1].first.node;
      solver::require(is_pin, "a case file cannot express the constraint '" + all[i].name + "'");
      pins.push_back({all[i].name, {all[i].terms[0].first.node, all[i].terms[1].first.node}});
    }
    return pins;
  }

  /// Returns the nodal loads, followed by the equivalent nodal forces of edge loads, summed for
  /// each node.
  [[nodiscard]] std::vector<solver::NodalLoad> loads() const {
    std::vector<solver::NodalLoad> loads = model_.loads;
    std::map<Index, Eigen::Vector3d> of_edges;
    for (const solver::EdgeLoad& load : model_.edge_loads) {
      const std::array<Eigen::Vector2d, 3> forces = solver::edge_forces(model_, load);
      for (std::size_t i = 0; i < 3; ++i) {
        if (load.nodes[i] < 0) continue;
        of_edges.try_emplace(load.nodes[i], Eigen::Vector3d::Zero()).first->second.head<2>() +=
            forces[i];
      }
    }
    for (const auto& [node, force] : of_edges) loads.push_back({node, force});
    return loads;
  }

  const Model& model_;
  const WrittenNames& names_;
  SectionTable table_;
  std::vector<std::string> node_;  ///< unique names of the nodes
  Json parts_ = Json::object();
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
