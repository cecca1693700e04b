#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "solver/large_motion/elements/constrained_system.h"
#include "solver/large_motion/system/penalty_scales.h"
#include "solver/model/numbers.h"

/// Elements of one type and what they add to the equations of `GeometricallyExactSystem`.
namespace trammel::solver::large_motion {

class ElementGroup {
 public:
  ElementGroup() = default;
  ElementGroup(const ElementGroup&) = delete;
  ElementGroup& operator=(const ElementGroup&) = delete;
  ElementGroup(ElementGroup&&) = delete;
  ElementGroup& operator=(ElementGroup&&) = delete;
  virtual ~ElementGroup() = default;

  /// Appends what each element couples and remembers where its blocks begin.
  virtual void append_blocks(std::vector<std::vector<Index>>& blocks) = 0;
  /// Adds -f + G^T lambda, with strain-rate damping tau.
  virtual void forces(const State& state, double tau, Eigen::Ref<VectorXd> r) const = 0;
  // Ref is a view.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  virtual void constraint_residual(const State&, Eigen::Ref<VectorXd>, Eigen::Ref<VectorXd>) const {
  }
  virtual void tangent(const State& state, double tau, const TangentCoefficients& coefficients,
                       KktMatrix& matrix) const = 0;
  /// The same as `forces` between two states, doing exactly the work of the energy's change.
  virtual void discrete_gradient_forces(const State& from, const State& to, const VectorXd& lambda,
                                        double tau, Eigen::Ref<VectorXd> r) const = 0;
  /// The derivative of `discrete_gradient_forces` and of the rows with respect to the second state,
  /// up to terms of the step's square; `midpoint` has the mean coordinates.
  virtual void discrete_gradient_tangent(const State&, const State&, const State& midpoint,
                                         double tau, const TangentCoefficients& coefficients,
                                         KktMatrix& matrix) const {
    tangent(midpoint, tau, coefficients, matrix);
  }
  /// Strain energy of what is not a compliant row [J].
  [[nodiscard]] virtual double energy(const State&) const { return 0; }
  [[nodiscard]] virtual Index size() const = 0;
  /// Number of constraint rows.
  [[nodiscard]] virtual Index rows() const { return 0; }
  /// Sets c >= 0 of the group's own rows.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  virtual void set_compliance(Eigen::Ref<VectorXd>) const {}
  /// Sets the penalties of the rows from the parts that they join.
  virtual void set_penalty_scales(const PenaltyScales&) {}
  /// Sets the unit of each of the group's own rows: the model's size [m] or 1 rad.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  virtual void set_row_units(const PenaltyScales&, Eigen::Ref<VectorXd>) const {}
};

/// Values of an element's coordinates; what a support holds (beyond the vector) is zero.
template <int N>
Eigen::Matrix<double, N, 1> gather(const VectorXd& values, const std::array<Index, N>& where) {
  Eigen::Matrix<double, N, 1> local;
  for (int i = 0; i < N; ++i) {
    const Index k = where[to_size(i)];
    local[i] = k >= 0 && k < values.size() ? values[k] : 0.0;
  }
  return local;
}

template <int N>
void scatter(const Eigen::Matrix<double, N, 1>& local, const std::array<Index, N>& where,
             Eigen::Ref<VectorXd> values) {
  for (int i = 0; i < N; ++i) {
    const Index k = where[to_size(i)];
    if (k >= 0 && k < values.size()) values[k] += local[i];
  }
}

/// Elements with the coordinates that each couples and R rows each, numbered from `first_row` on.
template <class Element, int R>
class ElementList : public ElementGroup {
 public:
  static constexpr int N = Element::N;

  /// @param free  number of free coordinates; those from there on are held by supports.
  explicit ElementList(Index free, Index first_row = 0) : free_(free), first_row_(first_row) {}

  void add(Element element, const std::array<Index, N>& coordinates) {
    elements_.push_back(std::move(element));
    where_.push_back(coordinates);
  }
  [[nodiscard]] Index size() const override { return static_cast<Index>(elements_.size()); }
  [[nodiscard]] Index rows() const override { return R * size(); }

  void append_blocks(std::vector<std::vector<Index>>& blocks) override {
    first_block_ = static_cast<Index>(blocks.size());
    for (Index e = 0; e < size(); ++e) {
      std::vector<Index> block;
      for (const Index i : coordinates(e)) block.push_back(i < free_ ? i : -1);
      for (Index r = 0; r < R; ++r) block.push_back(free_ + first_row(e) + r);
      blocks.push_back(std::move(block));
    }
  }

