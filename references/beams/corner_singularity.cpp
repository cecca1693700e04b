#include "references/beams/programs.h"
#include "references/numerics/real.h"

/// The corner of a plate between a clamped and a free side, where displacements grow like r^l:
///   sin^2(l w) = (1 + k)^2/(4 k) - l^2 sin^2(w)/k
/// with the angle w between the sides and k = (3 - nu)/(1 + nu) in plane stress, 3 - 4 nu in plane
/// strain (M. L. Williams, Stress singularities resulting from various boundary conditions in
/// angular corners of plates in extension, J. Appl. Mech. 19, 1952). On even meshes energies,
/// displacements and frequencies converge with h^(2 l) where the elements would do better.
namespace trammel::references {

std::vector<Real> wedge_exponent_program(const Arguments& arguments) {
  const std::vector<Real> a = arguments.numbers("clamped_side", 2);
  const std::vector<Real> b = arguments.numbers("free_side", 2);
  const Real product = sqrt((a[0] * a[0] + a[1] * a[1]) * (b[0] * b[0] + b[1] * b[1]));
  if (product == 0) arguments.fail("clamped_side", "expected two sides that have a direction");
  const Real angle = acos(Real((a[0] * b[0] + a[1] * b[1]) / product));
  const Real nu = arguments.number("nu");
  const bool stress = arguments.choice("plane", "stress", {"stress", "strain"}) == "stress";
  const Real k = stress ? Real((3 - nu) / (1 + nu)) : Real(3 - 4 * nu);
  const Real sine = sin(angle);
  const auto f = [&](const Real& l) {
    const Real s = sin(l * angle);
    return Real(s * s - (1 + k) * (1 + k) / (4 * k) + l * l * sine * sine / k);
  };
  // A step that does not fall on 1, the root of a corner that is not singular.
  return first_roots(f, Real("0.1"), Real("0.0013"), 1);
}

}  // namespace trammel::references
