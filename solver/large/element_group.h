#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "solver/large/constrained_system.h"
#include "solver/large/large_motion_model.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

/// Typical stiffness and mass of the members and bodies that a constraint row joins. Stiffness and
/// mass determine the penalty rho of the row (see `KktMatrix`).
struct RowScales {
  /// Reference value of the residual of the constraint row: 1 rad if all coordinates in the row are
  /// rotations, otherwise the model size [m].
  double unit = 1;
  /// Largest stiffness and largest mass of the coordinates in the constraint row, in the unit of
  /// the row. If all values in the row are zero, the mean over the model is used.
  double stiffness = 0, mass = 0;
};

/// Computes the typical stiffness and mass (`RowScales`) of constraint rows.
class PenaltyScales {
 public:
  /// Computes the stiffness and mass of each coordinate. `mass` is the diagonal of the mass matrix
  /// [kg or kg m^2], and `size` is the size of the model [m].
  PenaltyScales(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
                const Eigen::VectorXd& mass, double size);

  /// Returns the typical stiffness and mass of a constraint row with the given coordinates. If the
  /// translations in the row have no stiffness or mass, the values of the rotations, divided by the
  /// squared `lever` [m], are used.
  [[nodiscard]] RowScales row_scales(std::span<const Index> coordinates, double lever) const;

 private:
  const Layout& layout_;
  double size_;                ///< size of the model [m]
  Eigen::VectorXd stiffness_;  ///< stiffness of each coordinate [N/m or N m/rad]
  Eigen::VectorXd mass_;       ///< mass of each coordinate [kg or kg m^2]
  double mean_stiffness_, mean_mass_;
};

/// Indices of the coordinates that an element couples; -1: the ground.
template <int N>
using CoordinateIndices = Eigen::Matrix<Index, N, 1>;

/// Returns the values of the coordinates of an element. Coordinates held by supports have indices
/// beyond the vector `values` and the value 0.
template <int N>
Eigen::Matrix<double, N, 1> gather(const VectorXd& values, const CoordinateIndices<N>& where) {
  Eigen::Matrix<double, N, 1> local(where.size());
  for (Index i = 0; i < where.size(); ++i) {
    const Index k = where[i];
    local[i] = k >= 0 && k < values.size() ? values[k] : 0.0;
  }
  return local;
}

/// Adds the values `local` of an element, such as nodal forces, to the entries of `values` at the
/// free coordinates of the element.
template <int N>
void scatter(const Eigen::Matrix<double, N, 1>& local, const CoordinateIndices<N>& where,
             Eigen::Ref<VectorXd> values) {  // NOLINT(performance-unnecessary-value-param)
  for (Index i = 0; i < where.size(); ++i) {
    if (where[i] >= 0 && where[i] < values.size()) values[where[i]] += local[i];
  }
}

/// Properties of the constraint rows, and the unknowns that each element couples.
struct SystemRows {
  std::vector<std::vector<Index>> blocks;  ///< unknowns of each element, for `KktMatrix`
  VectorXd compliance;                     ///< compliance c >= 0 of each row
  VectorXd unit;  ///< unit of the residual of each row: the model size [m] or 1 rad
};

/// Elements of one type and their terms in the equations of `GeometricallyExactSystem`. An element
/// may have constraint rows g(q, t) = C lambda (beams, bars, joints), an elastic energy (triangles,
/// springs, bending of beams), a load, and a mass.
template <class Element>
class ElementGroup {
 public:
  static constexpr int N = Element::N, R = Element::R;
  using Coordinates = typename Element::Coordinates;
  using Rows = typename Element::Rows;
  using Gradient = typename Element::Gradient;
  using Square = typename Element::Square;

  void add(Element element, const CoordinateIndices<N>& where) {
    elements_.push_back(std::move(element));
    where_.push_back(where);
  }
  [[nodiscard]] Index size() const { return static_cast<Index>(elements_.size()); }
  [[nodiscard]] Index constraint_row_count() const { return R * size(); }
  [[nodiscard]] const Element& element(Index e) const { return elements_[to_size(e)]; }
  [[nodiscard]] const CoordinateIndices<N>& coordinate_indices(Index e) const {
    return where_[to_size(e)];
  }
  [[nodiscard]] Index first_constraint_row(Index e) const { return first_constraint_row_ + R * e; }
  template <class Function>
  void for_each_coordinate(const Function& function) {
    for (CoordinateIndices<N>& where : where_) std::ranges::for_each(where, function);
  }
  /// Sets the index of the first constraint row of this element group. The rows of all groups are
  /// numbered in sequence.
  void set_first_constraint_row(Index row) { first_constraint_row_ = row; }

