#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/model/numbers.h"

/// The planar model: what a case file describes and what `assemble` turns into matrices.
/// Everything is in SI units and world axes; indices point into the vectors of the same Model.
namespace trammel::solver {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Isotropic linear elastic material. Over Dual (numbers.h) it carries a derivative.
template <class T>
struct MaterialOf {
  T E = T(0);    ///< Young's modulus [Pa]
  T rho = T(0);  ///< density [kg/m^3]
  T nu = T(0);   ///< Poisson's ratio [-]
};
using Material = MaterialOf<double>;

/// What the cross-section of a frame member contributes per unit length.
template <class T>
struct SectionOf {
  T EA = T(0);        ///< axial stiffness [N]
  T EI = T(0);        ///< in-plane bending stiffness [N m^2]
  T kappa_GA = T(0);  ///< shear stiffness with its correction factor [N]; where the theory has it
  T mass_per_length = T(0);     ///< rho A [kg/m]
  T inertia_per_length = T(0);  ///< rho I [kg m]; rotary inertia, where the theory has it
  T area = T(0);                ///< A [m^2], for stresses
  T section_modulus = T(0);     ///< I / c [m^3], for bending stresses
};
using Section = SectionOf<double>;

/// What a member has beyond bending: shear, the rotary inertia of its sections, or both. The names
/// are those of S. M. Han, H. Benaroya, T. Wei, Journal of Sound and Vibration 225 (1999).
enum class BeamTheory { euler_bernoulli, rayleigh, shear, timoshenko };

[[nodiscard]] constexpr bool has_shear_deformation(BeamTheory theory) {
  return theory == BeamTheory::shear || theory == BeamTheory::timoshenko;
}
[[nodiscard]] constexpr bool has_rotary_inertia(BeamTheory theory) {
  return theory == BeamTheory::rayleigh || theory == BeamTheory::timoshenko;
}
[[nodiscard]] constexpr BeamTheory beam_theory(bool shear, bool rotary_inertia) {
  if (shear) return rotary_inertia ? BeamTheory::timoshenko : BeamTheory::shear;
  return rotary_inertia ? BeamTheory::rayleigh : BeamTheory::euler_bernoulli;
}
enum class MassMatrix { consistent, lumped };

/// How a member's end is joined to the rotation of its node.
enum class EndFixity { welded, hinged, sprung };

struct MemberEnd {
  EndFixity fixity = EndFixity::welded;
  double stiffness = 0;  ///< of the rotational spring between end and node [N m/rad]; sprung only
  double inertia = 0;    ///< rotary inertia that turns with the member's end [kg m^2]
};

/// What lies between the sections at a member's ends.
enum class Taper {
  linear_area_and_inertia,  ///< every property linear
  linear_depth_and_width,   ///< A of second, I of fourth degree; E, kappa G and rho linear
  exponential               ///< every property by equal factors over equal lengths
};

/// A straight frame member, cut into equal elements by `assemble`.
struct Member {
  std::string name;
  std::array<Index, 2> nodes{};
  Section section;      ///< at the first node
  Section end_section;  ///< at the second node; each element takes what `taper` has at its middle
  Taper taper = Taper::linear_area_and_inertia;
  BeamTheory theory = BeamTheory::euler_bernoulli;
  MassMatrix mass = MassMatrix::consistent;
  Index elements = 1;
  std::array<MemberEnd, 2> ends{};
  bool axially_flexible = true;      ///< false: inextensible, by a constraint on each element
  Vector2d load = Vector2d::Zero();  ///< uniform load per unit length, world axes [N/m]
};

/// A membrane in plane stress; its triangles name it.
struct Plate {
  std::string name;
  Material material;
  double thickness = 0;  ///< [m]
};

/// Constant-strain triangle (three nodes) or, with mid-side nodes 01, 12, 20, six-node triangle.
struct Triangle {
  Index plate = 0;
  std::array<Index, 6> nodes{-1, -1, -1, -1, -1, -1};
  [[nodiscard]] bool quadratic() const { return nodes[3] >= 0; }
};

struct Node {
  std::string name;
  Vector2d position = Vector2d::Zero();  ///< [m]
};

/// The nodes move as one body with the reference node, whose rotation is the body's rotation.
/// Every member end welded to an attached node turns with the body (paper Eq. 20-24).
struct RigidBody {
  std::string name;
  Index reference = 0;
  std::vector<Index> attached;
};

/// Mass and inertia carried by a node, its centre offset from the node (world axes).
struct PointMass {
  Index node = 0;
  double mass = 0;                     ///< [kg]
  double inertia = 0;                  ///< about the centre of mass [kg m^2]
  Vector2d offset = Vector2d::Zero();  ///< [m]; needs the node's rotation when not zero
};

/// Spring between two nodes, or between a node and the ground (second node -1).
struct Spring {
  std::string name;
  std::array<Index, 2> nodes{-1, -1};
  Vector3d stiffness = Vector3d::Zero();  ///< along world x, y [N/m] and in rotation [N m/rad]
};

/// Which motions of a node the ground takes away.
struct Support {
  std::string name;
  Index node = 0;
  std::array<bool, 3> fixed{};  ///< x, y, rotation
};

/// One coordinate of the unconstrained model: a node's motion, or the rotation of a member's end.
struct Coordinate {
  enum class Kind { x, y, rotation, end_rotation };
  Kind kind = Kind::x;
  Index node = -1;    ///< x, y, rotation
  Index member = -1;  ///< end_rotation
  int end = 0;        ///< end_rotation
};

/// sum of coefficient * coordinate = 0; Eq. 25 and pins of finite radius are such sums.
struct LinearConstraint {
  /// Of a slider, whose first-order equation the sum is: the node turns its line.
  struct Rail {
    Index node = 0, slider = 0;
    Vector2d direction = Vector2d::UnitX();
  };
  std::string name;
  std::vector<std::pair<Coordinate, double>> terms;
  std::optional<Rail> rail = {};
};

struct NodalLoad {
  Index node = 0;
  Vector3d force = Vector3d::Zero();  ///< Fx, Fy [N], moment [N m]
};

/// Uniform force per area on one side of a triangle (its thickness times its length): a traction
/// in world axes, and one along the normal to the right of the way from the first to the second
/// node, which points outward where the triangle runs counterclockwise.
struct EdgeLoad {
  Index plate = 0;
  std::array<Index, 3> nodes{-1, -1, -1};  ///< its ends, and its middle where it has one
  Vector2d traction = Vector2d::Zero();    ///< [Pa]
  double normal = 0;                       ///< [Pa], tension positive
};

struct Model {
  std::vector<Node> nodes;
  std::vector<Member> members;
  std::vector<Plate> plates;
  std::vector<Triangle> triangles;
  std::vector<RigidBody> rigid_bodies;
  std::vector<PointMass> masses;
  std::vector<Spring> springs;
  std::vector<Support> supports;
  std::vector<LinearConstraint> constraints;
  std::vector<NodalLoad> loads;
  std::vector<EdgeLoad> edge_loads;
  Vector2d gravity = Vector2d::Zero();  ///< [m/s^2]

