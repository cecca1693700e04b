#include "solver/large_motion/system/linear_constraints.h"

#include <utility>

namespace trammel::solver::large_motion {

namespace {

double dot(const LinearConstraintRow& row, const VectorXd& values) {
  double sum = 0;
  for (std::size_t i = 0; i < row.coordinates.size(); ++i) {
    const Index k = row.coordinates[i];
    if (k < values.size()) sum += row.factors[static_cast<Index>(i)] * values[k];
  }
  return sum;
}

/// @throws ModelError  as `add_linear_constraints`.
LinearConstraintRow row_of(const LinearConstraint& constraint, const Layout& layout) {
  LinearConstraintRow row;
  row.factors.resize(static_cast<Index>(constraint.terms.size()));
  Index rotations = 0;
  for (const auto& [coordinate, factor] : constraint.terms) {
    const Index k = layout.index_of(coordinate);
    if (k < 0) {
      throw ModelError("constraint " + constraint.name + " names a rotation that no part has");
    }
    if (layout.is_rotation[to_size(k)]) ++rotations;
    row.factors[static_cast<Index>(row.coordinates.size())] = factor;
    row.coordinates.push_back(k);
  }
  if (rotations != 0 && rotations != row.factors.size()) {
    throw ModelError("constraint " + constraint.name +
                     " mixes translations and rotations: it holds for small motion only");
  }
  return row;
}

}  // namespace

void LinearConstraints::add(LinearConstraintRow row) {
  zero_blocks_.emplace_back(Eigen::MatrixXd::Zero(row.factors.size(), row.factors.size()));
  rows_.push_back(std::move(row));
}

void LinearConstraints::set_penalty_scales(const PenaltyScales& scales) {
  for (LinearConstraintRow& row : rows_) {
    row.stiffness_scale = scales.stiffness(row.coordinates, 0);
    row.mass_scale = scales.mass(row.coordinates, 0);
  }
}

void LinearConstraints::set_row_units(const PenaltyScales& scales,
                                      Eigen::Ref<VectorXd> unit) const {
  for (std::size_t e = 0; e < rows_.size(); ++e)
    unit[first_row_ + static_cast<Index>(e)] = scales.row_unit(rows_[e].coordinates);
}

void LinearConstraints::append_blocks(std::vector<std::vector<Index>>& blocks) {
  first_block_ = static_cast<Index>(blocks.size());
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    std::vector<Index> block;
    for (const Index i : rows_[e].coordinates) block.push_back(i < free_ ? i : -1);
    block.push_back(free_ + first_row_ + static_cast<Index>(e));
    blocks.push_back(std::move(block));
  }
}

void LinearConstraints::add_constraint_forces(const VectorXd& lambda,
                                              Eigen::Ref<VectorXd> r) const {
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    const double force = lambda[first_row_ + static_cast<Index>(e)];
    for (std::size_t i = 0; i < rows_[e].coordinates.size(); ++i) {
      const Index k = rows_[e].coordinates[i];
      if (k < r.size()) r[k] += rows_[e].factors[static_cast<Index>(i)] * force;
    }
  }
}

void LinearConstraints::forces(const State& state, double, Eigen::Ref<VectorXd> r) const {
  add_constraint_forces(state.lambda, r);
}

void LinearConstraints::discrete_gradient_forces(const State&, const State&, const VectorXd& lambda,
                                                 double, Eigen::Ref<VectorXd> r) const {
  add_constraint_forces(lambda, r);
}

void LinearConstraints::constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                                            Eigen::Ref<VectorXd> rate) const {
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    const Index row = first_row_ + static_cast<Index>(e);
    residual[row] = dot(rows_[e], state.q);
    rate[row] = dot(rows_[e], state.v);
  }
}

void LinearConstraints::tangent(const State&, double, const TangentCoefficients& coefficients,
                                KktMatrix& matrix) const {
  const Eigen::Matrix<double, 1, 1> c = Eigen::Matrix<double, 1, 1>::Zero();
  for (std::size_t e = 0; e < rows_.size(); ++e) {
    const double norm = rows_[e].factors.squaredNorm();
    const double penalty =
        coefficients.stiffness * rows_[e].stiffness_scale + coefficients.mass * rows_[e].mass_scale;
    const Eigen::Matrix<double, 1, 1> rho(coefficients.has_penalty ? penalty / norm : 0);
    matrix.add(first_block_ + static_cast<Index>(e), zero_blocks_[e],
               Eigen::RowVectorXd(rows_[e].factors.transpose()), c, rho);
  }
}

void add_linear_constraints(const Model& model, const LargeMotionModel& large_motion,
                            const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<LinearConstraints>(layout.free, parts.rows);
  for (const Slider& slider : large_motion.sliders) {
    if (!slider.keeps_angle) continue;
    const Index b = layout.node[to_size(slider.node)][2];
    if (slider.rail < 0) {
      group->add({{b}, VectorXd::Ones(1)});
    } else {
      const Index a = layout.node[to_size(slider.rail)][2];
      group->add({{a, b}, Eigen::Vector2d(-1, 1)});
    }
  }
  for (const LinearConstraint& constraint : model.constraints) {
    if (!layout.equated_coordinates(constraint)) group->add(row_of(constraint, layout));
  }
  parts.add(std::move(group));
}

}  // namespace trammel::solver::large_motion
