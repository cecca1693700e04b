#include "solver/manipulator/moving_constraints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trammel::solver {

using Eigen::MatrixXd;

namespace {

/// Limit of the magnitudes of the entries of the matrix T in u = T q. Larger entries amplify
/// round-off by four digits.
constexpr double kLargestT = 1e4;
/// Fraction of the largest entry in a row of the matrix T (u = T q) below which an entry is a
/// round-off error.
constexpr double kVanishing = 1e-11;

/// Returns the motion of the member or rigid body whose rotation changes the coefficients of a
/// constraint row, or null if the coefficients are constant.
const PartMotion* part_of(const System& start, const ConstraintRow& row,
                          const NominalMotion& motion) {
  if (row.source == ConstraintRow::Source::inextensible)
    return &motion.part[to_size(start.mesh.frame[to_size(row.index)].member)];
  if (row.source == ConstraintRow::Source::rigid_body)
    return &motion.part[to_size(body_part_index(start.model, row.index))];
  return nullptr;
}

/// Returns the coefficient of a term in a constraint row (order 0), or its first or second time
/// derivative (order 1, 2).
double coefficient(const System& start, const ConstraintRow& row, std::size_t term,
                   const NominalMotion& motion, int order) {
  if (row.source == ConstraintRow::Source::inextensible) {
    const FrameElement& e = start.mesh.frame[to_size(row.index)];
    const Vector2d d = part_of(start, row, motion)->rotated_derivative(e.direction, order);
    const auto at = std::ranges::find(e.coordinates, row.terms[term].first) - e.coordinates.begin();
    return (at >= 3 ? 1 : -1) * (at % 3 == 0 ? d.x() : d.y());
  }
  const Index first = row.terms.front().first;
  const auto& coordinates = start.coordinates;
  const bool arm_term = row.source == ConstraintRow::Source::rigid_body && term == 2 &&
                        !coordinates.is_rotation[to_size(first)];
  if (!arm_term) return order == 0 ? row.terms[term].second : 0.0;
  const Index node = coordinates.node_of[to_size(first)];
  const Index reference = start.model.rigid_bodies[to_size(row.index)].reference;
  const Vector2d arm =
      start.mesh.positions[to_size(node)] - start.mesh.positions[to_size(reference)];
  const Vector2d now = part_of(start, row, motion)->rotated_derivative(arm, order);
  return first == coordinates.node[to_size(node)][0] ? now.y() : -now.x();
}

}  // namespace

MovingConstraints::MovingConstraints(const System& start, const NominalMotion& motion,
                                     bool derivatives)
    : constraints_(start.constraints), derivatives_(derivatives) {
  for (std::size_t r = 0; r < constraints_.rows.size(); ++r) {
    const bool turns = part_of(start, constraints_.rows[r], motion) != nullptr;
    variable_ = variable_ || (constraints_.pivot[r] >= 0 && turns);
  }
  if (!variable_) return;
  find_eliminating_rows();
  extend_pattern(start, motion);
}

/// Selects the constraint rows that determine the matrix T in u = T q.
void MovingConstraints::find_eliminating_rows() {
  dependent_row_of_.assign(to_size(constraints_.T.rows()), -1);
  for (std::size_t r = 0; r < constraints_.rows.size(); ++r) {
    const Index pivot = constraints_.pivot[r];
    if (pivot < 0 || constraints_.rows[r].source == ConstraintRow::Source::support) continue;
    dependent_row_of_[to_size(pivot)] = std::ssize(dependent_rows_);
    dependent_rows_.push_back(r);
  }
  const auto columns = [](const std::vector<Index>& column_of, Index count) {
    std::vector<Eigen::Triplet<double>> ones;
    for (int u = 0; u < static_cast<int>(column_of.size()); ++u) {
      const int column = static_cast<int>(column_of[to_size(u)]);
      if (column >= 0) ones.emplace_back(u, column, 1.0);
    }
    RowMajorMatrix matrix(std::ssize(column_of), count);
    matrix.setFromTriplets(ones.begin(), ones.end());
    return matrix;
  };
  select_free_ = columns(constraints_.free, constraints_.T.cols());
  select_dependent_ = columns(dependent_row_of_, std::ssize(dependent_rows_));
}

