#include "solver/linear/constraints.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/linalg/factorization.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

using Terms = std::vector<std::pair<Index, double>>;

// Limit of the relative size of a row after substitution; smaller rows are redundant.
constexpr double kRedundant = 1e-11;
// Smallest allowed ratio of a pivot to the largest entry of its row; bounds the growth of T.
constexpr double kPivotThreshold = 0.25;

std::vector<ConstraintRow> rows_of_supports(const Model& model, const Coordinates& coordinates) {
  std::vector<ConstraintRow> rows;
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Support& support = model.supports[i];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!support.fixed[k]) continue;
      const Index u = coordinates.node[to_size(support.node)][k];
      if (u < 0)
        throw ModelError("the support of " + node_label(model, support.node) +
                         " fixes a rotation that the node does not have: no member end is joined "
                         "to the node and no rigid body contains the node");
      rows.push_back({ConstraintRow::Source::support, static_cast<Index>(i), {{u, 1.0}}});
    }
  }
  return rows;
}

void add_rows_of_linear_constraints(const Model& model, const Coordinates& coordinates,
                                    std::vector<ConstraintRow>& rows) {
  for (std::size_t i = 0; i < model.constraints.size(); ++i) {
    ConstraintRow row{ConstraintRow::Source::linear, static_cast<Index>(i), {}};
    for (const auto& [coordinate, coefficient] : model.constraints[i].terms) {
      if (!std::isfinite(coefficient))
        throw ModelError(part_label("constraint", model.constraints[i].name, i) +
                         " has a coefficient that is not a finite number");
      row.terms.emplace_back(coordinates.index_of(model, coordinate), coefficient);
    }
    rows.push_back(std::move(row));
  }
}

void add_rows_of_rigid_bodies(const Model& model, const Coordinates& coordinates,
                              std::vector<ConstraintRow>& rows) {
  for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
    const RigidBody& body = model.rigid_bodies[i];
    const auto& reference = coordinates.node[to_size(body.reference)];
    for (const Index node : body.attached) {
      if (node == body.reference) continue;
      const auto& attached = coordinates.node[to_size(node)];
      const Vector2d arm =
          model.nodes[to_size(node)].position - model.nodes[to_size(body.reference)].position;
      const auto add = [&](Terms terms) {
        rows.push_back(
            {ConstraintRow::Source::rigid_body, static_cast<Index>(i), std::move(terms)});
      };
      add({{attached[0], 1.0}, {reference[0], -1.0}, {reference[2], arm.y()}});
      add({{attached[1], 1.0}, {reference[1], -1.0}, {reference[2], -arm.x()}});
      if (attached[2] >= 0) add({{attached[2], 1.0}, {reference[2], -1.0}});
    }
  }
}

void add_inextensible_rows(const Model& model, const Mesh& mesh, std::vector<ConstraintRow>& rows) {
  for (std::size_t i = 0; i < mesh.frame.size(); ++i) {
    const FrameElement& e = mesh.frame[i];
    if (model.members[to_size(e.member)].axially_flexible) continue;
    rows.push_back({ConstraintRow::Source::inextensible,
                    static_cast<Index>(i),
                    {{e.coordinates[3], e.direction.x()},
                     {e.coordinates[4], e.direction.y()},
                     {e.coordinates[0], -e.direction.x()},
                     {e.coordinates[1], -e.direction.y()}}});
  }
}

/// Gaussian elimination of sparse constraint rows. Rotations are scaled by the model size.
class Elimination {
 public:
  Elimination(const Coordinates& coordinates, double size)
      : scale_(to_size(coordinates.size), 1.0),
        occurrences_(scale_.size(), 0),
        row_of_(scale_.size(), -1) {
    for (std::size_t u = 0; u < scale_.size(); ++u) {
      // Scale factor of a coordinate u, defined by u = scale * (scaled u).
      if (coordinates.is_rotation[u]) scale_[u] = 1 / size;
    }
  }

  std::vector<Index> run(const std::vector<ConstraintRow>& rows) {
    for (const ConstraintRow& row : rows)
      for (const auto& term : row.terms) ++occurrences_[to_size(term.first)];
    std::vector<Index> pivots;
    pivots.reserve(rows.size());
    for (const ConstraintRow& row : rows) pivots.push_back(eliminate(row.terms));
    resolve();
    return pivots;
  }

  /// Returns an eliminated coordinate u as a linear combination of other coordinates, or null if u
  /// is free.
  [[nodiscard]] const Terms* expression(Index u) const {
    const Index row = row_of_[to_size(u)];
    return row < 0 ? nullptr : &expressions_[to_size(row)].terms;
  }

 private:
  struct Expression {
    Index pivot;
    Terms terms;
  };
  struct Entry {
    double value = 0;
    /// Sum of the magnitudes of all added terms. A `value` that is much smaller than this sum is
    /// treated as a round-off error.
    double magnitude = 0;
  };
  using Row = std::map<Index, Entry>;

  static void add(Row& row, Index u, double value, double magnitude) {
    Entry& entry = row[u];
    entry.value += value;
    entry.magnitude += magnitude;
  }

  /// Returns a sum of terms in which all eliminated coordinates are replaced by their expressions.
  [[nodiscard]] Row substitute(const Terms& terms) const {
    Row row;
    for (const auto& [u, c] : terms) add(row, u, c, std::abs(c));
    for (bool again = true; again;) {
      again = false;
      for (auto it = row.begin(); it != row.end();) {
        const Terms* const replacement = expression(it->first);
        if (!replacement) {
          ++it;
          continue;
        }
        const Entry entry = it->second;
        it = row.erase(it);
        for (const auto& [u, c] : *replacement)
          add(row, u, c * entry.value, std::abs(c) * entry.magnitude);
        again = true;
      }
    }
    return row;
  }

