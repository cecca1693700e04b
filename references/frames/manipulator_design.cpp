#include "references/frames/manipulator_design.h"

namespace trammel::references {

namespace {

/// Vertices of an equilateral triangle about `center`, at 210, 330 and 90 degrees plus `angle`.
std::array<Point2<Real>, 3> triangle(const Point2<Real>& center, const Real& side,
                                     const Real& angle) {
  const Real radius = side / sqrt(Real(3));
  std::array<Point2<Real>, 3> vertices;
  for (int i = 0; i < 3; ++i) {
    const Real direction = angle + Real(pi<Real>() * (7 + 4 * i) / 6);
    vertices[i] = {center[0] + radius * cos(direction), center[1] + radius * sin(direction)};
  }
  return vertices;
}

/// Returns true if a mass or an inertia is a number instead of "from-density" or "from-mass".
bool is_given(const Arguments& object, const std::string& key) {
  return object.has(key) && object[key] != "from-density" && object[key] != "from-mass";
}

/// Returns a given mass [kg] or inertia [kg m^2], or the computed one.
Real given_or(const Arguments& object, const std::string& key, const Real& computed) {
  return is_given(object, key) ? object.positive(key) : computed;
}

FrameMaterial material(const Arguments& manipulator, const std::string& key) {
  const Arguments m(manipulator[key], manipulator.pointer(key), {"E_Pa", "rho_kg_m3", "nu"});
  return {m.positive("E_Pa"), m.positive("rho_kg_m3"), m.number("nu", 0)};
}

/// All that holds for the links of one kind.
Arguments links_of_kind(const Arguments& manipulator, const char* kind) {
  Json links = manipulator["links"];
  if (links.contains(kind)) links.merge_patch(Json(links[kind]));
  for (const char* difference : {"proximal", "distal"}) links.erase(difference);
  return {links,
          manipulator.pointer("links"),
          {"proximal_length_m", "distal_length_m", "thickness_m", "width_m", "mass_kg",
           "inertia_kg_m2", "beam", "shear_coefficient", "axial", "mass_matrix", "elements"}};
}

LinkNumbers link(const Arguments& links, const FrameMaterial& material, const std::string& length,
                 std::size_t limb) {
  LinkNumbers result;
  result.length =
      links[length].is_array() ? links.numbers(length, 3)[limb] : links.positive(length);
  result.center = result.length / 2;
  result.section =
      member_section(rectangle(material, links.positive("thickness_m"), links.positive("width_m"),
                               links.number("shear_coefficient", Real(5) / 6)),
                     links);
  result.mass = given_or(links, "mass_kg", result.section.mass * result.length);
  const Real scale = result.mass / (result.section.mass * result.length);
  result.section.mass *= scale;
  result.section.rotary_inertia *= scale;
  result.has_inertia = is_given(links, "inertia_kg_m2");
  result.inertia =
      given_or(links, "inertia_kg_m2", result.mass * result.length * result.length / 12);
  return result;
}

std::array<Point2<Real>, 3> vertices(const Arguments& object, const std::string& key) {
  const Json& rows = object[key];
  if (!rows.is_array() || rows.size() != 3) object.fail(key, "expected three points");
  std::array<Point2<Real>, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    points[i] = Arguments({{"at", rows[i]}}, object.pointer(key)).point("at");
  }
  return points;
}

void read_platform(const Arguments& manipulator, ManipulatorNumbers& result) {
  const Arguments platform(
      manipulator["platform"], manipulator.pointer("platform"),
      {"kind", "side_m", "vertices_m", "thickness_m", "mass_kg", "inertia_kg_m2", "refinements"});
  const auto corners = platform.has("vertices_m")
                           ? vertices(platform, "vertices_m")
                           : triangle({0, 0}, platform.positive("side_m"), 0);
  Point2<Real>& center = result.platform_center;
  for (std::size_t i = 0; i < 3; ++i) {
    result.limbs[i].corner = corners[i];
    for (std::size_t c = 0; c < 2; ++c) center[c] += corners[i][c] / 3;
  }
  Real squares = 0;  // of the distances of the corners from the center of mass
  for (const auto& corner : corners) {
    const Real x = corner[0] - center[0], y = corner[1] - center[1];
    squares += x * x + y * y;
  }
  const Real area = abs((corners[1][0] - corners[0][0]) * (corners[2][1] - corners[0][1]) -
                        (corners[1][1] - corners[0][1]) * (corners[2][0] - corners[0][0])) /
                    2;
  const Real rho =
      material(manipulator, manipulator.has("platform_material") ? "platform_material" : "material")
          .rho;
  const Real mass = given_or(platform, "mass_kg", area * platform.positive("thickness_m") * rho);
  const Real steiner = mass * (center[0] * center[0] + center[1] * center[1]);
  result.platform_mass = mass;
  result.platform_inertia =
      given_or(platform, "inertia_kg_m2", mass * squares / 12 + steiner) - steiner;
}

}  // namespace

ManipulatorNumbers read_manipulator_numbers(const Arguments& manipulator) {
  ManipulatorNumbers result;
  read_platform(manipulator, result);
  const FrameMaterial m = material(manipulator, "material");
  const Arguments proximal = links_of_kind(manipulator, "proximal");
  const Arguments distal = links_of_kind(manipulator, "distal");
  std::array<Point2<Real>, 3> base;
  if (manipulator.has("base_m")) {
    base = vertices(manipulator, "base_m");
  } else {
    const Real side = manipulator.positive("base_side_m");
    base = triangle({side / 2, side / (2 * sqrt(Real(3)))}, side, 0);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    LimbNumbers& limb = result.limbs[i];
    limb.base = base[i];
    limb.proximal = link(proximal, m, "proximal_length_m", i);
    limb.distal = link(distal, m, "distal_length_m", i);
    if (!manipulator.has("working_mode")) continue;
    const Real mode = manipulator.numbers("working_mode", 3)[i];
    if (mode != 1 && mode != -1) manipulator.fail("working_mode", "expected 1 or -1");
    limb.mode = mode > 0 ? 1 : -1;
  }
  return result;
}

Arguments manipulator_arguments(const Arguments& arguments) {
  return {arguments["manipulator"],
          "/manipulator",
          {"base_side_m", "base_m", "links", "platform", "material", "platform_material", "joints",
           "working_mode"}};
}

}  // namespace trammel::references
