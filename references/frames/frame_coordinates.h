#pragma once

#include <array>
#include <map>
#include <vector>

#include "references/frames/frame.h"
#include "references/numerics/dense.h"

/// Coordinates u of a frame: x and y of each node, the rotation of each node that has one, and the
/// rotation of each hinged or sprung member end. Supports, rigid bodies, inextensible members and
/// sums of rotations are equations C u = 0. Elimination with full pivoting solves them: u = N q,
/// with the free coordinates q.
namespace trammel::references {

/// Spring between the coordinates `from` and `to` of u. Its tension, stiffness * (u[to] - u[from]),
/// acts positively on `from` and negatively on `to`.
struct SpringElement {
  int from, to;  ///< indices in u; from = -1: the ground
  Real stiffness;
};

class FrameCoordinates {
 public:
  /// @param constrain_inextensible  true if members without axial compliance are constraints
  /// (dynamics), false if their axial force is an unknown (statics).
  /// @throws DerivationError  if a member has the length 0.
  FrameCoordinates(const Frame& frame, bool constrain_inextensible);

  [[nodiscard]] int coordinate_count() const { return size_; }                  ///< size of u
  [[nodiscard]] int free_count() const { return static_cast<int>(N_.cols()); }  ///< size of q
  [[nodiscard]] const RealMatrix& N() const { return N_; }  ///< matrix of u = N q

  /// Index in u of motion 0 (x), 1 (y) or 2 (rotation) of a node; -1 if the node has no rotation.
  [[nodiscard]] int node_coordinate_index(int node, int motion) const {
    return node_[node][motion];
  }
  /// Index in u of the rotation of a member's end.
  [[nodiscard]] int end_rotation_index(int member, int end) const {
    return member_[member][3 * end + 2];
  }
  /// Indices in u of x, y, rotation at both ends of a member.
  [[nodiscard]] const std::array<int, 6>& member_indices(int member) const {
    return member_[member];
  }
  /// Returns the springs between nodes and the springs at member ends.
  [[nodiscard]] std::vector<SpringElement> springs(const Frame& frame) const;

 private:
  using Row = std::map<int, Real>;  ///< one equation: index in u -> coefficient

  void number_coordinates(const Frame& frame);
  [[nodiscard]] std::vector<Row> constraint_equations(const Frame& frame,
                                                      bool constrain_inextensible) const;
  void eliminate_constraints(const std::vector<Row>& equations);

  int size_ = 0;
  std::vector<std::array<int, 3>> node_;
  std::vector<std::array<int, 6>> member_;
  RealMatrix N_;
};

}  // namespace trammel::references
