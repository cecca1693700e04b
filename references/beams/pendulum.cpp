#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "references/beams/programs.h"
#include "references/numerics/real.h"

/// The plane pendulum of any amplitude by Jacobi's elliptic functions.
namespace trammel::references {

std::vector<Real> pendulum_program(const Arguments& arguments) {
  const Real length = arguments.positive("length_m");
  const Real w = sqrt(arguments.positive("gravity_m_s2") / length);
  const Real k = sin(arguments.number("start_angle_deg") * pi<Real>() / 360);
  if (k == 0 || abs(k) >= 1) arguments.fail("start_angle_deg", "expected an angle within +-180");
  const std::string output = arguments.choice("output", "", {"period", "position", "tension"});
  if (output == "period") {
    return {4 * boost::math::ellint_1(k) / w};
  }
  std::vector<Real> values;
  for (const Real& time : arguments.numbers("times_s")) {
    const Real half = k * boost::math::jacobi_cd(Real(abs(k)), Real(w * time));  // sin(theta/2)
    if (output == "tension") {
      // 3 cos theta - 2 cos theta_0, by the sines of the half angles.
      values.push_back(arguments.positive("gravity_m_s2") * (1 - 6 * half * half + 4 * k * k));
      continue;
    }
    values.push_back(2 * length * half * sqrt(1 - half * half));
    values.push_back(length * (2 * half * half - 1));
  }
  return values;
}

}  // namespace trammel::references
