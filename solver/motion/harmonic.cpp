#include "solver/motion/harmonic.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "solver/linalg/factorization.h"
#include "solver/linear/free_motions.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/statics.h"
#include "solver/model/model.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr double kTwoPi = 2 * std::numbers::pi;

/// Solves (K + i w C - w^2 M) x = f with Rayleigh damping C = mass * M + stiffness * K. The matrix
/// is (1 + i w stiffness) K + (i w mass - w^2) M, which is real without damping.
VectorXcd solve_response_directly(const System& system, const RayleighDamping& damping,
                                  double omega, const VectorXd& f) {
  if (damping.mass == 0 && damping.stiffness == 0) {
    Factorization factorization;
    factorization.compute(system.K - omega * omega * system.M);
    // If the frequency is an undamped natural frequency, change it by a relative amount of 5e-10.
    if (!factorization.is_nonsingular()) {
      factorization.compute(system.K - omega * omega * (1 + 1e-9) * system.M);
    }
    if (!factorization.is_nonsingular()) return {};
    const VectorXd x = factorization.solve(f);
    const VectorXd residual = f - system.K * x + omega * omega * (system.M * x);
    return (x + factorization.solve(residual)).cast<Complex>();
  }
  const Complex k(1, omega * damping.stiffness);
  const Complex m(-omega * omega, omega * damping.mass);
  const Eigen::SparseMatrix<Complex> Z =
      k * system.K.cast<Complex>() + m * system.M.cast<Complex>();
  SparseLu<Complex> lu;
  if (!lu.factorize(Z)) return {};
  const VectorXcd load = f.cast<Complex>();
  const VectorXcd x = lu.solve(load);
  // Iterative refinement reduces the errors of rows with small entries.
  return x + lu.solve(load - Z * x);
}

}  // namespace

HarmonicSolver::HarmonicSolver(const System& system, const HarmonicDamping& damping)
    : system_(system),
      damping_{damping.rayleigh, {}, {}, {}},
      load_(system.load - system.weight),
      unsuperposed_load_(system.T.transpose() * load_),
      counters_(system.counters) {
  for (const double ratio : damping.modal_ratio) {
    if (!(std::isfinite(ratio) && ratio >= 0))
      throw ModelError("a damping ratio must be a finite number >= 0");
  }
  const auto count = static_cast<Index>(damping.modal_ratio.size());
  compute_modes(count);
  if (!outcome_.solved() || modes_.frequency.size() == 0) return;
  participation_ = modes_.shape.transpose() * unsuperposed_load_;
  unsuperposed_load_ -= system.M * (modes_.shape * participation_);
  damping_.omega = kTwoPi * modes_.frequency.head(count);
  damping_.ratio = Eigen::Map<const VectorXd>(damping.modal_ratio.data(), count);
  damping_.shape = modes_.shape.leftCols(count);
}

void HarmonicSolver::compute_modes(Index damped_count) {
  Factorization K;
  K.compute(system_.K);
  ++counters_.factorizations;
  const ZeroEnergyModes free = find_zero_energy_modes(system_, K, counters_);
  held_ = free.count() == 0;
  if (damped_count > 0) {
    const Counters before = counters_;
    modes_ = solve_modes(system_, {std::max(damped_count, free.count()), EigenMethod::automatic});
    counters_ = modes_.counters;
    counters_.factorizations += before.factorizations;
    counters_.solves += before.solves;
    outcome_ = modes_.outcome;
    if (outcome_.solved() && modes_.frequency.size() < damped_count)
      throw ModelError("there are " + std::to_string(damped_count) + " damping ratios but only " +
                       std::to_string(modes_.frequency.size()) + " modes");
  } else if (free.count() > 0 && free.all_found) {
    modes_.shape = free.basis;
    if (!mass_orthonormalize(system_, modes_.shape)) {
      outcome_ = {Status::singular,
                  "massless coordinate moves freely: " + describe_mechanism(system_, free)};
      return;
    }
    modes_.frequency.setZero(free.count());
  }
}

VectorXcd HarmonicSolver::at(double frequency) const {
  const double omega = kTwoPi * frequency;
  if (omega == 0 && !held_) return {};
  VectorXcd q = solve_response_directly(system_, damping_.rayleigh, omega, unsuperposed_load_);
  ++counters_.factorizations;
  counters_.solves += 2;
  if (q.size() == 0) return q;
  // Remove the superposed modes from the direct response. The direct response contains these modes
  // only as round-off errors, which are large near a resonance.
  if (participation_.size() > 0) {
    const VectorXcd image = system_.M * q;
    q -= modes_.shape * (modes_.shape.transpose() * image);
  }
  for (Index j = 0; j < participation_.size(); ++j) {
    const double wj = kTwoPi * modes_.frequency[j];
    const double ratio = j < damping_.ratio.size() ? damping_.ratio[j] : 0;
    const double decay =
        2 * ratio * wj + damping_.rayleigh.mass + damping_.rayleigh.stiffness * wj * wj;
    const Complex amplitude = participation_[j] / Complex(wj * wj - omega * omega, omega * decay);
    q += amplitude * modes_.shape.col(j).cast<Complex>();
  }
  return q;
}

double HarmonicSolver::backward_error(const VectorXcd& q, double frequency) const {
  const double omega = kTwoPi * frequency;
  const Complex i(0, 1);
  RowBalance<Complex> rows(system_);
  rows.add_elastic_forces((1.0 + i * omega * damping_.rayleigh.stiffness) * (system_.T * q));
  rows.add_inertia_forces(system_.T * equivalent_acceleration(q, omega));
  rows.add_load(-load_.cast<Complex>());
  return rows.backward_error();
}