  /// Index of the node of that name, or -1.
  [[nodiscard]] Index find_node(std::string_view name) const;
};

/// A model or an option that has no mechanical meaning, such as a beam welded to a node without
/// rotation. The reader of a case file adds the file and the JSON pointer.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws ModelError  with the message, where the condition does not hold.
inline void require(bool condition, const std::string& message) {
  if (!condition) throw ModelError(message);
}

// What a sentence calls a part of the model: its name, or its number where it has none.

[[nodiscard]] std::string node_label(const Model& model, Index node);
[[nodiscard]] std::string member_label(const Model& model, Index member);
[[nodiscard]] std::string part_label(const char* kind, const std::string& name, std::size_t index);

// Vectors in the plane.

/// The component out of the plane of a x b: positive where b lies to the left of a.
[[nodiscard]] inline double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The vector turned by 90 degrees to the left.
[[nodiscard]] inline Vector2d perpendicular(const Vector2d& v) {
  return {-v.y(), v.x()};
}

/// The vector turned counterclockwise.   @param angle  [rad]
[[nodiscard]] inline Vector2d rotated(const Vector2d& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Diagonal of the box around points [m], by which rotations are compared with translations; 1
/// where the points are one, or none.
/// @param position  of an entry of the range
template <class Range, class Position = std::identity>
[[nodiscard]] double box_diagonal(const Range& range, Position position = {}) {
  if (std::empty(range)) return 1;
  Vector2d low = position(*std::begin(range)), high = low;
  for (const auto& entry : range) {
    const Vector2d& point = position(entry);
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return low == high ? 1 : (high - low).norm();
}

/// The same of a model's nodes.
[[nodiscard]] inline double box_diagonal(const Model& model) {
  return box_diagonal(model.nodes, [](const Node& node) { return node.position; });
}

}  // namespace trammel::solver