 protected:
  [[nodiscard]] const Element& element(Index e) const { return elements_[to_size(e)]; }
  [[nodiscard]] Element& element(Index e) { return elements_[to_size(e)]; }
  [[nodiscard]] const std::array<Index, N>& coordinates(Index e) const {
    return where_[to_size(e)];
  }
  [[nodiscard]] Index first_row(Index e) const { return first_row_ + R * e; }
  [[nodiscard]] Index block(Index e) const { return first_block_ + e; }

 private:
  Index free_ = 0, first_row_ = 0, first_block_ = 0;
  std::vector<Element> elements_;
  std::vector<std::array<Index, N>> where_;
};

/// Elements with constraint rows g(q, t) = C lambda: beams, bars and joints.
template <class Element>
class ConstraintElements final : public ElementList<Element, Element::R> {
  using List = ElementList<Element, Element::R>;
  using List::block, List::coordinates, List::element, List::first_row;

 public:
  static constexpr int N = Element::N, R = Element::R;
  static constexpr bool kBends = requires(const Element& e) { e.stiffness(); };
  using List::List, List::size;

  void set_compliance(Eigen::Ref<VectorXd> compliance) const override {
    for (Index e = 0; e < size(); ++e) {
      compliance.template segment<R>(first_row(e)) = element(e).compliance();
    }
  }

  void set_penalty_scales(const PenaltyScales& scales) override {
    if constexpr (requires(Element & e) { e.stiffness_scale; }) {
      for (Index e = 0; e < size(); ++e) {
        double lever = 0;
        if constexpr (requires { element(e).offset; }) lever = element(e).offset.norm();
        element(e).stiffness_scale = scales.stiffness(coordinates(e), lever);
        element(e).mass_scale = scales.mass(coordinates(e), lever);
      }
    }
  }

  void set_row_units(const PenaltyScales& scales, Eigen::Ref<VectorXd> unit) const override {
    for (Index e = 0; e < size(); ++e)
      unit.template segment<R>(first_row(e)).setConstant(scales.row_unit(coordinates(e)));
  }

  void forces(const State& state, double tau, Eigen::Ref<VectorXd> r) const override {
    typename Element::Rows residual;
    typename Element::Gradient G;
    for (Index e = 0; e < size(); ++e) {
      const typename Element::Coordinates q = gather<N>(state.q, coordinates(e));
      element(e).constraint_residual(q, state.t, residual, G);
      typename Element::Coordinates f =
          G.transpose() * state.lambda.template segment<R>(first_row(e));
      if constexpr (kBends) {
        f += element(e).bending(q);
        if (tau != 0) f += tau * element(e).bending(gather<N>(state.v, coordinates(e)));
      }
      scatter<N>(f, coordinates(e), r);
    }
  }

