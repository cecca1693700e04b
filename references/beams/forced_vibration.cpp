#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <string>

#include "references/beams/programs.h"

namespace trammel::references {

namespace {

constexpr int kMaxWaveNumber = 4001;  // the stress of mode n decreases as n^-3
const double kPi = std::acos(-1.0);

/// Forced vibration of a simply supported Timoshenko beam under a load uniform over its span
/// (NAFEMS R0016, tests 5H and 5T). Its exact modes have the deflection w = sin(a x) and the
/// rotation psi = s cos(a x). Each odd n has two modes, with the circular frequencies w_n of the
/// bending and the shear branch:
///
///   a = n pi/L,  s = a - rho w_n^2/(kappa G a).
///
/// Mode of vibration with its contributions to the static displacement and stress at mid-span.
struct Mode {
  double w, damping;            ///< circular frequency [rad/s], damping ratio
  double displacement, stress;  ///< static, at mid-span [m], [Pa]
};

std::vector<Mode> modes(const Arguments& arguments) {
  const auto value = [&](const char* key) { return static_cast<double>(arguments.positive(key)); };
  const double L = value("length_m");
  const double E = value("E_Pa");
  const double rho = value("rho_kg_m3");
  const double thickness = value("thickness_m");
  const double area = thickness * value("width_m");
  const double r2 = thickness * thickness / 12;
  const double kG =
      value("shear_coefficient") * E / (2 * (1 + static_cast<double>(arguments.number("nu"))));
  const double load = value("load_N_per_m");
  const bool rayleigh = arguments.has("rayleigh_mass_1_s");
  const double rayleigh_alpha = rayleigh ? value("rayleigh_mass_1_s") : 0;
  const double rayleigh_beta = rayleigh ? value("rayleigh_stiffness_s") : 0;
  const double ratio =
      rayleigh ? 0 : static_cast<double>(arguments.not_negative("damping_ratio", 0));

  std::vector<Mode> result;
  for (int n = 1; n <= kMaxWaveNumber; n += 2) {
    const double a = n * kPi / L;
    const double half = (kG * (a * a + 1 / r2) + E * a * a) / (2 * rho);
    const double product = kG * E / (rho * rho) * std::pow(a, 4);
    const double upper = half + std::sqrt(half * half - product);
    for (const double w2 : {product / upper, upper}) {
      const double s = a - rho * w2 / (kG * a);
      const double mass = L / 2 * rho * area * (1 + r2 * s * s);
      const double force = load * 2 * L / (n * kPi);
      const double sign = n % 4 == 1 ? 1 : -1;  // sign of sin(a x) at mid-span
      const double share = sign * force / (mass * w2);
      const double w = std::sqrt(w2);
      result.push_back({w, rayleigh ? rayleigh_alpha / (2 * w) + rayleigh_beta * w / 2 : ratio,
                        share, share * E * a * s * thickness / 2});
    }
  }
  return result;
}

/// Returns the sum of f(mode), multiplied by the static contribution `share` of the mode, over all
/// modes. The sum starts with the highest modes, because their contributions are the smallest.
template <class T>
T sum(const std::vector<Mode>& modes, double Mode::*share, const std::function<T(const Mode&)>& f) {
  T total = 0;
  for (std::size_t i = modes.size(); i-- > 0;) total += modes[i].*share * f(modes[i]);
  return total;
}

double response_amplitude(const std::vector<Mode>& modes, double Mode::*share, double w) {
  return std::abs(sum<std::complex<double>>(modes, share, [w](const Mode& mode) {
    const double ratio = w / mode.w;
    return 1.0 / std::complex<double>(1 - ratio * ratio, 2 * mode.damping * ratio);
  }));
}

/// Returns the displacement of a mode after a unit step of the load, relative to its static
/// displacement. With the damping ratio d and v = w sqrt(1 - d^2), it is
///
///   y = 1 - exp(-d w t)(cos(v t) + d w/v sin(v t)).
///
/// For d > 1, the response is the overdamped solution.
double step_response(const Mode& mode, double t) {
  const double d = mode.damping;
  if (d < 1) {
    const double v = mode.w * std::sqrt(1 - d * d);
    return 1 - std::exp(-d * mode.w * t) * (std::cos(v * t) + d * mode.w / v * std::sin(v * t));
  }
  const double root = std::sqrt(d * d - 1);
  const double slow = mode.w / (d + root);  // = w (d - root)
  const double fast = mode.w * (d + root);
  return 1 - (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow);
}

double step_response_sum(const std::vector<Mode>& modes, double Mode::*share, double t) {
  return sum<double>(modes, share, [t](const Mode& mode) { return step_response(mode, t); });
}

/// Returns the x between lo and hi at which f(x) is largest. Brent's method refines the grid point
/// with the largest f.
double find_maximizer(std::function<double(double)> f, double lo, double hi, int grid) {
  gsl_set_error_handler_off();
  const double step = (hi - lo) / grid;
  std::vector<double> values(grid + 1);
  for (int i = 0; i <= grid; ++i) values[i] = f(lo + i * step);
  const auto best = std::max_element(values.begin() + 1, values.end() - 1) - values.begin();
  const std::unique_ptr<gsl_min_fminimizer, void (*)(gsl_min_fminimizer*)> minimizer(
      gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent), gsl_min_fminimizer_free);
  gsl_function function{
      [](double x, void* g) { return -(*static_cast<std::function<double(double)>*>(g))(x); }, &f};
  const double at = lo + static_cast<double>(best) * step;
  if (gsl_min_fminimizer_set(minimizer.get(), &function, at, at - step, at + step) != GSL_SUCCESS)
    throw DerivationError("no maximum of the response was found");
  for (int i = 0; i < 60; ++i) gsl_min_fminimizer_iterate(minimizer.get());
  return gsl_min_fminimizer_x_minimum(minimizer.get());
}

}  // namespace

