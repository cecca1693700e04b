#include "solver/time/transient_history.h"

#include <algorithm>

namespace trammel::solver {

TransientHistory solve_transient(const EquationOfMotion& equation,
                                 const TransientOptions& options) {
  TransientHistory history;
  const Index n = equation.M.rows();
  Index capacity = static_cast<Index>(options.sample_times.size());
  const auto resize = [&history, n](Index columns) {
    for (Eigen::MatrixXd* X : {&history.q, &history.v, &history.a}) {
      X->conservativeResize(n, columns);
    }
  };
  resize(capacity);
  history.summary = solve_transient(equation, options, [&](const MotionSample& sample) {
    if (sample.index < 0) return;
    if (sample.index >= capacity) {
      capacity = std::max<Index>(64, 2 * capacity);
      resize(capacity);
    }
    history.q.col(sample.index) = sample.q;
    history.v.col(sample.index) = sample.v;
    history.a.col(sample.index) = sample.a;
    history.time.push_back(sample.time);
    history.energy.push_back(sample.energy);
  });
  resize(static_cast<Index>(history.time.size()));
  return history;
}

Peak peak(const std::vector<double>& time, const Eigen::VectorXd& value) {
  if (value.size() == 0) return {};
  Index k = 0;
  value.cwiseAbs().maxCoeff(&k);
  const auto at = [&time](Index i) { return time[static_cast<std::size_t>(i)]; };
  Peak result{at(k), value[k]};
  if (k == 0 || k + 1 == value.size()) return result;
  const double slope = (value[k + 1] - value[k - 1]) / 2;
  const double curvature = (value[k + 1] - value[k]) - (value[k] - value[k - 1]);
  if (curvature == 0) return result;
  const double shift = std::clamp(-slope / curvature, -1.0, 1.0);
  result.time += shift * (at(k + 1) - at(k));
  result.value += shift * (slope + 0.5 * curvature * shift);
  return result;
}

}  // namespace trammel::solver
