#include "references/beams/parallelogram_chain.h"

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "references/numerics/roots.h"

namespace trammel::references {

std::vector<double> parallelogram_chain_program(const Json& json) {
  const Arguments arguments(
      json, "", {"loops", "length_m", "gravity_m_s2", "start_speed_m_s", "times_s", "output"});
  const Real N = arguments.count("loops");
  const Real length = arguments.positive("length_m");
  const Real a =
      arguments.positive("gravity_m_s2") / length * ((N + 1) / 2 + N) / ((N + 1) / 3 + N);
  const Real W = arguments.positive("start_speed_m_s") / length;
  const bool position = arguments.choice("output", "", {"position", "velocity"}) == "position";
  const Real k = sqrt(4 * a / (W * W + 4 * a));
  const Real complement = W / sqrt(W * W + 4 * a);
  std::vector<Real> values;
  for (const Real& time : arguments.numbers("times_s")) {
    Real cn;
    Real dn;
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
  return to_doubles(values);
}

}  // namespace trammel::references