  /// Returns the entries of a row divided by `divisor`, without the entry of the pivot and without
  /// round-off errors.
  static Terms significant_terms(const Row& row, Index pivot, double divisor) {
    Terms terms;
    for (const auto& [u, entry] : row) {
      if (u != pivot && std::abs(entry.value) > 1e-14 * entry.magnitude)
        terms.emplace_back(u, entry.value / divisor);
    }
    return terms;
  }

  Index eliminate(Terms terms) {
    double size = 0, largest = 0;
    for (auto& [u, c] : terms) {
      c *= scale_[to_size(u)];
      size = std::max(size, std::abs(c));
    }
    const Row row = substitute(terms);
    for (const auto& [u, entry] : row) largest = std::max(largest, std::abs(entry.value));
    if (!(largest > kRedundant * size)) return -1;
    const Index pivot = choose_pivot(row, largest);
    expressions_.push_back({pivot, significant_terms(row, pivot, -row.at(pivot).value)});
    row_of_[to_size(pivot)] = std::ssize(expressions_) - 1;
    return pivot;
  }

  /// Selects the pivot of a row among its sufficiently large entries. The first criterion is the
  /// coordinate that occurs in the fewest rows, which causes the least fill-in. If coordinates are
  /// equal in this respect, the larger entry and then the later coordinate is selected.
  [[nodiscard]] Index choose_pivot(const Row& row, double largest) const {
    Index best = -1;
    for (const auto& [u, entry] : row) {
      if (std::abs(entry.value) < kPivotThreshold * largest) continue;
      if (best < 0) {
        best = u;
        continue;
      }
      const auto count = occurrences_[to_size(u)];
      const auto best_count = occurrences_[to_size(best)];
      const double gain = std::abs(entry.value) - std::abs(row.at(best).value);
      if (count < best_count || (count == best_count && gain > -1e-9 * largest)) best = u;
    }
    return best;
  }

  /// Replaces eliminated coordinates in all expressions by backward substitution. Before the
  /// substitution, an expression contains only free coordinates and coordinates that were
  /// eliminated later.
  void resolve() {
    for (std::size_t i = expressions_.size(); i-- > 0;)
      expressions_[i].terms = significant_terms(substitute(expressions_[i].terms), -1, 1);
    // Convert the coefficients to unscaled coordinates.
    for (Expression& expression : expressions_) {
      const double scale = scale_[to_size(expression.pivot)];
      for (auto& [u, c] : expression.terms) c *= scale / scale_[to_size(u)];
    }
  }

  std::vector<double> scale_;
  std::vector<Index> occurrences_;
  std::vector<Index> row_of_;  // coordinate -> index of its expression
  std::vector<Expression> expressions_;
};

void build_T(const Elimination& elimination, Constraints& constraints, Index size) {
  std::vector<Index>& free = constraints.free;
  free.assign(to_size(size), -1);
  for (Index u = 0; u < size; ++u)
    if (!elimination.expression(u)) free[to_size(u)] = constraints.free_count++;
  std::vector<Eigen::Triplet<double>> entries;
  Terms itself(1);
  for (Index u = 0; u < size; ++u) {
    itself[0] = {u, 1.0};
    const Terms* const terms = elimination.expression(u);
    for (const auto& [v, c] : terms ? *terms : itself) entries.emplace_back(u, free[to_size(v)], c);
  }
  constraints.T.resize(size, constraints.free_count);
  constraints.T.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

Constraints build_constraints(const Model& model, const Discretisation& discretization) {
  const Coordinates& coordinates = discretization.coordinates;
  Constraints constraints;
  constraints.rows = rows_of_supports(model, coordinates);
  add_rows_of_linear_constraints(model, coordinates, constraints.rows);
  add_rows_of_rigid_bodies(model, coordinates, constraints.rows);
  add_inextensible_rows(model, discretization.mesh, constraints.rows);
  Elimination elimination(coordinates, box_diagonal(model));
  constraints.pivot = elimination.run(constraints.rows);
  build_T(elimination, constraints, coordinates.size);
  return constraints;
}

Eigen::VectorXd Constraints::lagrange_multipliers(const Eigen::VectorXd& force) const {
  // Solve the square system of the pivot coordinates of all independent rows except supports. A
  // support row has a single entry, so that its multiplier equals the remaining force on its
  // coordinate.
  std::vector<Index> kept, supports, number_of_pivot(to_size(T.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (pivot[i] < 0) continue;
    const bool is_support = rows[i].source == ConstraintRow::Source::support;
    if (!is_support) number_of_pivot[to_size(pivot[i])] = std::ssize(kept);
    (is_support ? supports : kept).push_back(static_cast<Index>(i));
  }
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(std::ssize(rows)), left = force;
  if (!kept.empty()) {
    const Index n = std::ssize(kept);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right(n);
    for (Index k = 0; k < n; ++k) {
      const auto row = to_size(kept[to_size(k)]);
      right[k] = force[pivot[row]];
      for (const auto& [u, c] : rows[row].terms) {
        const Index equation = number_of_pivot[to_size(u)];
        if (equation >= 0) entries.emplace_back(equation, k, c);
      }
    }
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    SparseLu<double> lu;
    if (!lu.factorize(matrix)) return lambda.setConstant(kNaN);
    lambda(kept) = lu.solve(right);
  }
  for (const Index row : kept)
    for (const auto& [u, c] : rows[to_size(row)].terms) left[u] -= c * lambda[row];
  for (const Index row : supports) lambda[row] = left[pivot[to_size(row)]];
  return lambda;
}

}  // namespace trammel::solver