  void constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                           Eigen::Ref<VectorXd> rate) const override {
    typename Element::Rows g;
    typename Element::Gradient G;
    for (Index e = 0; e < size(); ++e) {
      element(e).constraint_residual(gather<N>(state.q, coordinates(e)), state.t, g, G);
      residual.template segment<R>(first_row(e)) = g;
      rate.template segment<R>(first_row(e)) = G * gather<N>(state.v, coordinates(e));
      if constexpr (requires { element(e).time_rate(state.t); }) {
        rate.template segment<R>(first_row(e)) += element(e).time_rate(state.t);
      }
    }
  }

  void tangent(const State& state, double tau, const TangentCoefficients& coefficients,
               KktMatrix& matrix) const override {
    typename Element::Rows residual;
    typename Element::Gradient G;
    for (Index e = 0; e < size(); ++e) {
      const typename Element::Coordinates q = gather<N>(state.q, coordinates(e));
      element(e).constraint_residual(q, state.t, residual, G);
      matrix.add(block(e), coordinate_matrix(state, e, tau, coefficients), G,
                 scaled_compliance(e, coefficients), penalty(e, coefficients));
    }
  }

  void discrete_gradient_tangent(const State& from, const State& to, const State& midpoint,
                                 double tau, const TangentCoefficients& coefficients,
                                 KktMatrix& matrix) const override {
    typename Element::Rows residual;
    typename Element::Gradient G;
    for (Index e = 0; e < size(); ++e) {
      const typename Element::Coordinates q0 = gather<N>(from.q, coordinates(e));
      const typename Element::Coordinates q1 = gather<N>(to.q, coordinates(e));
      element(e).constraint_residual(q1, to.t, residual, G);
      matrix.add(block(e), coordinate_matrix(midpoint, e, tau, coefficients),
                 element(e).discrete_gradient(q0, q1), G, scaled_compliance(e, coefficients),
                 penalty(e, coefficients));
    }
  }

  void discrete_gradient_forces(const State& from, const State& to, const VectorXd& lambda,
                                double tau, Eigen::Ref<VectorXd> r) const override {
    for (Index e = 0; e < size(); ++e) {
      const typename Element::Coordinates q0 = gather<N>(from.q, coordinates(e));
      const typename Element::Coordinates q1 = gather<N>(to.q, coordinates(e));
      typename Element::Coordinates f = element(e).discrete_gradient(q0, q1).transpose() *
                                        lambda.template segment<R>(first_row(e));
      if constexpr (kBends) {
        f += element(e).bending((q0 + q1) / 2 + tau / (to.t - from.t) * (q1 - q0));
      }
      scatter<N>(f, coordinates(e), r);
    }
  }

  [[nodiscard]] double energy(const State& state) const override {
    double sum = 0;
    if constexpr (kBends) {
      for (Index e = 0; e < size(); ++e)
        sum += element(e).bending_energy(gather<N>(state.q, coordinates(e)));
    }
    return sum;
  }

 private:
  [[nodiscard]] typename Element::Square coordinate_matrix(
      const State& state, Index e, double tau, const TangentCoefficients& coefficients) const {
    const typename Element::Rows lambda = state.lambda.template segment<R>(first_row(e));
    typename Element::Square S =
        coefficients.stiffness *
        element(e).geometric_stiffness(gather<N>(state.q, coordinates(e)), lambda);
    if constexpr (kBends)
      S += (coefficients.stiffness + tau * coefficients.damping) * element(e).stiffness();
    if constexpr (requires { element(e).mass(); }) S += coefficients.mass * element(e).mass();
    return S;
  }

  [[nodiscard]] typename Element::Rows penalty(Index e,
                                               const TangentCoefficients& coefficients) const {
    if (!coefficients.has_penalty) return Element::Rows::Zero();
    return element(e).penalty(coefficients);
  }

  [[nodiscard]] typename Element::Rows scaled_compliance(
      Index e, const TangentCoefficients& coefficients) const {
    return coefficients.compliance * element(e).compliance();
  }
};

/// Elements with a strain energy of their coordinates alone, as `Triangle2d`.
template <class Element>
class EnergyElements final : public ElementList<Element, 0> {
  using List = ElementList<Element, 0>;
  using List::block, List::coordinates, List::element;

 public:
  static constexpr int N = Element::N;
  using List::List, List::size;

  void forces(const State& state, double tau, Eigen::Ref<VectorXd> r) const override {
    for (Index e = 0; e < size(); ++e) {
      scatter<N>(element(e).forces(gather<N>(state.q, coordinates(e)),
                                   gather<N>(state.v, coordinates(e)), tau),
                 coordinates(e), r);
    }
  }

  void tangent(const State& state, double tau, const TangentCoefficients& coefficients,
               KktMatrix& matrix) const override {
    for (Index e = 0; e < size(); ++e) {
      typename Element::Square S = element(e).tangent(
          gather<N>(state.q, coordinates(e)), coefficients.stiffness, tau * coefficients.damping);
      S += coefficients.mass * element(e).mass();
      matrix.add(block(e), S);
    }
  }

  void discrete_gradient_forces(const State& from, const State& to, const VectorXd&, double tau,
                                Eigen::Ref<VectorXd> r) const override {
    for (Index e = 0; e < size(); ++e) {
      scatter<N>(element(e).discrete_gradient_forces(gather<N>(from.q, coordinates(e)),
                                                     gather<N>(to.q, coordinates(e)),
                                                     tau / (to.t - from.t)),
                 coordinates(e), r);
    }
  }

  [[nodiscard]] double energy(const State& state) const override {
    double sum = 0;
    for (Index e = 0; e < size(); ++e) {
      sum += element(e).energy(gather<N>(state.q, coordinates(e)));
    }
    return sum;
  }
};

}  // namespace trammel::solver::large_motion
