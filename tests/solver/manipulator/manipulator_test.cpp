#include "solver/manipulator/manipulator.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "solver/elements/platform_mesh.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(manipulator)

namespace {

using namespace trammel::solver;
using boost::test_tools::tolerance;

/// Returns the name of a link of limb i: "A1-B1" or "B1-C1" for the first limb.
std::string link_name(char first, char second, std::size_t i) {
  const std::string n = std::to_string(i);
  std::string name(1, first);
  name.append(n).append("-").append(1, second).append(n);
  return name;
}

const Member& member(const Model& model, const std::string& name) {
  for (const Member& m : model.members)
    if (m.name == name) return m;
  throw std::runtime_error("no member " + name);
}

Vector2d position(const Model& model, Index node) {
  return model.nodes.at(static_cast<std::size_t>(node)).position;
}

double triangle_area(const Model& model, const Triangle& t) {
  const Vector2d u = position(model, t.nodes[1]) - position(model, t.nodes[0]);
  const Vector2d v = position(model, t.nodes[2]) - position(model, t.nodes[0]);
  return (u.x() * v.y() - u.y() * v.x()) / 2;
}

/// Mass, first moment of mass, and polar moment of inertia of the platform, about the origin.
struct Bulk {
  double mass = 0;
  Vector2d first_moment = Vector2d::Zero();
  double inertia = 0;
};

Bulk platform_bulk(const Model& model) {
  Bulk bulk;
  for (const PointMass& m : model.masses) {
    const Vector2d x = position(model, m.node) + m.offset;
    bulk.mass += m.mass;
    bulk.first_moment += m.mass * x;
    bulk.inertia += m.inertia + m.mass * x.squaredNorm();
  }
  for (const Triangle& t : model.triangles) {
    const Plate& plate = model.plates.at(static_cast<std::size_t>(t.plate));
    const double m = plate.material.rho * plate.thickness * triangle_area(model, t);
    Vector2d sum = Vector2d::Zero();
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += position(model, t.nodes[k]);
      squares += position(model, t.nodes[k]).squaredNorm();
    }
    bulk.mass += m;
    bulk.first_moment += m * sum / 3;
    bulk.inertia += m * (squares + sum.squaredNorm()) / 12;  // exact for a uniform triangle
  }
  return bulk;
}

/// Returns the error message for an invalid design, or an empty text.
std::string refusal(const ManipulatorDesign& design, const Pose& pose = centered_pose()) {
  try {
    (void)build_manipulator(design, pose);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

ManipulatorDesign rigid_design() {
  ManipulatorDesign design = table_1_design();
  design.platform.kind = PlatformDesign::Kind::rigid;
  return design;
}

/// Returns a manipulator design without symmetry: unequal links, base and platform, and P off the
/// centroid of the platform.
ManipulatorDesign uneven_design() {
  ManipulatorDesign design = table_1_design();
  design.geometry = uneven_geometry();
  return design;
}

}  // namespace

BOOST_AUTO_TEST_CASE(node_positions_are_those_of_the_kinematics) {
  const ManipulatorDesign design = uneven_design();
  const Pose pose{0.27, 0.14, 0.2};
  const Model model = build_manipulator(design, pose);
  const Posture posture = inverse_kinematics(design.geometry, pose);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i + 1);
    BOOST_TEST(position(model, model.find_node("A" + n)) == design.geometry.base[i]);
    BOOST_TEST(position(model, model.find_node("B" + n)) == posture.B[i]);
    BOOST_TEST(position(model, model.find_node("C" + n)) == posture.C[i]);
    for (const auto& [name, length] :
         {std::pair{link_name('A', 'B', i + 1), design.geometry.proximal[i]},
          std::pair{link_name('B', 'C', i + 1), design.geometry.distal[i]}}) {
      const Member& m = member(model, name);
      const double between = (position(model, m.nodes[1]) - position(model, m.nodes[0])).norm();
      BOOST_TEST(std::abs(between - length) < 1e-15);
    }
  }
  BOOST_TEST(position(model, model.find_node("P")) == Vector2d(0.27, 0.14));
  BOOST_TEST(model.members.size() == 6U);
  BOOST_TEST(model.supports.size() == 3U);
}

