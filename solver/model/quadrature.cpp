#include "solver/model/quadrature.h"

#include <cmath>

namespace trammel::solver {
namespace {

std::array<LineQuadraturePoint, 5> gauss_5() {
  const double outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3;
  const double light = (322 - 13 * std::sqrt(70.0)) / 1800;
  const double heavy = (322 + 13 * std::sqrt(70.0)) / 1800;
  return {{{(1 - outer) / 2, light},
           {(1 - inner) / 2, heavy},
           {0.5, 64.0 / 225},
           {(1 + inner) / 2, heavy},
           {(1 + outer) / 2, light}}};
}

std::array<TriangleQuadraturePoint, 25> conical_product_rule() {
  std::array<TriangleQuadraturePoint, 25> points;
  std::size_t k = 0;
  for (const LineQuadraturePoint& a : line_quadrature()) {
    for (const LineQuadraturePoint& b : line_quadrature()) {
      const double remainder = 1 - a.xi;
      points[k++] = {{a.xi, remainder * b.xi, remainder * (1 - b.xi)},
                     2 * remainder * a.weight * b.weight};
    }
  }
  return points;
}

std::array<TriangleQuadraturePoint, 6> dunavant_rule() {
  constexpr double a = 0.44594849091596488631832925388305;
  constexpr double b = 0.09157621350977074345957146340220;
  constexpr double wa = 0.22338158967801146569500700843312;
  constexpr double wb = 0.10995174365532186764832632490021;
  return {{{{1 - 2 * a, a, a}, wa},
           {{a, 1 - 2 * a, a}, wa},
           {{a, a, 1 - 2 * a}, wa},
           {{1 - 2 * b, b, b}, wb},
           {{b, 1 - 2 * b, b}, wb},
           {{b, b, 1 - 2 * b}, wb}}};
}

}  // namespace

const std::array<LineQuadraturePoint, 5>& line_quadrature() {
  static const std::array<LineQuadraturePoint, 5> points = gauss_5();
  return points;
}

const std::array<TriangleQuadraturePoint, 25>& triangle_quadrature() {
  static const std::array<TriangleQuadraturePoint, 25> points = conical_product_rule();
  return points;
}

const std::array<TriangleQuadraturePoint, 6>& triangle_quadrature_of_degree_4() {
  static const std::array<TriangleQuadraturePoint, 6> points = dunavant_rule();
  return points;
}

}  // namespace trammel::solver
