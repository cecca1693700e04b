// Compares the first natural frequency of a cantilever, computed with the installed solver, with
// the exact frequency of an Euler-Bernoulli beam.
#include <cmath>
#include <iostream>
#include <numbers>

#include "solver/linear/modes.h"
#include "solver/linear/system.h"

int main() {
  using namespace trammel::solver;
  const double E = 2.1e11, rho = 7850, depth = 0.01, width = 0.02, length = 1;
  const double area = depth * width, second_moment = area * depth * depth / 12;

  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {length, 0}}};
  Member member;
  member.name = "AB";
  member.nodes = {0, 1};
  member.section.EA = E * area;
  member.section.EI = E * second_moment;
  member.section.mass_per_length = rho * area;
  member.end_section = member.section;  // no taper
  member.elements = 4;
  model.members = {member};
  model.supports = {{"wall", 0, {true, true, true}}};

  const ModalSolution modes = solve_modes(assemble(model), {1});
  if (!modes.outcome.solved()) {
    std::cerr << modes.outcome.reason << '\n';
    return 1;
  }
  const double root = 1.8751040687119611, pi = std::numbers::pi;
  const double exact =
      root * root / (2 * pi * length * length) * std::sqrt(E * second_moment / (rho * area));
  const double computed = modes.frequency[0];
  std::cout << "first frequency " << computed << " Hz, exact " << exact << " Hz\n";
  return std::abs(computed / exact - 1) < 1e-4 ? 0 : 1;
}
