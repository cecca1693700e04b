#include "solver/large_motion/elements/shape_functions.h"

#include <cmath>

namespace trammel::solver::large_motion {

namespace {

template <int G>
struct Gauss {
  std::array<double, G> point, weight;  ///< on [-1, 1]
};

template <int G>
Gauss<G> gauss() {
  if constexpr (G == 1) return {{0}, {2}};
  if constexpr (G == 2) return {{-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}, {1, 1}};
  if constexpr (G == 3) {
    return {{-std::sqrt(0.6), 0, std::sqrt(0.6)}, {5.0 / 9, 8.0 / 9, 5.0 / 9}};
  }
  if constexpr (G == 4) {
    const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
    const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
    const double wi = (18 + std::sqrt(30.0)) / 36, wo = (18 - std::sqrt(30.0)) / 36;
    return {{-outer, -inner, inner, outer}, {wo, wi, wi, wo}};
  }
}

template <int P>
std::array<double, P + 1> lobatto() {
  if constexpr (P == 1) return {-1, 1};
  if constexpr (P == 2) return {-1, 0, 1};
  if constexpr (P == 3) return {-1, -std::sqrt(0.2), std::sqrt(0.2), 1};
}

template <std::size_t S>
double lagrange(const std::array<double, S>& node, std::size_t a, double x) {
  double product = 1;
  for (std::size_t b = 0; b < S; ++b) {
    if (b != a) product *= (x - node[b]) / (node[a] - node[b]);
  }
  return product;
}

template <std::size_t S>
double lagrange_slope(const std::array<double, S>& node, std::size_t a, double x) {
  double sum = 0;
  for (std::size_t c = 0; c < S; ++c) {
    if (c == a) continue;
    double product = 1 / (node[a] - node[c]);
    for (std::size_t b = 0; b < S; ++b) {
      if (b != a && b != c) product *= (x - node[b]) / (node[a] - node[b]);
    }
    sum += product;
  }
  return sum;
}

}  // namespace

template <int P>
ShapeFunctions<P>::ShapeFunctions() : node(lobatto<P>()) {
  const Gauss<P> rule = gauss<P>();
  for (int g = 0; g < P; ++g) {
    const auto at = static_cast<std::size_t>(g);
    weight[g] = rule.weight[at] / 2;
    for (int a = 0; a <= P; ++a) {
      value(g, a) = lagrange(node, static_cast<std::size_t>(a), rule.point[at]);
      slope(g, a) = 2 * lagrange_slope(node, static_cast<std::size_t>(a), rule.point[at]);
    }
  }
  stiffness = slope.transpose() * weight.asDiagonal() * slope;
  const Gauss<P + 1> full = gauss<P + 1>();
  integral.setZero();
  mass.setZero();
  for (std::size_t g = 0; g <= P; ++g) {
    Eigen::Matrix<double, P + 1, 1> n;
    for (std::size_t a = 0; a <= P; ++a) {
      n[static_cast<int>(a)] = lagrange(node, a, full.point[g]);
    }
    integral += full.weight[g] / 2 * n;
    mass += full.weight[g] / 2 * n * n.transpose();
  }
}

double lobatto_coordinate(int degree, std::size_t a) {
  if (degree == 1) return (1 + shape_functions<1>().node[a]) / 2;
  if (degree == 2) return (1 + shape_functions<2>().node[a]) / 2;
  return (1 + shape_functions<3>().node[a]) / 2;
}

template struct ShapeFunctions<1>;
template struct ShapeFunctions<2>;
template struct ShapeFunctions<3>;

}  // namespace trammel::solver::large_motion