  void append_masses(std::vector<Eigen::Triplet<double>>& masses) const {
    if constexpr (kHasMass) {
      for (Index e = 0; e < size(); ++e) {
        const Square M = element(e).mass();
        const CoordinateIndices<N>& where = coordinate_indices(e);
        for (Index i = 0; i < M.rows(); ++i) {
          for (Index j = 0; j < M.cols(); ++j)
            if (M(i, j) != 0) masses.emplace_back(where[i], where[j], M(i, j));
        }
      }
    }
  }

  /// Adds to `system`, for each element, the indices of the unknowns that the element couples, and
  /// the compliances and units of its constraint rows. In joints, the typical stiffness and mass of
  /// the joined members or bodies are also set, which determine the penalties. Coordinates with
  /// indices of at least `free` are held by supports.
  void append_system_rows(Index free, const PenaltyScales& scales, SystemRows& system) {
    first_block_ = std::ssize(system.blocks);
    for (Index e = 0; e < size(); ++e) {
      std::vector<Index>& block = system.blocks.emplace_back();
      for (const Index k : coordinate_indices(e)) block.push_back(k < free ? k : -1);
      if constexpr (R > 0) {
        for (Index r = 0; r < R; ++r) block.push_back(free + first_constraint_row(e) + r);
        const std::span coupled(coordinate_indices(e).data(), where_[to_size(e)].size());
        Element& own = elements_[to_size(e)];
        system.compliance.segment<R>(first_constraint_row(e)) = own.row_compliance();
        double lever = 0;
        if constexpr (requires { own.offset; }) lever = own.offset.norm();
        const RowScales row = scales.row_scales(coupled, lever);
        system.unit.segment<R>(first_constraint_row(e)).setConstant(row.unit);
        if constexpr (requires { own.stiffness_scale; }) {
          own.stiffness_scale = row.stiffness;
          own.mass_scale = row.mass;
        }
      }
    }
  }

  /// Adds the terms -f + G^T lambda of all elements to the residual r of the equation of motion.
  /// tau is the coefficient of strain-rate damping.
  void add_forces(const State& state, double tau, Eigen::Ref<VectorXd> r) const {
    if constexpr (R == 0 && !kIsElastic && !kIsLoad) return;
    for (Index e = 0; e < size(); ++e) {
      const Coordinates q = gather<N>(state.q, coordinate_indices(e));
      Coordinates f = Coordinates::Zero(q.size());
      if constexpr (R > 0)
        f += evaluate_rows(e, q, state.t).gradient.transpose() *
             state.lambda.segment<R>(first_constraint_row(e));
      if constexpr (kIsElastic)
        f += element(e).forces(q, tau != 0 ? gather<N>(state.v, coordinate_indices(e)) : q, tau);
      if constexpr (kIsLoad) f -= state.load * element(e).load(q);
      scatter<N>(f, coordinate_indices(e), r);
    }
  }

  /// Adds the derivative of the force residual with respect to the load factor, for all elements.
  void add_load_derivative(const State& state, Eigen::Ref<VectorXd> r) const {
    if constexpr (kIsLoad) {
      for (Index e = 0; e < size(); ++e) {
        const Coordinates f = -element(e).load(gather<N>(state.q, coordinate_indices(e)));
        scatter<N>(f, coordinate_indices(e), r);
      }
    }
  }

