#include "solver/manipulator/manipulator.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "solver/elements/platform_mesh.h"
#include "solver/model/model.h"

namespace trammel::solver {

namespace {

/// Indices of the nodes A1, B1, C1 and P in a built model. Nodes of the plate follow P.
constexpr Index kA = 0;
constexpr Index kB = 3;
constexpr Index kC = 6;
constexpr Index kP = 9;

std::string numbered(char letter, std::size_t i) {
  std::string name(1, letter);
  name += std::to_string(i + 1);
  return name;
}

bool positive(double number) {
  return number > 0 && std::isfinite(number);
}

double platform_area(const std::array<Vector2d, 3>& c) {
  return std::abs(cross(c[1] - c[0], c[2] - c[0])) / 2;
}

/// Returns false if the corners C_i are collinear, so that the area of their triangle is only a
/// round-off error.
bool has_area(const std::array<Vector2d, 3>& c) {
  const double size = std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  return platform_area(c) > 1e-12 * size * size;
}

/// Sets the connection between a link end and its node according to the type of the joint. The
/// connection is a spring for `sprung`, a weld for the type `rigid`, and a hinge for all other
/// types.
template <class Kind>
void set_end_joint(const Joint<Kind>& joint, Kind rigid, const std::string& name, MemberEnd& end) {
  if (joint.kind == Kind::sprung) {
    require(positive(joint.stiffness), "the spring stiffness of the " + name + " must be positive");
    end.fixity = EndFixity::sprung;
    end.stiffness = joint.stiffness;
  } else {
    end.fixity = joint.kind == rigid ? EndFixity::welded : EndFixity::hinged;
  }
}

bool is_eq25(PlatformJointKind kind) {
  return kind == PlatformJointKind::eq25_mean || kind == PlatformJointKind::eq25_sum;
}

void check_platform_joints(const ManipulatorDesign& design) {
  const auto& joints = design.platform_joint;
  for (std::size_t i = 0; i < 3; ++i) {
    const PlatformJointKind kind = joints[i].kind;
    const std::string C = numbered('C', i);
    if (is_eq25(kind))
      require(joints[0].kind == joints[1].kind && joints[1].kind == joints[2].kind,
              "joint types eq25-mean and eq25-sum relate the platform's rotation to the rotations "
              "of all link ends: choose the same joint type for C1, C2 and C3");
    if (design.platform.kind == PlatformDesign::Kind::rigid) continue;
    for (const auto& [joint, problem] :
         {std::pair(PlatformJointKind::welded, "a link cannot be welded to the platform at "),
          {PlatformJointKind::sprung,
           "a spring cannot join a link's rotation to the platform at "}})
      require(kind != joint, problem + C +
                                 ": a node of constant-strain triangles has no rotation; choose "
                                 "hinged, or a rigid platform");
    require(!is_eq25(kind),
            "joint types eq25-mean and eq25-sum require a rigid platform: a platform of triangles "
            "has no single rotation; choose hinged, or a rigid platform");
  }
}

Member make_member(const LinkDesign& link, double length, const std::string& first_name,
                   const std::string& second_name, Index first) {
  Member member;
  member.name = first_name + "-" + second_name;
  member.nodes = {first, first + 3};
  member.section = member.end_section = link_section(link, length);
  member.theory = link.theory;
  member.mass = link.mass_matrix;
  member.elements = link.elements;
  member.axially_flexible = link.axially_flexible;
  for (MemberEnd& end : member.ends) end.inertia = link.inertia.value_or(0) / 2;
  return member;
}

void add_limb(const ManipulatorDesign& design, std::size_t i, Model& model) {
  const auto k = static_cast<Index>(i);
  const ManipulatorGeometry& g = design.geometry;
  const std::string A = numbered('A', i), B = numbered('B', i), C = numbered('C', i);
  const bool grounded = design.active[i].kind != ActiveKind::free;
  model.supports.push_back({A, kA + k, {true, true, grounded}});
  Member proximal = make_member(design.proximal[i], g.proximal[i], A, B, kA + k);
  Member distal = make_member(design.distal[i], g.distal[i], B, C, kB + k);
  set_end_joint(design.active[i], ActiveKind::locked, "active joint " + A, proximal.ends[0]);
  set_end_joint(design.elbow[i], ElbowKind::welded, "elbow joint " + B, distal.ends[0]);
  set_end_joint(design.platform_joint[i], PlatformJointKind::welded, "platform joint " + C,
                distal.ends[1]);
  model.members.push_back(std::move(proximal));
  model.members.push_back(std::move(distal));
}

void add_rigid_platform(const ManipulatorDesign& design, const Eigen::Matrix2d& R_WP,
                        Model& model) {
  model.rigid_bodies.push_back({"platform", kP, {kC, kC + 1, kC + 2}});
  const PlatformMass mass = platform_mass(design);
  model.masses.push_back({kP, mass.mass, mass.inertia, R_WP * mass.center});

  const PlatformJointKind kind = design.platform_joint[0].kind;
  if (!is_eq25(kind)) return;
  LinearConstraint eq25{"eq25", {{Coordinate{Coordinate::Kind::rotation, kP, -1, 0}, 1}}};
  for (Index limb = 0; limb < 3; ++limb)
    eq25.terms.emplace_back(Coordinate{Coordinate::Kind::end_rotation, -1, 2 * limb + 1, 1},
                            kind == PlatformJointKind::eq25_mean ? -1.0 / 3 : -1.0);
  model.constraints.push_back(std::move(eq25));
}

/// Adds two constraints, in x and y, between a pin and the plate nodes i within the pin radius:
///
///   u_pin = sum w_i u_i.
void add_pin(const TriangleMesh& mesh, std::size_t vertex, double radius, Index pin, Index first,
             Model& model) {
  const auto weights = pin_weights(mesh, mesh.nodes[vertex], radius);
  // The distal link at C couples all n mesh nodes of the pin, which adds n^2 entries to the
  // stiffness matrix. P is connected to no link, so that the pin at P needs no limit.
  constexpr std::size_t kMaxNodes = 500;
  require(pin == kP || weights.size() <= kMaxNodes,
          "the pin at C" + std::to_string(pin - kC + 1) + " covers " +
              std::to_string(weights.size()) +
              " nodes of the platform and couples all of them: at most 500 nodes are allowed, so "
              "choose a smaller pin radius or fewer refinements");
  for (const Coordinate::Kind kind : {Coordinate::Kind::x, Coordinate::Kind::y}) {
    LinearConstraint tie;
    tie.name =
        "pin " + model.nodes[to_size(pin)].name + (kind == Coordinate::Kind::x ? " x" : " y");
    tie.terms.emplace_back(Coordinate{kind, pin, -1, 0}, 1);
    for (const auto& [node, weight] : weights)
      tie.terms.emplace_back(Coordinate{kind, first + node, -1, 0}, -weight);
    model.constraints.push_back(std::move(tie));
  }
}

void add_triangles(const ManipulatorDesign& design, const Pose& pose, const Eigen::Matrix2d& R_WP,
                   Model& model) {
  const PlatformDesign& platform = design.platform;
  const Material& material = platform.material;
  require(positive(platform.thickness), "the platform's thickness must be positive");
  require(positive(material.E), "the platform's Young's modulus must be positive");
  require(material.nu > -1 && material.nu < 0.5,
          "the platform's Poisson's ratio must lie between -1 and 0.5");
  require(!platform.inertia.has_value(),
          "a given platform inertia requires a rigid platform: the inertia of triangles follows "
          "from their mass");
  require(platform.pin_radius >= 0 && std::isfinite(platform.pin_radius),
          "the pin radius must not be negative");
  const double area = platform_area(design.geometry.platform);
  Plate plate{"platform", material, platform.thickness};
  plate.material.rho = platform_mass(design).mass / (platform.thickness * area);
  model.plates.push_back(plate);

  const TriangleMesh mesh = platform_mesh(design.geometry.platform, Vector2d::Zero(),
                                          platform.refinements, platform.six_nodes);
  const bool pinned = platform.pin_radius > 0;
  // Without pins, the first four mesh nodes C1, C2, C3, P are already model nodes, in this order
  // from index kC. Mesh node n is then model node kC + n. With pins, the mesh nodes follow P.
  const Index first = pinned ? kP + 1 : kC;
  const std::size_t shared = pinned ? 0 : 4;
  for (std::size_t n = shared; n < mesh.nodes.size(); ++n)
    model.nodes.push_back({"", pose.position() + R_WP * mesh.nodes[n]});
  model.triangles.reserve(mesh.triangles.size());
  for (TriangleMesh::Nodes t : mesh.triangles) {
    for (Index& node : t) node = node < 0 ? -1 : first + node;
    model.triangles.push_back({0, t});
  }
  if (!pinned) return;
  for (std::size_t v = 0; v < 4; ++v)
    add_pin(mesh, v, platform.pin_radius, kC + static_cast<Index>(v), first, model);
}

void restrict_effects(LinkDesign& link, Effects active) {
  if (!active.has(Effect::axial_flexibility)) link.axially_flexible = false;
  link.theory = beam_theory(has_shear_deformation(link.theory) && active.has(Effect::shear),
                            has_rotary_inertia(link.theory) && active.has(Effect::rotary_inertia));
  if (active.has(Effect::link_mass)) return;
  link.mass = 0;
  link.inertia.reset();
}

}  // namespace

template <Real T>
SectionOf<T> link_section(const LinkDesignOf<T>& link, const std::type_identity_t<T>& length) {
  for (const auto& [name, number] : {std::pair("length", value(length)),
                                     {"thickness", value(link.thickness)},
                                     {"width", value(link.width)},
                                     {"Young's modulus", value(link.material.E)},
                                     {"shear coefficient", link.shear_coefficient}})
    require(positive(number), std::string("a link's ") + name + " must be positive");
  require(value(link.material.nu) > -1 && value(link.material.nu) <= 0.5,
          "a link's Poisson's ratio must lie between -1 and 0.5");
  require(link.elements >= 1, "a link requires at least one element");
  const T mass =
      link.mass ? T(*link.mass) : T(link.material.rho * link.thickness * link.width * length);
  for (const auto& [name, number] :
       {std::pair("mass", value(mass)), {"inertia", link.inertia.value_or(0)}})
    require(number >= 0 && std::isfinite(number),
            std::string("a link's ") + name + " must not be negative");

  const T area = link.thickness * link.width;
  const T second_moment = area * link.thickness * link.thickness / 12.0;
  const T G = link.material.E / (2.0 * (1.0 + link.material.nu));
  SectionOf<T> section;
  section.EA = link.material.E * area;
  section.EI = link.material.E * second_moment;
  section.kappa_GA = link.shear_coefficient * G * area;
  section.mass_per_length = mass / length;
  section.inertia_per_length = mass / length * second_moment / area;
  section.area = area;
  section.section_modulus = second_moment / (link.thickness / 2.0);
  return section;
}

template <Real T>
PlatformMassOf<T> platform_mass(const PlatformDesignOf<T>& platform,
                                const std::array<Vector2d, 3>& c) {
  PlatformMassOf<T> result;
  result.center = (c[0] + c[1] + c[2]) / 3;
  if (platform.mass) {
    result.mass = T(*platform.mass);
  } else {
    require(has_area(c), "the triangle C1 C2 C3 has no area, so the platform requires a mass");
    require(positive(value(platform.thickness)), "the platform's thickness must be positive");
    result.mass = platform.material.rho * platform.thickness * platform_area(c);
  }
  require(value(result.mass) >= 0 && std::isfinite(value(result.mass)),
          "the platform's mass must not be negative");
  if (platform.inertia) {
    result.inertia = *platform.inertia - result.mass * result.center.squaredNorm();
    require(value(result.inertia) >= 0 && std::isfinite(value(result.inertia)),
            "the platform's inertia about P must be at least its mass times the square of the "
            "distance from P to its center of mass");
  } else {
    const double sides_squared =
        (c[1] - c[0]).squaredNorm() + (c[2] - c[1]).squaredNorm() + (c[0] - c[2]).squaredNorm();
    result.inertia = result.mass * sides_squared / 36.0;
  }
  return result;
}

PlatformMass platform_mass(const ManipulatorDesign& design) {
  return platform_mass(design.platform, design.geometry.platform);
}

template SectionOf<double> link_section(const LinkDesignOf<double>&, const double&);
template SectionOf<Dual> link_section(const LinkDesignOf<Dual>&, const Dual&);
template PlatformMassOf<double> platform_mass(const PlatformDesignOf<double>&,
                                              const std::array<Vector2d, 3>&);
template PlatformMassOf<Dual> platform_mass(const PlatformDesignOf<Dual>&,
                                            const std::array<Vector2d, 3>&);

Model build_manipulator(const ManipulatorDesign& design, const Pose& pose) {
  const Posture posture = inverse_kinematics(design.geometry, pose);
  require(posture.outcome.solved(), posture.outcome.reason);
  check_platform_joints(design);

  Model model;
  for (const auto& [letter, places] :
       {std::pair('A', design.geometry.base), {'B', posture.B}, {'C', posture.C}}) {
    for (std::size_t i = 0; i < 3; ++i) model.nodes.push_back({numbered(letter, i), places[i]});
  }
  model.nodes.push_back({"P", pose.position()});
  for (std::size_t i = 0; i < 3; ++i) add_limb(design, i, model);

  const Eigen::Matrix2d R_WP = Eigen::Rotation2Dd(pose.phi).toRotationMatrix();
  if (design.platform.kind == PlatformDesign::Kind::rigid) {
    add_rigid_platform(design, R_WP, model);
  } else {
    require(has_area(design.geometry.platform), "the platform's triangle C1 C2 C3 has no area");
    add_triangles(design, pose, R_WP, model);
  }
  return model;
}

ManipulatorDesign restrict_effects(ManipulatorDesign design, Effects active) {
  for (std::size_t i = 0; i < 3; ++i) {
    restrict_effects(design.proximal[i], active);
    restrict_effects(design.distal[i], active);
    if (active.has(Effect::joint_compliance)) continue;
    if (design.active[i].kind == ActiveKind::sprung) design.active[i] = {ActiveKind::locked};
    if (design.elbow[i].kind == ElbowKind::sprung) design.elbow[i] = {ElbowKind::welded};
    if (design.platform_joint[i].kind == PlatformJointKind::sprung)
      design.platform_joint[i] = {PlatformJointKind::welded};
  }
  if (!active.has(Effect::platform_flexibility)) {
    design.platform.kind = PlatformDesign::Kind::rigid;
    design.platform.refinements = 0;
    design.platform.six_nodes = false;
    design.platform.pin_radius = 0;
  }
  return design;
}

}  // namespace trammel::solver
