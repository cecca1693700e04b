#include "references/beams/programs.h"
#include "references/numerics/dense.h"
#include "references/numerics/real.h"

/// Bending vibration of a clamped-free Euler-Bernoulli beam of rectangular section whose depth and
/// width vary linearly, by Rayleigh and Ritz with s^2 x^k, k = 0 ... 31, where s runs from 0 to 1
/// along the beam and x = 2 s - 1: A is of second and I of fourth degree, so that all integrals are
/// sums of fractions.
namespace trammel::references {
namespace {

/// Coefficients of 1, x, x^2, ... with x = 2 s - 1.
using Polynomial = std::vector<Real>;

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial c(a.size() + b.size() - 1, Real(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

/// d/ds = 2 d/dx
Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(2 * Real(k) * p[k]);
  return d;
}

/// Over 0 <= s <= 1.
Real integral(const Polynomial& p) {
  Real sum = 0;
  for (std::size_t k = 0; k < p.size(); k += 2) sum += p[k] / Real(k + 1);
  return sum;
}

/// 1 at s = 0, `ratio` at s = 1.
Polynomial line(const Real& ratio) {
  return {(1 + ratio) / 2, (ratio - 1) / 2};
}

/// Stiffness and mass of the functions s^2 x^k, for a beam of unit E I, rho A and length.
struct Ritz {
  RealMatrix K, M;

  Ritz(const Polynomial& depth, const Polynomial& width, std::size_t n) : K(n, n), M(n, n) {
    const Polynomial A = depth * width, I = A * depth * depth;
    std::vector<Polynomial> shape(n), bend(n);
    for (std::size_t k = 0; k < n; ++k) {
      shape[k].assign(k, Real(0));
      for (const double c : {0.25, 0.5, 0.25}) shape[k].push_back(c);  // s^2 = ((1 + x) / 2)^2
      bend[k] = derivative(derivative(shape[k]));
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        K(i, j) = integral(I * bend[i] * bend[j]);
        M(i, j) = integral(A * shape[i] * shape[j]);
      }
    }
  }

  /// Returns the number of eigenvalues below x: the negative pivots of K - x M.
  [[nodiscard]] int count_below(const Real& x) const {
    RealMatrix S = K - x * M;
    int negative = 0;
    for (Eigen::Index rest = S.rows() - 1; rest >= 0; --rest) {
      const Real pivot = S(0, 0);
      negative += pivot < 0 ? 1 : 0;
      S = RealMatrix(S.bottomRightCorner(rest, rest) -
                     S.bottomLeftCorner(rest, 1) * S.topRightCorner(1, rest) / pivot);
    }
    return negative;
  }

  /// The eigenvalue with `number` - 1 below it.
  [[nodiscard]] Real eigenvalue(int number) const {
    Real low = 0, high = 1;
    while (count_below(high) < number) high *= 2;
    for (int i = 0; i < 120; ++i) {
      const Real middle = (low + high) / 2;
      (count_below(middle) < number ? low : high) = middle;
    }
    return low;
  }
};

}  // namespace

std::vector<Real> tapered_beam_program(const Arguments& arguments) {
  const std::vector<Real> t = arguments.numbers("thickness_m", 2),
                          b = arguments.numbers("width_m", 2);
  if (!(t[0] > 0 && t[1] > 0)) arguments.fail("thickness_m", "expected two positive numbers");
  if (!(b[0] > 0 && b[1] > 0)) arguments.fail("width_m", "expected two positive numbers");
  const Polynomial depth = line(t[1] / t[0]), width = line(b[1] / b[0]);
  constexpr std::size_t kFunctions = 32;
  const Ritz beam(depth, width, kFunctions), fewer(depth, width, kFunctions - 2);
  const Real length = arguments.positive("length_m");
  const Real unit = arguments.positive("E_Pa") * t[0] * t[0] /
                    (12 * arguments.positive("rho_kg_m3") * length * length * length * length);
  std::vector<Real> values;
  for (int number = 1; number <= arguments.count("count"); ++number) {
    const Real square = beam.eigenvalue(number);
    if (!(fewer.eigenvalue(number) - square < Real("1e-14") * square)) {
      throw DerivationError("the Ritz values of mode " + std::to_string(number) +
                            " have not converged");
    }
    values.push_back(sqrt(square * unit) / (2 * pi<Real>()));
  }
  return values;
}

}  // namespace trammel::references
