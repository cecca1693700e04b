#include <cmath>

#include "harness/statics_modes/analyses.h"
#include "solver/elements/frame_element.h"
#include "solver/elements/triangle_element.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"
#include "solver/model/quadrature.h"

namespace trammel::harness {
namespace {

/// Mass, center of mass, and moment of inertia about the center of mass.
struct Body {
  double mass = 0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double inertia = 0;
};

Body join(const Body& a, const Body& b) {
  Body both;
  both.mass = a.mass + b.mass;
  if (both.mass == 0) return {0, a.center, a.inertia + b.inertia};
  both.center = (a.mass * a.center + b.mass * b.center) / both.mass;
  both.inertia = a.inertia + b.inertia + a.mass * (a.center - both.center).squaredNorm() +
                 b.mass * (b.center - both.center).squaredNorm();
  return both;
}

/// Returns mass, center of mass and moment of inertia of a member, whose elements have constant
/// sections. Includes the rotary inertia of the cross-section if the beam theory includes rotary
/// inertia.
Body body_of(const solver::Model& model, const solver::Member& member) {
  const Eigen::Vector2d start = model.nodes[solver::to_size(member.nodes[0])].position;
  const Eigen::Vector2d end = model.nodes[solver::to_size(member.nodes[1])].position;
  const auto count = static_cast<double>(member.elements);
  const double length = (end - start).norm() / count;
  const bool rotary = solver::has_rotary_inertia(member.theory);
  Body whole;
  for (solver::Index e = 0; e < member.elements; ++e) {
    const double s = (static_cast<double>(e) + 0.5) / count;
    const solver::Section section = solver::section_at(member, s);
    const double mass = section.mass_per_length * length;
    const double j = rotary ? section.inertia_per_length * length : 0;
    whole = join(whole, {mass, start + s * (end - start), mass * length * length / 12 + j});
  }
  whole.inertia += member.ends[0].inertia + member.ends[1].inertia;
  return whole;
}

/// Returns mass and center of mass of a six-node triangle by numerical integration, because its
/// sides may be curved.
Body body_of_six_node_triangle(const solver::Model& model, const solver::Triangle& triangle) {
  const solver::Plate& plate = model.plates[solver::to_size(triangle.plate)];
  Body whole;
  for (const solver::TriangleQuadraturePoint& point : solver::triangle_quadrature()) {
    const auto here = solver::evaluate_shape_functions(model, triangle, point.area_coordinates);
    const double mass = plate.material.rho * plate.thickness * here.area * point.weight;
    whole = join(whole, {mass, here.position, 0});
  }
  return whole;
}

Body body_of(const solver::Model& model, const solver::Triangle& triangle) {
  if (triangle.quadratic()) return body_of_six_node_triangle(model, triangle);
  const auto corner = [&](std::size_t i) {
    return model.nodes[solver::to_size(triangle.nodes[i])].position;
  };
  const Eigen::Vector2d a = corner(1) - corner(0), b = corner(2) - corner(0), c = b - a;
  const solver::Plate& plate = model.plates[solver::to_size(triangle.plate)];
  const double area = std::abs(solver::cross(a, b)) / 2;
  const double mass = plate.material.rho * plate.thickness * area;
  return {mass, (corner(0) + corner(1) + corner(2)) / 3,
          mass * (a.squaredNorm() + b.squaredNorm() + c.squaredNorm()) / 36};
}

void record_body(const std::string& name, const Body& body, Recorder& record) {
  record.add("mass_kg", name, body.mass);
  record.add("inertia_kg_m2", name, body.inertia);
}

}  // namespace

StepResult analyze_properties(const JsonView&, const CaseModel& case_model, std::size_t step, bool,
                              Recorder& record) {
  const solver::Model model = build_model(case_model, step);
  Body total;
  for (const solver::Member& member : model.members) {
    const Body body = body_of(model, member);
    const Eigen::Vector2d span = model.nodes[solver::to_size(member.nodes[1])].position -
                                 model.nodes[solver::to_size(member.nodes[0])].position;
    record.add("length_m", member.name, span.norm());
    record_body(member.name, body, record);
    total = join(total, body);
  }
  std::vector<Body> plates(model.plates.size());
  for (const solver::Triangle& triangle : model.triangles) {
    Body& plate = plates[solver::to_size(triangle.plate)];
    plate = join(plate, body_of(model, triangle));
  }
  for (std::size_t p = 0; p < plates.size(); ++p) {
    record_body(model.plates[p].name, plates[p], record);
    total = join(total, plates[p]);
  }
  for (const solver::PointMass& mass : model.masses) {
    const solver::Node& node = model.nodes[solver::to_size(mass.node)];
    const Body body{mass.mass, node.position + mass.offset, mass.inertia};
    const bool is_platform = case_model.manipulator && model.plates.empty() && node.name == "P" &&
                             &mass == &model.masses.front();
    record_body(is_platform ? "platform" : "at-" + node.name, body, record);
    total = join(total, body);
  }
  record_body("total", total, record);
  record.add("center_x_m", "total", total.center.x());
  record.add("center_y_m", "total", total.center.y());
  return {};
}

}  // namespace trammel::harness