VectorXcd HarmonicSolver::equivalent_acceleration(const VectorXcd& q, double omega) const {
  const Complex i(0, 1);
  const VectorXcd drag = damping_acceleration(damping_, system_.M, q.real()) +
                         i * damping_acceleration(damping_, system_.M, q.imag());
  return i * omega * drag - omega * omega * q;
}

HarmonicAmplitudes HarmonicSolver::amplitudes(const VectorXcd& q, double frequency) const {
  const double omega = kTwoPi * frequency;
  const VectorXcd u = system_.T * q;
  const Complex elastic = 1.0 / Complex(1, omega * damping_.rayleigh.stiffness);
  const VectorXcd inertial = system_.T * (elastic * equivalent_acceleration(q, omega));
  const auto part = [&](const VectorXd& displacement, const VectorXd& acceleration, double load) {
    ElasticState state;
    state.u = displacement;
    state.load_factor = load;
    state.weight_factor = 0;
    state.acceleration = acceleration;
    return end_forces(system_, state).transpose().eval();
  };
  const auto amplitude = [](const auto& a, const auto& b) {
    return (a.array().square() + b.array().square()).sqrt().matrix().eval();
  };
  HarmonicAmplitudes result;
  result.displacement = amplitude(node_motion(system_, q.real()), node_motion(system_, q.imag()));
  const Eigen::Matrix<double, Eigen::Dynamic, 6> in_phase =
      part(u.real(), inertial.real(), elastic.real());
  const Eigen::Matrix<double, Eigen::Dynamic, 6> quadrature =
      part(u.imag(), inertial.imag(), elastic.imag());
  const Eigen::Matrix<double, Eigen::Dynamic, 6> size = amplitude(in_phase, quadrature);
  const auto roundoff = force_roundoff(size.transpose(), box_diagonal(system_.mesh.positions));
  // Returns the complex stress amplitude of a force. If the section does not define the resistance
  // (area or section modulus), the result is NaN for a force larger than `negligible`.
  const auto stress_amplitude = [](const Complex& force, double resistance, double negligible) {
    const double stress = stress_of_force(force, resistance, negligible);
    return stress > 0 ? force / resistance : Complex(stress);
  };
  const auto members = static_cast<Index>(system_.model.members.size());
  result.resultant_start.resize(members, 3);
  result.resultant_end.resize(members, 3);
  result.member_stress.setZero(members);
  // Loop backward, so that the first element of each member is the last to be visited and sets the
  // forces at the start of the member.
  for (Index i = size.rows(); i-- > 0;) {
    const FrameElement& e = system_.mesh.frame[static_cast<std::size_t>(i)];
    const bool last = i + 1 == size.rows() ||
                      system_.mesh.frame[static_cast<std::size_t>(i + 1)].member != e.member;
    result.resultant_start.row(e.member) = size.row(i).head<3>();
    if (last) result.resultant_end.row(e.member) = size.row(i).tail<3>();
    double& stress = result.member_stress[e.member];
    for (const Index end : {0, 3}) {
      const Complex N(in_phase(i, end), quadrature(i, end));
      const Complex M(in_phase(i, end + 2), quadrature(i, end + 2));
      const Complex axial = stress_amplitude(N, e.section.area, roundoff.force);
      const Complex bending = stress_amplitude(M, e.section.section_modulus, roundoff.moment);
      const double larger = std::max(std::abs(axial + bending), std::abs(axial - bending));
      stress = std::isfinite(larger) ? std::max(stress, larger)
                                     : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return result;
}

HarmonicPeak harmonic_peak(const HarmonicSolver& response, double low, double high,
                           const std::vector<double>& resonances,
                           const std::function<double(const VectorXcd&, double)>& amplitude) {
  constexpr int kScan = 64;
  std::vector<double> places;
  for (int i = 0; i <= kScan; ++i) places.push_back(low + (high - low) * i / kScan);
  for (const double f : resonances) {
    if (f > low && f < high) places.push_back(f);
  }
  std::sort(places.begin(), places.end());
  const auto size = [&](double f) {
    const VectorXcd q = response.at(f);
    return q.size() == 0 ? 0.0 : amplitude(q, f);
  };
  std::size_t best = 0;
  HarmonicPeak peak{places.front(), -1};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double a = size(places[i]);
    if (a > peak.amplitude) {
      peak = {places[i], a};
      best = i;
    }
  }
  // Bracket the peak by the nearest points with lower amplitudes on both sides, because there may
  // be several peaks between two scan points.
  const double first = places[best > 0 ? best - 1 : 0],
               last = places[std::min(best + 1, places.size() - 1)];
  const auto below = [&](double by) { return std::max(first, peak.frequency - by); };
  const auto above = [&](double by) { return std::min(last, peak.frequency + by); };
  const auto is_lower = [&](double f) {
    return f == first || f == last || size(f) < peak.amplitude;
  };
  double width = 1e-6 * std::max(peak.frequency, 1e-3 * high);
  while (!is_lower(below(width)) || !is_lower(above(width))) width *= 4;
  // Accuracy of the frequency: half the bits of a double, because a maximum is flat.
  constexpr int kBits = 26;
  std::uintmax_t evaluations = 100;
  // Search in the fraction of the interval instead of the frequency, because the tolerance of the
  // search has an absolute term.
  const double start = below(width), interval = above(width) - start;
  const auto [share, negative] = boost::math::tools::brent_find_minima(
      [&](double s) { return -size(start + s * interval); }, 0.0, 1.0, kBits, evaluations);
  if (-negative > peak.amplitude) peak = {start + share * interval, -negative};
  return peak;
}

}  // namespace trammel::solver
