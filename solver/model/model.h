#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/model/numbers.h"

/// Planar finite element model. A case file describes the model, and `assemble` builds its
/// matrices. All quantities are in SI units and world axes. Indices of nodes, members and other
/// objects refer to the vectors of the same Model.
namespace trammel::solver {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Isotropic linear elastic material. With T = Dual (numbers.h), each property also contains its
/// derivative with respect to one parameter.
template <class T>
struct MaterialOf {
  T E = T(0);    ///< Young's modulus [Pa]
  T rho = T(0);  ///< density [kg/m^3]
  T nu = T(0);   ///< Poisson's ratio [-]
};
using Material = MaterialOf<double>;

/// Properties of the cross-section of a frame member.
template <class T>
struct SectionOf {
  T EA = T(0);  ///< axial stiffness [N]
  T EI = T(0);  ///< in-plane bending stiffness [N m^2]
  /// Shear stiffness including the shear correction factor [N], if the theory includes shear.
  T kappa_GA = T(0);
  T mass_per_length = T(0);     ///< rho A [kg/m]
  T inertia_per_length = T(0);  ///< rho I [kg m], if the theory includes rotary inertia
  T area = T(0);                ///< cross-sectional area A [m^2], for stresses
  T section_modulus = T(0);     ///< section modulus I / c [m^3], for bending stresses
};
using Section = SectionOf<double>;

/// Beam theory: bending, optionally with shear deformation, rotary inertia, or both. Names follow
/// S. M. Han, H. Benaroya, T. Wei, Journal of Sound and Vibration 225 (1999).
enum class BeamTheory { euler_bernoulli, rayleigh, shear, timoshenko };

/// Returns true for a shear beam or a Timoshenko beam.
[[nodiscard]] constexpr bool has_shear_deformation(BeamTheory theory) {
  return theory == BeamTheory::shear || theory == BeamTheory::timoshenko;
}
/// Returns true for a Rayleigh beam or a Timoshenko beam.
[[nodiscard]] constexpr bool has_rotary_inertia(BeamTheory theory) {
  return theory == BeamTheory::rayleigh || theory == BeamTheory::timoshenko;
}
/// Returns the beam theory with the given effects in addition to bending.
[[nodiscard]] constexpr BeamTheory beam_theory(bool shear, bool rotary_inertia) {
  if (shear) return rotary_inertia ? BeamTheory::timoshenko : BeamTheory::shear;
  return rotary_inertia ? BeamTheory::rayleigh : BeamTheory::euler_bernoulli;
}
/// Mass matrix of a member: consistent, or lumped at the nodes.
enum class MassMatrix { consistent, lumped };

/// Connection between the rotations of a member end and its node.
enum class EndFixity { welded, hinged, sprung };

/// Joint between the end of a member and its node.
struct MemberEnd {
  EndFixity fixity = EndFixity::welded;
  double stiffness = 0;  ///< rotational stiffness between end and node [N m/rad]; `sprung` only
  double inertia = 0;    ///< rotary inertia that turns with the member end [kg m^2]
};

/// Variation of the section between the ends of a member.
enum class Taper {
  linear_area_and_inertia,  ///< every section property varies linearly along the member
  linear_depth_and_width,   ///< A is quadratic, I is of degree 4; E, kappa G and rho are linear
  exponential               ///< every section property changes by equal factors over equal lengths
};

/// Straight frame member, divided into equal elements by `assemble`.
struct Member {
  std::string name;
  std::array<Index, 2> nodes{};
  Section section;  ///< section at the first node
  /// Section at the second node. Each element is uniform and has the section at its midpoint,
  /// interpolated according to `taper`.
  Section end_section;
  Taper taper = Taper::linear_area_and_inertia;
  BeamTheory theory = BeamTheory::euler_bernoulli;
  MassMatrix mass = MassMatrix::consistent;
  Index elements = 1;
  std::array<MemberEnd, 2> ends{};
  bool axially_flexible = true;      ///< false: inextensible, by a constraint on each element
  Vector2d load = Vector2d::Zero();  ///< uniform load per unit length, world axes [N/m]
};

/// Membrane in plane stress. A triangle refers to its plate by the index of the plate.
struct Plate {
  std::string name;
  Material material;
  double thickness = 0;  ///< thickness [m]
};

/// Three-node constant-strain triangle, or six-node triangle with mid-side nodes 01, 12, 20.
struct Triangle {
  Index plate = 0;
  std::array<Index, 6> nodes{-1, -1, -1, -1, -1, -1};
  [[nodiscard]] bool quadratic() const { return nodes[3] >= 0; }
};

/// Node of the model.
struct Node {
  std::string name;
  Vector2d position = Vector2d::Zero();  ///< undeformed position [m]
};

/// Rigid body that connects several nodes. The rotation of the reference node is the rotation of
/// the body. Every member end that is welded to an attached node turns with the body (Varalakshmi &
/// Srinivas 2017, Eq. 20-24).
struct RigidBody {
  std::string name;
  Index reference = 0;
  std::vector<Index> attached;
};

/// Point mass with a moment of inertia, which is attached to a node.
struct PointMass {
  Index node = 0;
  double mass = 0;     ///< mass [kg]
  double inertia = 0;  ///< moment of inertia about the center of mass [kg m^2]
  /// Vector from the node to the center of mass, in world axes [m]. If the vector is not zero, the
  /// node must have a rotation.
  Vector2d offset = Vector2d::Zero();
};

/// Spring between two nodes, or between a node and the ground (second node -1).
struct Spring {
  std::string name;
  std::array<Index, 2> nodes{-1, -1};
  Vector3d stiffness = Vector3d::Zero();  ///< along x, y [N/m]; of rotation [N m/rad]
};

/// Support that fixes displacements or the rotation of a node to the ground.
struct Support {
  std::string name;
  Index node = 0;
  std::array<bool, 3> fixed{};  ///< true for each fixed direction: x, y, rotation
};

/// Coordinate of the unconstrained model: a displacement or the rotation of a node, or the rotation
/// of a member end.
struct Coordinate {
  enum class Kind { x, y, rotation, end_rotation };
  Kind kind = Kind::x;
  Index node = -1;    ///< index of the node, for the kinds x, y and rotation
  Index member = -1;  ///< index of the member, for the kind end_rotation
  int end = 0;        ///< end of the member (0 or 1), for the kind end_rotation
};

/// Homogeneous linear constraint on the motion of the model: sum of coefficient * coordinate = 0.
/// Eq. 25 of Varalakshmi & Srinivas (2017) and pins of finite radius have this form.
struct LinearConstraint {
  /// Slider on a straight rail. A constraint that keeps a slider on its rail for small motions
  /// refers to this object. The rail rotates with the node `node`, and `slider` is the sliding
  /// node.
  struct Rail {
    Index node = 0, slider = 0;
    Vector2d direction = Vector2d::UnitX();
  };
  std::string name;
  std::vector<std::pair<Coordinate, double>> terms;
  std::optional<Rail> rail = {};
};

/// Force and moment on a node, in world axes.
struct NodalLoad {
  Index node = 0;
  Vector3d force = Vector3d::Zero();  ///< Fx, Fy [N], moment [N m]
};

/// Uniform force per area on one side of a triangle. The loaded area is thickness times length. The
/// load is the sum of a traction in world axes and a normal traction. The normal points to the
/// right of the direction from the first to the second node. The normal points outward if the nodes
/// of the triangle are numbered counterclockwise.
struct EdgeLoad {
  Index plate = 0;
  std::array<Index, 3> nodes{-1, -1, -1};  ///< two end nodes, then the middle node (-1: none)
  Vector2d traction = Vector2d::Zero();    ///< traction in world axes [Pa]
  double normal = 0;                       ///< normal traction, positive in tension [Pa]
};

/// Planar model of members, plates, rigid bodies, masses, springs, supports and loads.
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
  Vector2d gravity = Vector2d::Zero();  ///< acceleration of gravity [m/s^2]

