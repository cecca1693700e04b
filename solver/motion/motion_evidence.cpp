#include "solver/motion/motion_evidence.h"

#include <algorithm>
#include <cmath>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

using Eigen::VectorXd;

MotionEvidence::MotionEvidence(const EquationOfMotion& equation, const TimeScheme& scheme)
    : matrices_(equation), scheme_(scheme) {
  for (VectorXd* x : {&size_, &sum_, &terms_, &f_}) x->setZero(equation.M.rows());
}

void MotionEvidence::set_coordinate_scale(double step) {
  scale_ = VectorXd(matrices_.M().diagonal()) + step * step * VectorXd(matrices_.K().diagonal());
  scale_ = scale_.cwiseAbs().cwiseSqrt();
  for (double& s : scale_) {
    if (!(s > 0)) s = 1;
  }
}

void MotionEvidence::set_floored_magnitudes(const VectorXd& x) {
  const double largest = x.size() ? x.cwiseProduct(scale_).lpNorm<Eigen::Infinity>() : 0;
  size_ = x.cwiseAbs().cwiseMax((kLeastFraction * largest) * scale_.cwiseInverse());
  size_.array() += kUnderflow;
}

void MotionEvidence::add_product(const SparseMatrix& A, const VectorXd& x) {
  set_floored_magnitudes(x);
  sum_.noalias() += A * x;
  terms_.noalias() += A.cwiseAbs() * size_;
}

void MotionEvidence::add_equilibrium(double time, double load_time, const VectorXd& q,
                                     const VectorXd& v, const VectorXd& A, double step) {
  matrices_.compute_load(load_time, f_);
  matrices_.update(time);
  if (scale_.size() == 0) set_coordinate_scale(step);
  sum_ = -f_;
  // Moments of a load may cancel, so that the load on a rotation is only a round-off error. In the
  // scale of each row, the load is therefore at least a fraction of the largest load.
  const double load = f_.size() ? f_.cwiseQuotient(scale_).lpNorm<Eigen::Infinity>() : 0;
  terms_ = f_.cwiseAbs().cwiseMax((kLeastFraction * load) * scale_);
  add_product(matrices_.M(), A);
  add_product(matrices_.C(), v);
  add_product(matrices_.K(), q);
  evidence_.add(Residual::equation_of_motion, row_backward_error(sum_, terms_));
}

void MotionEvidence::add_scheme_residual(const TransientState& from, const TransientState& to,
                                         double h) {
  if (scale_.size() == 0) set_coordinate_scale(h);
  const auto norm = [this](const VectorXd& x) { return x.cwiseProduct(scale_).norm(); };
  evidence_.add(Residual::equation_of_motion,
                relation_residual(scheme_, h, from, from.A, to, to.A, true, norm, sum_));
}

void MotionEvidence::add_energy_balance(const TransientState& from, const TransientState& to,
                                        double h) {
  const TimeScheme& s = scheme_;
  const double a = h / 2 - h * (s.gamma - 0.5), b = h / 2 + h * (s.gamma - 0.5);
  const double c = h * h * (s.beta - s.gamma / 2);
  double added = 0.5 * ((a * from.A + b * to.A).dot(from.Mv + to.Mv) -
                        ((h / 2) * (from.v + to.v) + c * (to.A - from.A)).dot(from.Ma + to.Ma));
  if (!matrices_.is_constant())
    added += 0.5 * (from.q.dot(to.Kq) - to.q.dot(from.Kq) + from.v.dot(to.Mv) - to.v.dot(from.Mv));
  if (unbalanced_.size() > 0) {
    added -= 0.5 * (to.q - from.q).dot(unbalanced_);
    unbalanced_.setZero();
  }
  const MotionEnergy& e0 = from.energy;
  const MotionEnergy& e1 = to.energy;
  energy_ += e1.total() - e0.total() - added;
  throughput_ +=
      std::abs(e1.work - e0.work) + std::abs(e1.dissipated - e0.dissipated) + std::abs(added);
  largest_energy_ = std::max(
      {largest_energy_, e0.kinetic + std::abs(e0.strain), e1.kinetic + std::abs(e1.strain)});
  largest_imbalance_ = std::max(largest_imbalance_, std::abs(energy_));
  if (std::isnan(energy_)) largest_imbalance_ = energy_;
  has_energy_ = true;
}

Evidence MotionEvidence::result() const {
  Evidence all = evidence_;
  const double size = largest_energy_ + throughput_ + kUnderflow;
  if (has_energy_) all.add(Residual::energy, largest_imbalance_ / size);
  return all;
}

}  // namespace trammel::solver