std::vector<Real> forced_timoshenko_beam_program(const Arguments& arguments) {
  const std::vector<Mode> all = modes(arguments);
  const auto response = arguments.choice("response", "", {"static", "harmonic-peak", "step-peak"});
  const double first = all[0].w;
  const auto history = [&](double Mode::*share) -> std::function<double(double)> {
    if (response == "harmonic-peak")
      return [&, share](double w) { return response_amplitude(all, share, w); };
    return [&, share](double t) { return step_response_sum(all, share, t); };
  };
  const auto peak_at = [&](double Mode::*share) {
    if (response == "harmonic-peak")
      return find_maximizer(history(share), 0.9 * first, 1.1 * first, 40);
    return find_maximizer(history(share), 0.2 * kPi / first, 1.8 * kPi / first, 400);
  };
  std::vector<Real> values;
  for (const std::string& output : arguments.texts("outputs")) {
    double Mode::*const share = output == "stress_Pa" ? &Mode::stress : &Mode::displacement;
    if (output == "displacement_m" || output == "stress_Pa") {
      values.push_back(response == "static"
                           ? sum<double>(all, share, [](const Mode&) { return 1.0; })
                           : history(share)(peak_at(share)));
    } else if (output == "frequency_Hz" && response == "harmonic-peak") {
      values.push_back(peak_at(share) / (2 * kPi));
    } else if (output == "time_s" && response == "step-peak") {
      values.push_back(peak_at(share));
    } else {
      arguments.fail("outputs", "'" + output + "' is not an output of this response");
    }
  }
  return values;
}

/// Run-up of a rotor through the resonance of its carriage (F. M. Lewis, Vibration during
/// acceleration through a critical speed, Transactions of the ASME 54, 1932, 253-261). The total
/// mass is M, and the spring has the stiffness k, so that the natural angular frequency is w, w^2 =
/// k/M. The unbalance is m e, with a mass m at the radius e. The rotor has the prescribed angle
/// a(t), and starts from rest at a(0) = 0. The displacement of the carriage is x. Integrating
/// Duhamel's integral twice by parts gives
///
///   x = -(m e/M) (cos a(t) - cos w t - w int_0^t cos a(s) sin w(t - s) ds).
///
/// Gauss' rule with 20 points in each interval of 0.01 s computes the integral.
std::vector<Real> rotor_run_up_program(const Arguments& arguments) {
  const Real w = arguments.positive("angular_frequency_rad_s"),
             T = arguments.positive("duration_s");
  const Real speed = arguments.positive("speed_rad_s"), turn = 2 * pi<Real>();
  const auto angle = [&](const Real& t) {
    return Real(speed * (t * t / (2 * T) + T / (turn * turn) * (cos(turn * t / T) - 1)));
  };
  const auto in_phase = [&](const Real& s) { return Real(cos(angle(s)) * cos(w * s)); };
  const auto out_of_phase = [&](const Real& s) { return Real(cos(angle(s)) * sin(w * s)); };
  using Gauss = boost::math::quadrature::gauss<Real, 20>;
  std::vector<Real> values;
  Real from = 0, cosine = 0, sine = 0;
  for (const Real& t : arguments.numbers("times_s")) {
    if (t < from || t > T)
      arguments.fail("times_s", "expected ascending times within the duration");
    while (from < t) {
      const Real to = std::min(t, Real(from + Real(1) / 100));
      cosine += Gauss::integrate(in_phase, from, to);
      sine += Gauss::integrate(out_of_phase, from, to);
      from = to;
    }
    const Real integral = sin(w * t) * cosine - cos(w * t) * sine;
    values.push_back(static_cast<double>(-arguments.positive("unbalance_m") *
                                         (cos(angle(t)) - cos(w * t) - w * integral)));
  }
  return values;
}

}  // namespace trammel::references