BOOST_AUTO_TEST_CASE(link_section_follows_thickness_width_and_density) {
  const ManipulatorDesign design = table_1_design();
  const Section s = member(build_manipulator(design, centered_pose()), "A1-B1").section;
  BOOST_TEST(s.EA == 6.9e10 * 4.5e-5, tolerance(1e-15));
  BOOST_TEST(s.EI == 6.9e10 * 0.03 * 0.0015 * 0.0015 * 0.0015 / 12, tolerance(1e-15));
  BOOST_TEST(s.kappa_GA == 5.0 / 6 * 6.9e10 / 2.66 * 4.5e-5, tolerance(1e-15));
  BOOST_TEST(s.mass_per_length * 0.2 == 0.0243, tolerance(1e-15));
  BOOST_TEST(s.inertia_per_length == 2700 * 0.03 * std::pow(0.0015, 3) / 12, tolerance(1e-14));
  BOOST_TEST(s.section_modulus == 0.03 * 0.0015 * 0.0015 / 6, tolerance(1e-15));
  BOOST_TEST(s.area == 4.5e-5, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(rigid_platform_has_mass_and_inertia_of_its_plate) {
  for (ManipulatorDesign design : {table_1_design(), uneven_design()}) {
    const Pose pose{0.26, 0.15, 0.3};
    design.platform.mass.reset();
    for (const bool printed : {false, true}) {
      if (printed) design.platform.mass = 0.1205;
      design.platform.kind = PlatformDesign::Kind::triangles;
      const Bulk plate = platform_bulk(build_manipulator(design, pose));
      design.platform.kind = PlatformDesign::Kind::rigid;
      const Bulk body = platform_bulk(build_manipulator(design, pose));
      BOOST_TEST(body.mass == plate.mass, tolerance(1e-14));
      BOOST_TEST((body.first_moment - plate.first_moment).norm() < 1e-14 * plate.mass);
      BOOST_TEST(body.inertia == plate.inertia, tolerance(1e-14));
      if (printed) BOOST_TEST(body.mass == 0.1205, tolerance(1e-15));
    }
  }
}

BOOST_AUTO_TEST_CASE(printed_platform_inertia_is_about_P) {
  ManipulatorDesign design = uneven_design();
  design.platform.kind = PlatformDesign::Kind::rigid;
  design.platform.mass = 0.1205;
  design.platform.inertia = 0.000799;
  const Model model = build_manipulator(design, {0.27, 0.14, 0.2});
  BOOST_TEST_REQUIRE(model.masses.size() == 1U);
  const PointMass& m = model.masses[0];
  BOOST_TEST(std::abs(m.inertia + m.mass * m.offset.squaredNorm() - 0.000799) < 1e-18);
  const Vector2d centroid = (position(model, 6) + position(model, 7) + position(model, 8)) / 3;
  BOOST_TEST((position(model, m.node) + m.offset - centroid).norm() < 1e-15);

  design.platform.inertia = 1e-6;
  BOOST_TEST(refusal(design).find("inertia about P must be at least") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(mesh_refinement_keeps_mass_and_inertia) {
  for (ManipulatorDesign design : {table_1_design(), uneven_design()}) {
    const Bulk coarse = platform_bulk(build_manipulator(design, centered_pose()));
    for (int level = 1; level <= 4; ++level) {
      design.platform.refinements = level;
      const Model model = build_manipulator(design, centered_pose());
      const Bulk fine = platform_bulk(model);
      BOOST_TEST(fine.mass == coarse.mass, tolerance(1e-13));
      BOOST_TEST(fine.inertia == coarse.inertia, tolerance(1e-13));
      const auto count = static_cast<std::size_t>(3 * std::pow(4, level));
      BOOST_TEST(model.triangles.size() == count);
      for (const Triangle& t : model.triangles) BOOST_TEST(triangle_area(model, t) > 0);
      // Euler's formula for a disk: V - E + F = 1 with E = (3 F + boundary) / 2.
      const std::size_t boundary = 3 * (std::size_t{1} << static_cast<unsigned>(level));
      const std::size_t plate_nodes = model.nodes.size() - 6;
      BOOST_TEST(plate_nodes + count == 1 + (3 * count + boundary) / 2);
    }
  }
}

BOOST_AUTO_TEST_CASE(clockwise_platform_is_the_same_plate) {
  ManipulatorDesign design = table_1_design();
  const Bulk before = platform_bulk(build_manipulator(design, centered_pose()));
  std::swap(design.geometry.platform[0], design.geometry.platform[1]);
  std::swap(design.geometry.base[0], design.geometry.base[1]);
  const Model model = build_manipulator(design, centered_pose());
  for (const Triangle& t : model.triangles) BOOST_TEST(triangle_area(model, t) > 0);
  BOOST_TEST(platform_bulk(model).inertia == before.inertia, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(pin_weights_reproduce_linear_fields) {
  const auto vertices = uneven_design().geometry.platform;
  for (const auto& [refinements, six_nodes] :
       {std::pair{0, false}, {2, false}, {5, false}, {0, true}, {4, true}}) {
    const TriangleMesh mesh = platform_mesh(vertices, Vector2d::Zero(), refinements, six_nodes);
    for (std::size_t v = 0; v < 4; ++v) {
      double sum = 0;
      Vector2d mean = Vector2d::Zero();
      for (const auto& [node, weight] : pin_weights(mesh, mesh.nodes[v], 0.01)) {
        sum += weight;
        mean += weight * mesh.nodes[static_cast<std::size_t>(node)];
      }
      BOOST_TEST(sum == 1, tolerance(1e-13));
      BOOST_TEST((mean - mesh.nodes[v]).norm() < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(second_moments_of_a_pin_are_those_of_its_kernel) {
  // The weight of a pin is proportional to (1 - r^2)^3, with the distance r from its center
  // relative to the pin radius. Its mean of r^2 is 1/5, half of it from x^2. Triangles of six nodes
  // represent x^2 exactly.
  const double radius = 0.02, area = radius * radius;
  const TriangleMesh mesh =
      platform_mesh(uneven_design().geometry.platform, Vector2d::Zero(), 2, true);
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const auto& [node, weight] : pin_weights(mesh, Vector2d::Zero(), radius)) {
    const Vector2d& x = mesh.nodes[static_cast<std::size_t>(node)];
    moments += weight * x * x.transpose();
  }
  BOOST_TEST((moments / area - Eigen::Matrix2d::Identity() / 10).norm() < 1e-8);
}

BOOST_AUTO_TEST_CASE(pins_hold_the_plate_by_constraints_only) {
  ManipulatorDesign design = table_1_design();
  design.platform.refinements = 3;
  design.platform.pin_radius = 0.01;
  const Model model = build_manipulator(design, centered_pose(0.2));
  BOOST_TEST(model.constraints.size() == 8U);
  for (const Triangle& t : model.triangles) {
    for (std::size_t k = 0; k < 3; ++k) BOOST_TEST(t.nodes[k] > model.find_node("P"));
    BOOST_TEST(triangle_area(model, t) > 0);
  }
  // Every constraint of the model permits rigid motions: a translation and a small rotation.
  for (const LinearConstraint& tie : model.constraints) {
    double translation = 0, rotation = 0, size = 0;
    for (const auto& [coordinate, factor] : tie.terms) {
      const Vector2d x = position(model, coordinate.node);
      translation += factor;
      rotation += factor * (coordinate.kind == Coordinate::Kind::x ? -x.y() : x.x());
      size += std::abs(factor);
    }
    BOOST_TEST(std::abs(translation) < 1e-14 * size);
    BOOST_TEST(std::abs(rotation) < 1e-14 * size);
  }
}

BOOST_AUTO_TEST_CASE(joint_kinds_determine_supports_and_end_fixities) {
  ManipulatorDesign design = rigid_design();
  design.active = {ActiveJoint{ActiveKind::locked}, {ActiveKind::free}, {ActiveKind::sprung, 7}};
  design.elbow = {ElbowJoint{ElbowKind::welded}, {ElbowKind::hinged}, {ElbowKind::sprung, 8}};
  design.platform_joint = {PlatformJoint{PlatformJointKind::welded},
                           {PlatformJointKind::hinged},
                           {PlatformJointKind::sprung, 9}};
  const Model model = build_manipulator(design, centered_pose());
  const auto fixity = [&](const std::string& name, std::size_t end) {
    return member(model, name).ends[end].fixity;
  };
  BOOST_TEST((fixity("A1-B1", 0) == EndFixity::welded && model.supports[0].fixed[2]));
  BOOST_TEST((fixity("A2-B2", 0) == EndFixity::hinged && !model.supports[1].fixed[2]));
  BOOST_TEST((fixity("A3-B3", 0) == EndFixity::sprung && model.supports[2].fixed[2]));
  BOOST_TEST(member(model, "A3-B3").ends[0].stiffness == 7.0);
  BOOST_TEST((fixity("B1-C1", 0) == EndFixity::welded));
  BOOST_TEST((fixity("B2-C2", 0) == EndFixity::hinged));
  BOOST_TEST(member(model, "B3-C3").ends[0].stiffness == 8.0);
  BOOST_TEST((fixity("B1-C1", 1) == EndFixity::welded));
  BOOST_TEST((fixity("B2-C2", 1) == EndFixity::hinged));
  BOOST_TEST(member(model, "B3-C3").ends[1].stiffness == 9.0);
  // The proximal link of each limb is welded to the elbow node, so that the rotation of the node
  // has stiffness.
  for (const char* name : {"A1-B1", "A2-B2", "A3-B3"})
    BOOST_TEST((fixity(name, 1) == EndFixity::welded));
}

BOOST_AUTO_TEST_CASE(invalid_designs_are_refused_with_the_reason) {
  BOOST_TEST(refusal(table_1_design()).empty());
  BOOST_TEST(refusal(rigid_design()).empty());
  struct Row {
    const char* reason;
    std::function<void(ManipulatorDesign&)> change;
  };
  using Kind = PlatformJointKind;
  const std::vector<Row> rows = {
      {"joint types eq25-mean and eq25-sum require a rigid platform",
       [](auto& d) { d.platform_joint.fill({Kind::eq25_mean}); }},
      {"platform at C2: a node of constant-strain triangles has no",
       [](auto& d) { d.platform_joint[1].kind = Kind::welded; }},
      {"platform at C2: a node of constant-strain triangles has no",
       [](auto& d) { d.platform_joint[1].kind = Kind::sprung; }},
      {"choose the same joint type for C1, C2 and C3",
       [](auto& d) {
         d = rigid_design();
         d.platform_joint[0].kind = Kind::eq25_sum;
       }},
      {"choose the same joint type for C1, C2 and C3",
       [](auto& d) {
         d = rigid_design();
         d.platform_joint[1].kind = d.platform_joint[2].kind = Kind::eq25_sum;
       }},
      {"the platform's Poisson's ratio must lie between -1 and 0.5",
       [](auto& d) { d.platform.material.nu = -1; }},
      {"requires a rigid platform", [](auto& d) { d.platform.inertia = 0.000799; }},
      {"the spring stiffness of the active joint A3",
       [](auto& d) { d.active[2].kind = ActiveKind::sprung; }},
      {"the spring stiffness of the elbow joint B1",
       [](auto& d) { d.elbow[0].kind = ElbowKind::sprung; }},
      {"thickness", [](auto& d) { d.proximal[0].thickness = 0; }},
      {"mass", [](auto& d) { d.distal[0].mass = std::nan(""); }},
      {"at least one element", [](auto& d) { d.distal[0].elements = 0; }},
      {"refinements", [](auto& d) { d.platform.refinements = -1; }},
      {"pin radius", [](auto& d) { d.platform.pin_radius = -0.01; }},
      {"choose a smaller pin radius or fewer refinements",
       [](auto& d) {
         d.platform.pin_radius = 0.08;
         d.platform.refinements = 6;
       }},
      {"has no area", [](auto& d) {
         d.geometry.platform = {Vector2d{-0.1, 0}, Vector2d{0.1, 0}, Vector2d{0.05, 0}};
       }}};
  const auto check = [](const std::string& text, const char* reason) {
    BOOST_TEST(text.find(reason) != std::string::npos, text);
  };
  for (const Row& row : rows) {
    ManipulatorDesign design = table_1_design();
    row.change(design);
    check(refusal(design), row.reason);
  }
  ManipulatorDesign off = table_1_design();
  for (Vector2d& c : off.geometry.platform) c += Vector2d(0.2, 0);
  check(refusal(off, {0.05, 0.144, 0}), "P must lie inside the triangle");
  check(refusal(table_1_design(), {-0.2, 0.144, 0}), "limb 2 (A2-B2-C2) cannot reach");
}

BOOST_AUTO_TEST_SUITE_END()