/// Extends the sparsity pattern of the matrix T in u = T q by all entries that are nonzero at any
/// pose. These entries are found numerically at three arbitrary rotations of members and bodies.
/// The pattern of the constraint matrix C alone would give more entries than necessary: each node
/// of an inextensible member would depend on all preceding nodes, although their contributions
/// cancel.
void MovingConstraints::extend_pattern(const System& start, const NominalMotion& motion) {
  auto& T = constraints_.T;
  Eigen::ArrayXX<bool> needed(static_cast<Index>(dependent_rows_.size()), T.cols());
  needed.setConstant(false);
  NominalMotion general = motion;
  double turn = 1;
  for (int found = 0, trial = 0; found < 3 && trial < 100; ++trial) {
    for (PartMotion& part : general.part) part.angle = 0.4 * std::sin(turn += std::numbers::phi);
    const MatrixXd X = dependent_coordinate_matrix(start, general).cwiseAbs();
    if (!(X.allFinite() && X.maxCoeff() < kLargestT)) continue;
    ++found;
    for (Index i = 0; i < X.rows(); ++i)
      needed.row(i) = needed.row(i) || X.row(i).array() > kVanishing * X.row(i).maxCoeff();
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (Index u = 0; u < T.rows(); ++u) {
    const Index row = dependent_row_of_[to_size(u)], own = constraints_.free[to_size(u)];
    for (Index q = 0; q < T.cols(); ++q) {
      const bool enters = row >= 0 ? needed(row, q) : q == own;
      if (enters) entries.emplace_back(static_cast<int>(u), static_cast<int>(q), T.coeff(u, q));
    }
  }
  T.setFromTriplets(entries.begin(), entries.end());
  T.makeCompressed();
  T_dot_ = 0.0 * T;
  T_ddot_ = T_dot_;
}

/// Returns the constraint matrix C (order 0), or its first or second time derivative (order 1, 2),
/// times a matrix with one row per coordinate. Only the rows of C in dependent_rows_ are included.
MatrixXd MovingConstraints::derivative_times(const System& start, const NominalMotion& motion,
                                             int order, const RowMajorMatrix& matrix) const {
  MatrixXd sum = MatrixXd::Zero(std::ssize(dependent_rows_), matrix.cols());
  for (Index i = 0; i < sum.rows(); ++i) {
    const ConstraintRow& row = constraints_.rows[dependent_rows_[to_size(i)]];
    for (std::size_t t = 0; t < row.terms.size(); ++t) {
      const double c = coefficient(start, row, t, motion, order);
      for (RowMajorMatrix::InnerIterator entry(matrix, row.terms[t].first); entry; ++entry)
        sum(i, entry.col()) += c * entry.value();
    }
  }
  return sum;
}

/// Solves C_p X = - C_f for X, where p and f are the columns of eliminated and free coordinates in
/// the constraint matrix C. X expresses the eliminated coordinates (rows) by the free coordinates
/// (columns).
MatrixXd MovingConstraints::dependent_coordinate_matrix(const System& start,
                                                        const NominalMotion& motion) {
  pivots_.compute(derivative_times(start, motion, 0, select_dependent_));
  return pivots_.solve(-derivative_times(start, motion, 0, select_free_));
}

void MovingConstraints::store_dependent_rows(const MatrixXd& values, RowMajorMatrix& target) const {
  for (Index u = 0; u < target.rows(); ++u) {
    const Index row = dependent_row_of_[to_size(u)];
    if (row < 0) continue;
    for (RowMajorMatrix::InnerIterator it(target, u); it; ++it)
      it.valueRef() = values(row, it.col());
  }
}

Outcome MovingConstraints::update_transformation(const System& start, const NominalMotion& from,
                                                 const NominalMotion& to) {
  const bool changes = std::ranges::any_of(constraints_.rows, [&](const ConstraintRow& row) {
    const PartMotion *before = part_of(start, row, from), *after = part_of(start, row, to);
    return before != nullptr && *before != *after;
  });
  if (!variable_ || !changes) return {};
  const MatrixXd X = dependent_coordinate_matrix(start, to);
  if (!(X.allFinite() && X.cwiseAbs().maxCoeff() < kLargestT))
    return {Status::singular,
            "the constraints do not determine the eliminated coordinates at this pose"};
  for (const std::size_t r : dependent_rows_) {
    ConstraintRow& row = constraints_.rows[r];
    for (std::size_t t = 0; t < row.terms.size(); ++t)
      row.terms[t].second = coefficient(start, row, t, to, 0);
  }
  store_dependent_rows(X, constraints_.T);
  if (!derivatives_) return {};
  store_dependent_rows(pivots_.solve(-derivative_times(start, to, 1, constraints_.T)), T_dot_);
  store_dependent_rows(pivots_.solve(-derivative_times(start, to, 2, constraints_.T) -
                                     2 * derivative_times(start, to, 1, T_dot_)),
                       T_ddot_);
  return {};
}

}  // namespace trammel::solver