  // Eigen::Ref is a view, which is passed by value.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  void constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                           Eigen::Ref<VectorXd> rate) const {
    if constexpr (R > 0) {
      for (Index e = 0; e < size(); ++e) {
        const RowValues rows = evaluate_rows(e, gather<N>(state.q, coordinate_indices(e)), state.t);
        residual.segment<R>(first_constraint_row(e)) = rows.residual;
        rate.segment<R>(first_constraint_row(e)) =
            rows.gradient * gather<N>(state.v, coordinate_indices(e));
        if constexpr (requires { element(e).time_rate(state.t); })
          rate.segment<R>(first_constraint_row(e)) += element(e).time_rate(state.t);
      }
    }
  }

  void add_tangent(const State& state, double tau, const TangentCoefficients& coefficients,
                   KktMatrix& matrix) const {
    for (Index e = 0; e < size(); ++e) {
      const Coordinates q = gather<N>(state.q, coordinate_indices(e));
      const Square S = element_tangent(state, e, q, tau, coefficients);
      if constexpr (R > 0) {
        const Gradient G = evaluate_rows(e, q, state.t).gradient;
        matrix.add(block_index(e), S, G, G, scaled_compliance(e, coefficients),
                   row_penalty(e, coefficients));
      } else {
        matrix.add(block_index(e), S);
      }
    }
  }

  /// Returns the strain energy of all elements [J], without the energy of compliant constraint
  /// rows.
  [[nodiscard]] double energy(const State& state) const {
    double sum = 0;
    if constexpr (kIsElastic) {
      for (Index e = 0; e < size(); ++e)
        sum += element(e).energy(gather<N>(state.q, coordinate_indices(e)));
    }
    return sum;
  }

  /// Adds the mean element forces of a step between two states (discrete gradients). The work of
  /// these forces from the first to the second state equals the change of the energy exactly.
  void discrete_gradient_forces(const State& from, const State& to, const VectorXd& lambda,
                                double tau, Eigen::Ref<VectorXd> r) const {
    if constexpr (R == 0 && !kIsElastic && !kIsLoad) return;
    for (Index e = 0; e < size(); ++e) {
      const Coordinates q0 = gather<N>(from.q, coordinate_indices(e));
      const Coordinates q1 = gather<N>(to.q, coordinate_indices(e));
      Coordinates f = Coordinates::Zero(q0.size());
      if constexpr (R > 0)
        f.noalias() +=
            discrete_gradient(e, from, to).transpose() * lambda.segment<R>(first_constraint_row(e));
      if constexpr (kIsElastic)
        f += element(e).discrete_gradient_forces(q0, q1, tau / (to.t - from.t));
      if constexpr (kIsLoad) f -= (from.load + to.load) / 2 * element(e).load((q0 + q1) / 2);
      scatter<N>(f, coordinate_indices(e), r);
    }
  }

  /// Adds the derivatives of `discrete_gradient_forces` and of the constraint rows with respect to
  /// the state `to`. The error of the derivatives is proportional to the square of the step,
  /// because element matrices are evaluated at the state `midpoint` with the mean coordinates.
  void discrete_gradient_tangent(const State& from, const State& to, const State& midpoint,
                                 double tau, const TangentCoefficients& coefficients,
                                 KktMatrix& matrix) const {
    if constexpr (R == 0) {
      add_tangent(midpoint, tau, coefficients, matrix);
    } else {
      for (Index e = 0; e < size(); ++e) {
        const Gradient G = evaluate_rows(e, gather<N>(to.q, coordinate_indices(e)), to.t).gradient;
        const Coordinates q = gather<N>(midpoint.q, coordinate_indices(e));
        matrix.add(block_index(e), element_tangent(midpoint, e, q, tau, coefficients),
                   discrete_gradient(e, from, to), G, scaled_compliance(e, coefficients),
                   row_penalty(e, coefficients));
      }
    }
  }

 private:
  static constexpr bool kIsElastic = requires(const Element& e, const Coordinates& q) {
    e.forces(q, q, 0.0);
  };
  static constexpr bool kIsLoad = requires(const Element& e, const Coordinates& q) { e.load(q); };
  static constexpr bool kHasMass = requires(const Element& e) { e.mass(); };

  struct RowValues {
    Rows residual;
    Gradient gradient;
  };

  [[nodiscard]] Index block_index(Index e) const { return first_block_ + e; }

  [[nodiscard]] RowValues evaluate_rows(Index e, const Coordinates& q, double t) const {
    RowValues rows;
    element(e).constraint_residual(q, t, rows.residual, rows.gradient);
    return rows;
  }

  [[nodiscard]] Square element_tangent(const State& state, Index e, const Coordinates& q,
                                       double tau, const TangentCoefficients& coefficients) const {
    const Element& own = element(e);
    const double k = coefficients.stiffness;
    Square S = Square::Zero(q.size(), q.size());
    if constexpr (kIsElastic) S += own.tangent(q, k, tau * coefficients.damping);
    if constexpr (requires(const Rows& lambda) { own.geometric_stiffness(q, lambda); })
      S += k * own.geometric_stiffness(q, state.lambda.segment<R>(first_constraint_row(e)));
    if constexpr (kIsLoad) S -= k * state.load * own.load_stiffness(q);
    if constexpr (kHasMass) S += coefficients.mass * own.mass();
    return S;
  }

  [[nodiscard]] Gradient discrete_gradient(Index e, const State& from, const State& to) const {
    const Coordinates q0 = gather<N>(from.q, coordinate_indices(e));
    const Coordinates q1 = gather<N>(to.q, coordinate_indices(e));
    if constexpr (requires { element(e).discrete_gradient(q0, q1); }) {
      return element(e).discrete_gradient(q0, q1);
    } else {
      return evaluate_rows(e, q1, to.t).gradient;
    }
  }

  [[nodiscard]] Rows row_penalty(Index e, const TangentCoefficients& coefficients) const {
    if (!coefficients.has_penalty) return Rows::Zero();
    return element(e).row_penalty(coefficients);
  }

  [[nodiscard]] Rows scaled_compliance(Index e, const TangentCoefficients& coefficients) const {
    return coefficients.compliance * element(e).row_compliance();
  }

  Index first_constraint_row_ = 0, first_block_ = 0;
  std::vector<Element> elements_;
  std::vector<CoordinateIndices<N>> where_;
};

}  // namespace trammel::solver::large_motion