  /// Returns the index of the node with the given name, or -1 if there is none.
  [[nodiscard]] Index find_node(std::string_view name) const;
};

/// Exception for a model or an option without mechanical meaning, such as a beam that is welded to
/// a node without rotation. The function that reads a case file adds the file name and the JSON
/// pointer to the message.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws ModelError  with the text `message`, if `condition` is false.
inline void require(bool condition, const std::string& message) {
  if (!condition) throw ModelError(message);
}

// Labels of the objects of a model in messages: the name of the object, or its index if the object
// has no name.

/// Returns "node", followed by the name of a node, or by its index if the name is empty.
[[nodiscard]] std::string node_label(const Model& model, Index node);
/// Returns "member", followed by the name of a member, or by its index if the name is empty.
[[nodiscard]] std::string member_label(const Model& model, Index member);
/// Returns the type of an object (`kind`, such as "spring"), followed by the name of the object, or
/// by its index if the name is empty.
[[nodiscard]] std::string part_label(const char* kind, const std::string& name, std::size_t index);

// Operations on vectors in the plane.

/// Returns the out-of-plane component of a x b. It is positive if b lies to the left of a.
[[nodiscard]] inline double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Returns the vector v rotated counterclockwise by 90 degrees.
[[nodiscard]] inline Vector2d perpendicular(const Vector2d& v) {
  return {-v.y(), v.x()};
}

/// Returns the vector v rotated counterclockwise by an angle [rad].
[[nodiscard]] inline Vector2d rotated(const Vector2d& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Returns the diagonal of the bounding box of points [m], or 1 if the range is empty or all points
/// coincide. This length scales rotations for comparison with translations.
/// @param range  objects that have positions, such as nodes.
/// @param position  function that returns the position of an object in `range`.
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

/// Returns the diagonal of the bounding box of the nodes [m], or 1 if all nodes coincide.
[[nodiscard]] inline double box_diagonal(const Model& model) {
  return box_diagonal(model.nodes, [](const Node& node) { return node.position; });
}

}  // namespace trammel::solver
