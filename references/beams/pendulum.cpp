#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "references/beams/programs.h"
#include "references/numerics/real.h"

namespace trammel::references {

/// Computes the motion of a plane pendulum of any amplitude by Jacobi's elliptic functions.
std::vector<Real> pendulum_program(const Arguments& arguments) {
  const Real length = arguments.positive("length_m");
  const Real w = sqrt(arguments.positive("gravity_m_s2") / length);
  const Real k = sin(arguments.number("start_angle_deg") * pi<Real>() / 360);
  if (k == 0 || abs(k) >= 1) arguments.fail("start_angle_deg", "expected an angle within +-180");
  const std::string output = arguments.choice("output", "", {"period", "position", "tension"});
  if (output == "period") return {4 * boost::math::ellint_1(k) / w};
  std::vector<Real> values;
  for (const Real& time : arguments.numbers("times_s")) {
    const Real half = k * boost::math::jacobi_cd(Real(abs(k)), Real(w * time));  // sin(theta/2)
    if (output == "tension") {
      // With the angle of release theta_0, the tension of the rod of a mass of 1 kg is g (3 cos
      // theta - 2 cos theta_0). It is computed from the sines of the half angles.
      values.push_back(arguments.positive("gravity_m_s2") * (1 - 6 * half * half + 4 * k * k));
      continue;
    }
    values.push_back(2 * length * half * sqrt(1 - half * half));
    values.push_back(length * (2 * half * half - 1));
  }
  return values;
}

/// Motion of the chain of N four-bar loops of the IFToMM benchmark A02. It consists of 2 N + 1
/// equal uniform rods of length l: N + 1 rods rotate about fixed pivots, and N rods couple them to
/// N parallelograms. The angle theta of the rods from the upper vertical satisfies
///
///   theta'' = a sin theta,  a = (g/l) ((N + 1)/2 + N) / ((N + 1)/3 + N).
///
/// The motion starts from theta = 0 with theta' = W. With k^2 = 4 a/(W^2 + 4 a) and
/// s = t sqrt(W^2 + 4 a)/2, Jacobi's functions give
///
///   sin(theta/2) = k' sd(s, k),  cos(theta/2) = cd(s, k).
std::vector<Real> parallelogram_chain_program(const Arguments& arguments) {
  const Real N = arguments.natural_number("loops");
  const Real length = arguments.positive("length_m");
  const Real a =
      arguments.positive("gravity_m_s2") / length * ((N + 1) / 2 + N) / ((N + 1) / 3 + N);
  const Real W = arguments.positive("start_speed_m_s") / length;
  const bool position = arguments.choice("output", "", {"position", "velocity"}) == "position";
  const Real k = sqrt(4 * a / (W * W + 4 * a));
  const Real complement = W / sqrt(W * W + 4 * a);
  std::vector<Real> values;
  for (const Real& time : arguments.numbers("times_s")) {
    Real cn, dn;
    const Real s = time * sqrt(W * W + 4 * a) / 2;
    const Real sn = boost::math::jacobi_elliptic(k, s, &cn, &dn);
    const Real sine = complement * sn / dn;
    const Real cosine = cn / dn;
    const Real x = 2 * sine * cosine * length;
    const Real y = (cosine * cosine - sine * sine) * length;
    const Real rate = sqrt(W * W + 4 * a * sine * sine);
    values.push_back(position ? x : Real(y * rate));
    values.push_back(position ? y : Real(-x * rate));
  }
  return values;
}

}  // namespace trammel::references
