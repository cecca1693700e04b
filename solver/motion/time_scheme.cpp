#include "solver/motion/time_scheme.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/model.h"

namespace trammel::solver {

TimeScheme newmark(double beta, double gamma) {
  if (!(beta >= 0)) throw ModelError("Newmark's beta must not be negative");
  if (!(gamma >= 0.5)) throw ModelError("Newmark's gamma must be at least 1/2");
  return {.alpha_m = 0, .alpha_f = 0, .beta = beta, .gamma = gamma};
}

TimeScheme average_acceleration() {
  return newmark(0.25, 0.5);
}
TimeScheme linear_acceleration() {
  return newmark(1.0 / 6.0, 0.5);
}
TimeScheme central_difference() {
  return newmark(0, 0.5);
}

TimeScheme hht_alpha(double alpha) {
  if (!(alpha >= -1.0 / 3.0 && alpha <= 0)) throw ModelError("HHT's alpha must be in [-1/3, 0]");
  return {
      .alpha_m = 0, .alpha_f = -alpha, .beta = (1 - alpha) * (1 - alpha) / 4, .gamma = 0.5 - alpha};
}

TimeScheme generalized_alpha(double radius) {
  if (!(radius >= 0 && radius <= 1)) throw ModelError("the spectral radius must be in [0, 1]");
  const double alpha_m = (2 * radius - 1) / (radius + 1);
  const double alpha_f = radius / (radius + 1);
  const double half = (1 - alpha_m + alpha_f) / 2;
  return {.alpha_m = alpha_m,
          .alpha_f = alpha_f,
          .beta = half * half,
          .gamma = 0.5 - alpha_m + alpha_f};
}

double spectral_radius(const TimeScheme& s, double phase_step) {
  // The state is (q, h v, h^2 A). The oscillator has h^2 a = -k q with k = (w h)^2.
  const double k = phase_step * phase_step;
  Eigen::Matrix3d left;
  Eigen::Matrix3d right;
  left << 1, 0, -s.beta,  //
      0, 1, -s.gamma,     //
      (1 - s.alpha_f) * k, 0, 1 - s.alpha_m;
  right << 1, 1, 0.5 - s.beta,  //
      0, 1, 1 - s.gamma,        //
      -s.alpha_f * k, 0, -s.alpha_m;
  return eigenpairs(left.partialPivLu().solve(right)).value.cwiseAbs().maxCoeff();
}

double stability_limit(const TimeScheme& s) {
  const double deficit = s.gamma / 2 - s.beta;
  constexpr double kRoundoff = 1e-12;
  return deficit > kRoundoff ? 1 / std::sqrt(deficit) : std::numeric_limits<double>::infinity();
}

}  // namespace trammel::solver
