#include "solver/time/load_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/model/model.h"

namespace trammel::solver {

using Eigen::VectorXd;

TimeInterval find_interval(const std::vector<double>& times, double t) {
  const auto next = std::upper_bound(times.begin(), times.end(), t);
  const auto k = static_cast<Index>(next - times.begin());
  if (k == 0) return {};
  if (next == times.end()) return {k - 1, k - 1};
  const double length = *next - *(next - 1);
  return {k - 1, k, (t - *(next - 1)) / length, length};
}

double LoadHistory::at(double t) const {
  const auto [left, right, share, length] = find_interval(time, t);
  return factor[to_size(left)] * (1 - share) + factor[to_size(right)] * share;
}

std::vector<double> LoadHistory::bends() const {
  std::vector<double> bends;
  double before = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const bool last = k + 1 == time.size();
    const double after = last ? 0 : (factor[k + 1] - factor[k]) / (time[k + 1] - time[k]);
    const double rounding = 1e-9 * std::max(std::abs(before), std::abs(after));
    if (!(std::abs(after - before) <= rounding)) bends.push_back(time[k]);
    before = after;
  }
  return bends;
}

double LoadHistory::end_of_step(double t) const {
  const auto [first, last] = std::equal_range(time.begin(), time.end(), t);
  return last - first > 1 ? std::nextafter(t, -std::numeric_limits<double>::infinity()) : t;
}

void PiecewiseLinearLoad::at(double t, VectorXd& f) const {
  const auto [left, right, share, length] = find_interval(time, t);
  f.noalias() = pattern * ((1 - share) * factor.col(left));
  if (share > 0) f.noalias() += pattern * (share * factor.col(right));
}

void PiecewiseLinearLoad::check() const {
  if (factor.cols() != std::ssize(time) || factor.rows() != pattern.cols() || time.empty())
    throw ModelError("a piecewise linear load has a factor for each of its loads and times");
  if (!std::is_sorted(time.begin(), time.end())) throw ModelError("the times of a load ascend");
}

void PiecewiseLinearLoad::apply_to(EquationOfMotion& equation) const {
  check();
  if (pattern.rows() != equation.M.rows()) {
    throw ModelError("the load has the size of the equation of motion");
  }
  equation.breakpoints.insert(equation.breakpoints.end(), time.begin(), time.end());
  equation.load = [self = *this](double t, VectorXd& f) { self.at(t, f); };
}

PiecewiseLinearLoad step_load(const VectorXd& pattern, double start) {
  return {.pattern = pattern,
          .time = {start, start},
          .factor = (Eigen::MatrixXd(1, 2) << 0, 1).finished()};
}

PiecewiseLinearLoad load_by_history(const LoadHistory& history, const VectorXd& varied,
                                    const VectorXd& constant) {
  PiecewiseLinearLoad load;
  load.pattern.resize(varied.size(), 2);
  load.pattern << varied, constant;
  load.time = history.time;
  load.factor.setOnes(2, std::ssize(history.factor));
  load.factor.row(0) =
      Eigen::Map<const Eigen::RowVectorXd>(history.factor.data(), std::ssize(history.factor));
  return load;
}

}  // namespace trammel::solver
